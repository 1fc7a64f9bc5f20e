// Shadows from depth maps that go with the viewer, for any renderer: view/shadow_box.h, gl/shadow_map.h.
//
//     #include "shadow_map.glsl"
//     float lit = shadow_map_factor(from_eye_m, normal, length(from_eye_m));
//
// Positions are relative to the eye, in the axes the maps were made in. `normal` is that of the surface the casters have
// there (any length), not a smoothed one; what faces away from the light is dark. For places in the air leave it out. What
// lies outside the box is lit.
//
//        + . . + . . +     a kernel of taps, a texel apart. The surface is a plane near the place: each tap is compared
//        .     .     .     with that plane's depth at the tap, so that a surface does not shade itself however obliquely
//        + . . x . . +     the light falls on it and however large the kernel is. What remains, the surface's depth
//        .     .     .     between the middle of a texel and its corners, is the polygon offset of the casters.
//        + . . + . . +
//
// DUSKLINE_SHADOW_MAP_FILTER         0 one tap; 1 kernels of 5 x 5 to 1 by distance; 2 a disc turned at random;
//                                    3 moments, filtered before
// DUSKLINE_SHADOW_MAP_PENUMBRA_ONLY  1: four taps first, and the others only where these disagree
// DUSKLINE_SHADOW_MAPS               1; 2 with the wide box
// DUSKLINE_SHADOW_MAP_TEXTURE, _WIDE_TEXTURE, _BLOCK   their units; 8, 9 and 8
//
// Sources: L. Williams, Casting curved shadows on curved surfaces, 1978; W. Reeves, D. Salesin, R. Cook, Rendering
// antialiased shadows with depth maps, 1987 (percentage closer); Shadow mapping on large terrain, Organic Vectory
// (kernels by distance, fade); J. Isidoro, Shadow mapping: GPU-based tips and techniques, 2006 (planes, discs);
// W. Donnelly, A. Lauritzen, Variance shadow maps, 2006 (moments).

#ifndef DUSKLINE_SHADOW_MAP_FILTER
#define DUSKLINE_SHADOW_MAP_FILTER 1
#endif
#ifndef DUSKLINE_SHADOW_MAP_PENUMBRA_ONLY
#define DUSKLINE_SHADOW_MAP_PENUMBRA_ONLY 0
#endif
#ifndef DUSKLINE_SHADOW_MAPS
#define DUSKLINE_SHADOW_MAPS 1
#endif
#ifndef DUSKLINE_SHADOW_MAP_TEXTURE
#define DUSKLINE_SHADOW_MAP_TEXTURE 8
#endif
#ifndef DUSKLINE_SHADOW_MAP_WIDE_TEXTURE
#define DUSKLINE_SHADOW_MAP_WIDE_TEXTURE 9
#endif
#ifndef DUSKLINE_SHADOW_MAP_BLOCK
#define DUSKLINE_SHADOW_MAP_BLOCK 8
#endif

#if DUSKLINE_SHADOW_MAP_FILTER == 3
#define DUSKLINE_SHADOW_MAP_SAMPLER sampler2D
#else
#define DUSKLINE_SHADOW_MAP_SAMPLER sampler2DShadow
#endif
layout(binding = DUSKLINE_SHADOW_MAP_TEXTURE) uniform DUSKLINE_SHADOW_MAP_SAMPLER shadow_map_near;
#if DUSKLINE_SHADOW_MAPS == 2
layout(binding = DUSKLINE_SHADOW_MAP_WIDE_TEXTURE) uniform DUSKLINE_SHADOW_MAP_SAMPLER shadow_map_wide;
#endif
#include "shadow_map_block.h"

// A surface counts as no steeper in the map than this, in texels of depth a texel: level ground in light of 2 degrees.
// What is steeper would put half of a kernel before everything that shades it.
const float kSteepestDepth = 29.0;
// Of depth, in texels: what is rounded away.
const float kDepthRounding = 0.05;
// Beyond a crest ground falls away from the light, and the texels beside it are of the crest, before it: as far as
// the surface's plane reaches over a texel it counts as nearer to the light, but for no more texels than this.
const float kNearestFold = 8.0;

// A place in a map, how the depth of the surface grows to the right and upwards there, and by how much nearer to the
// light it counts.
struct ShadowMapPlace {
    vec3 at;
    vec2 slope;
    float bias;
};

ShadowMapPlace shadow_map_place(ShadowMapPart box, vec3 from_eye_m, vec3 normal)
{
    vec4 p = vec4(from_eye_m, 1.0);
    ShadowMapPlace place;
    place.at = vec3(dot(box.to_column, p), dot(box.to_row, p), dot(box.to_depth, p));
    vec3 turned = vec3(dot(box.to_column.xyz, normal), dot(box.to_row.xyz, normal), -dot(box.to_depth.xyz, normal));
    place.slope = turned.z > 0.0 ? turned.xy / max(turned.z, length(turned) / kSteepestDepth) : vec2(0.0);
    float fold = min(abs(place.slope.x) + abs(place.slope.y), kNearestFold);
    place.bias = (kDepthRounding + fold) * box.texel;
    return place;
}

// Its own ground is before it. Places in the air face nowhere.
bool shadow_map_faces_away(ShadowMapPart box, vec3 normal)
{
    return dot(box.to_depth.xyz, normal) > 0.0;
}

int shadow_map_taps(ShadowMapPart box, float eye_distance_m)
{
    return 1 + int(dot(vec4(lessThan(vec4(eye_distance_m), box.borders)), vec4(1.0)));
}

#if DUSKLINE_SHADOW_MAP_FILTER != 3
// How much of what the sampler compares is lit, so many texels beside a place.
float shadow_map_tap(sampler2DShadow map, ShadowMapPart box, ShadowMapPlace place, vec2 beside)
{
    vec3 at = place.at + box.texel * vec3(beside, dot(place.slope, beside));
    return textureLod(map, vec3(at.xy, min(at.z - place.bias, 1.0)), 0.0); // nothing lies behind the box
}

float shadow_map_corners(sampler2DShadow map, ShadowMapPart box, ShadowMapPlace place, float beside)
{
    return 0.25 * (shadow_map_tap(map, box, place, vec2(-beside, -beside)) + shadow_map_tap(map, box, place, vec2(beside, -beside))
                   + shadow_map_tap(map, box, place, vec2(-beside, beside)) + shadow_map_tap(map, box, place, vec2(beside, beside)));
}

float shadow_map_kernel(sampler2DShadow map, ShadowMapPart box, ShadowMapPlace place, int taps)
{
    float first = -0.5 * float(taps - 1);
#if DUSKLINE_SHADOW_MAP_PENUMBRA_ONLY
    float corners = shadow_map_corners(map, box, place, first * box.spread);
    if (taps < 3 || corners == 0.0 || corners == 1.0)
        return corners;
#endif
    float sum = 0.0;
    for (int row = 0; row < taps; ++row)
        for (int column = 0; column < taps; ++column)
            sum += shadow_map_tap(map, box, place, (first + vec2(column, row)) * box.spread);
    return sum / float(taps * taps);
}

// Of a quarter of a texel, 0 to 1. The box moves by whole 32nds of the map: places keep theirs.
float shadow_map_random(ShadowMapPart box, vec2 at)
{
    float period = 4.0 * floor(1.0 / (32.0 * box.texel));
    uvec2 cell = uvec2(mod(floor(4.0 * at / box.texel), period));
    uint bits = cell.x * 0x9E3779B9u + cell.y * 0x7F4A7C15u;
    bits = (bits ^ (bits >> 16)) * 0x45D9F3B5u;
    bits = (bits ^ (bits >> 15)) * 0x2545F491u;
    return float(bits >> 8) / 16777216.0;
}

// As wide (by variance) as a kernel of so many taps a side.
float shadow_map_disc(sampler2DShadow map, ShadowMapPart box, ShadowMapPlace place, int taps)
{
    float turn = 6.2831853 * shadow_map_random(box, place.at.xy);
    mat2 turned = 0.57735 * float(taps) * box.spread * mat2(cos(turn), sin(turn), -sin(turn), cos(turn));
    float sum = 0.0;
    for (int i = 0; i < shadow_map.samples; ++i) {
        vec4 two = shadow_map.disc[i / 2];
        sum += shadow_map_tap(map, box, place, turned * ((i & 1) == 0 ? two.xy : two.zw));
#if DUSKLINE_SHADOW_MAP_PENUMBRA_ONLY
        if (i == 3 && (sum == 0.0 || sum == 4.0))
            return 0.25 * sum;
#endif
    }
    return sum / float(shadow_map.samples);
}

float shadow_map_filtered(sampler2DShadow map, ShadowMapPart box, ShadowMapPlace place, int taps)
{
#if DUSKLINE_SHADOW_MAP_FILTER == 0
    return shadow_map_tap(map, box, place, vec2(0.0));
#else
    if (taps == 1)
        return shadow_map_tap(map, box, place, vec2(0.0));
#if DUSKLINE_SHADOW_MAP_FILTER == 1
    return shadow_map_kernel(map, box, place, taps);
#else
    return shadow_map_disc(map, box, place, taps);
#endif
#endif
}
#else
// Mean and mean square of depths around, from the middle of the box, bound how many lie at or behind a depth
// (Chebyshev); over a plane behind another it is their share.
float shadow_map_filtered(sampler2D map, ShadowMapPart box, ShadowMapPlace place, int taps)
{
    vec2 moments = textureLod(map, place.at.xy, 0.0).rg;
    float behind = place.at.z - place.bias - 0.5 - moments.x;
    float variance = max(moments.y - moments.x * moments.x, 0.25 * box.texel * box.texel);
    return behind <= 0.0 ? 1.0 : variance / (variance + behind * behind);
}
#endif

bool shadow_map_holds(ShadowMapPlace place)
{
    return all(greaterThanEqual(place.at, vec3(0.0))) && all(lessThanEqual(place.at, vec3(1.0)));
}

// 0 while shadows are whole, 1 where there are none.
float shadow_map_fade(ShadowMapPart box, float eye_distance_m)
{
    return clamp((eye_distance_m - box.fade_begin_m) / (box.fade_end_m - box.fade_begin_m), 0.0, 1.0);
}

float shadow_map_lit(DUSKLINE_SHADOW_MAP_SAMPLER map, ShadowMapPart box, vec3 from_eye_m, vec3 normal,
                     float eye_distance_m)
{
    ShadowMapPlace place = shadow_map_place(box, from_eye_m, normal);
    if (!shadow_map_holds(place))
        return 1.0;
    if (shadow_map_faces_away(box, normal))
        return 0.0;
    return shadow_map_filtered(map, box, place, shadow_map_taps(box, eye_distance_m));
}

// Beyond the near box: 1, or what the wide one says.
float shadow_map_beyond(vec3 from_eye_m, vec3 normal, float eye_distance_m)
{
#if DUSKLINE_SHADOW_MAPS == 2
    float fade = shadow_map_fade(shadow_map.wide_box, eye_distance_m);
    return fade < 1.0 ? mix(shadow_map_lit(shadow_map_wide, shadow_map.wide_box, from_eye_m, normal, eye_distance_m),
                            1.0, fade)
                      : 1.0;
#else
    return 1.0;
#endif
}

bool shadow_map_near_holds(vec3 from_eye_m, vec3 normal)
{
    return shadow_map_holds(shadow_map_place(shadow_map.near_box, from_eye_m, normal));
}

/// How much light gets to a place of a surface, 0 to 1. Where casters are not the same surface in both maps, the place
/// has one on each.
float shadow_map_factor(vec3 from_eye_m, vec3 normal, vec3 wide_from_eye_m, vec3 wide_normal, float eye_distance_m)
{
    if (shadow_map.strength <= 0.0)
        return 1.0;
    float fade = shadow_map_near_holds(from_eye_m, normal) ? shadow_map_fade(shadow_map.near_box, eye_distance_m) : 1.0;
    float beyond = fade > 0.0 ? shadow_map_beyond(wide_from_eye_m, wide_normal, eye_distance_m) : 1.0;
    float lit = fade < 1.0 ? mix(shadow_map_lit(shadow_map_near, shadow_map.near_box, from_eye_m, normal, eye_distance_m),
                                 beyond, fade)
                           : beyond;
    return 1.0 - shadow_map.strength * (1.0 - lit);
}

float shadow_map_factor(vec3 from_eye_m, vec3 normal, float eye_distance_m)
{
    return shadow_map_factor(from_eye_m, normal, from_eye_m, normal, eye_distance_m);
}

/// The same for a place in the air.
float shadow_map_factor(vec3 from_eye_m, float eye_distance_m)
{
    return shadow_map_factor(from_eye_m, vec3(0.0), eye_distance_m);
}

/// A false colour to lay over the picture, and how much of it: ShadowMapOverlay. `lit` is the factor there.
vec4 shadow_map_overlay(vec3 from_eye_m, float eye_distance_m, float lit)
{
    const vec3 red = vec3(0.9, 0.1, 0.05);
    const vec3 green = vec3(0.1, 0.7, 0.15);
    bool inside = shadow_map_near_holds(from_eye_m, vec3(0.0));
    float fade = shadow_map_fade(shadow_map.near_box, eye_distance_m);
    if (shadow_map.overlay == 1 && inside) {
        const vec3 kernels[5] = vec3[](vec3(0.1, 0.25, 0.9), red, vec3(1.0, 0.5, 0.0), vec3(1.0, 0.9, 0.1), green);
        return vec4(kernels[shadow_map_taps(shadow_map.near_box, eye_distance_m) - 1], 0.5);
    }
    if (shadow_map.overlay == 2 && inside)
        return fade > 0.0 && fade < 1.0 ? vec4(red, 0.6) : vec4(0.0);
    if (shadow_map.overlay == 3 && lit < 1.0)
        return lit > 1.0 - shadow_map.strength ? vec4(red, 0.7) : vec4(green, 0.6);
    if (shadow_map.overlay == 4)
        return inside ? vec4(1.0, 0.9, 0.1, fade < 1.0 ? 0.35 : 0.15) : vec4(0.0);
    return vec4(0.0);
}
