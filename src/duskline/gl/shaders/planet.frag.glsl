// A planet's ground: colours by height, slope and latitude, the light of sun and sky in the shadows that a technique has
// found, and the air before it.
//
// PLANET_SHADOW   where shadows come from
//   0             nowhere: all is lit that faces the sun
//   1             a shadow map
//   2             shadow heights of the tiles
// PLANET_DISC     whether these have two heights, for a sun that is seen in part: 0 or 1
// PLANET_LAMPS    whether lamps shine: 0 or 1
// PLANET_PROBE    instead of colours: the place from the eye, and
//   1             how much sunlight gets there, below 0 on ground that faces away
//   2             how much of a lamp is visible, below 0 where it lights nothing anyway

#version 430 core
#include "planet_surface.glsl"
#include "planet_air.glsl"
#include "srgb.glsl"
#if PLANET_LAMPS
#include "lamp_maps.glsl"
#endif

in vec3 from_eye_m;
in vec3 normal;
in vec2 at;
in float height_m;
in float turned;
// Not read from `tiles` here: drivers do not read buffers for pixels that are only there for derivatives.
flat in ivec4 tile_layers; // layers of the tile and its parent; whether they have shadow heights
flat in ivec2 in_parent;   // where the tile begins there
flat in vec2 second_shadows; // their shares, of the tile's shadows and the parent's

// What a technique may want to know of the place of a pixel.
struct PlanetPlace {
    vec3 from_eye_m;
    vec3 normal;    // of any length
    vec2 at;        // column and row in the tile, 0 to 128
    float height_m; // as drawn
    float turned;   // into the parent: 0 to 1
    ivec4 layers;   // of the tile and its parent; whether they have shadow heights
    ivec2 in_parent;
    vec2 second_shadows;
};

// Each has
//     float planet_shadow(PlanetPlace place)                      how much light gets there, 0 to 1
//     vec4 planet_shadow_overlay(PlanetPlace place, float lit)    a false colour to lay over the picture, and how much
#if PLANET_SHADOW == 1
#include "planet_shadow_map.glsl"
#elif PLANET_SHADOW == 2
#include "planet_shadow_fronts.glsl"
#else
#include "planet_shadow_none.glsl"
#endif

uniform vec3 eye_m;     // from the centre, for the directions outwards
uniform float ambient;  // light of level ground in shadow, 1 in the light
uniform float exposure;
uniform bool living;    // water, plants and snow; else dust
uniform bool show_made; // mark what no file has measured
uniform sampler2DArray planet_measured;
uniform int probed_lamp;

out vec4 pixel;

bool is_made()
{
    return texelFetch(planet_measured, ivec3(ivec2(at + 1.5), tile_layers.x), 0).r == 0.0;
}

// Means and interpolation of sources leave ripples of less than that on the sea before steep shores.
const float kShore_m = 2.0;

// How much of the ground around a place of a tile is land: corners above the sea by weights of a quadratic spline. Where the mesh
// itself leaves the sea the shore would go in steps along its squares.
float land_around(int layer, vec2 corner)
{
    ivec2 middle = ivec2(round(corner));
    vec2 t = corner - vec2(middle);
    vec2 weights[3] = vec2[](0.5 * (0.5 - t) * (0.5 - t), 0.75 - t * t, 0.5 * (0.5 + t) * (0.5 + t));
    float land = 0.0;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            if (tile_height_m(layer, middle + ivec2(column - 1, row - 1)) > kShore_m)
                land += weights[column].x * weights[row].y;
    return land;
}

// 0 on the sea, 1 on land, between them a pixel.
float land_share()
{
    float own = land_around(tile_layers.x, at);
    float land = turned > 0.0 ? mix(own, land_around(tile_layers.y, vec2(in_parent) + 0.5 * at), turned) : own;
    float soft = clamp(fwidth(land), 1e-3, 0.5);
    return smoothstep(0.5 - soft, 0.5 + soft, land);
}

vec3 ground_colour(vec3 outwards, float steepness, float land)
{
    if (!living)
        return mix(vec3(0.20, 0.19, 0.18), vec3(0.30, 0.29, 0.28), smoothstep(-3000.0, 4000.0, height_m));
    float northern = abs(outwards.z);
    vec3 low = mix(vec3(0.065, 0.115, 0.030), vec3(0.115, 0.110, 0.060), smoothstep(0.3, 0.9, northern));
    vec3 colour = mix(low, vec3(0.200, 0.160, 0.085), smoothstep(200.0, 1800.0, height_m));
    colour = mix(colour, vec3(0.210, 0.180, 0.150), smoothstep(1600.0, 3200.0, height_m));
    colour = mix(colour, vec3(0.160, 0.145, 0.130), smoothstep(0.35, 0.8, steepness));
    float snow_line_m = 5200.0 * (1.0 - smoothstep(0.30, 0.96, northern)) - 200.0;
    float snow = smoothstep(-300.0, 500.0, height_m - snow_line_m) * (1.0 - smoothstep(0.6, 1.2, steepness));
    colour = mix(colour, vec3(0.80, 0.83, 0.87), snow);
    return mix(vec3(0.012, 0.036, 0.075), colour, land);
}

vec3 light_on(vec3 outwards, vec3 facing, float lit)
{
    float sine = dot(outwards, towards_sun);
    // Eyes take low light for brighter than it is.
    float direct = max(0.0, dot(facing, towards_sun));
    vec3 sun = sunlight_at(outwards, height_m) * (2.4 * direct / (0.5 + direct)) * lit;
    float day = air ? smoothstep(-0.12, 0.25, sine) : smoothstep(0.0, 0.1, sine);
    // The sky is brighter towards the sun.
    vec3 bright_sky = normalize(outwards + 0.7 * (towards_sun - sine * outwards));
    float open = air ? pow(0.5 + 0.5 * dot(facing, bright_sky), 2.0) : 0.5 + 0.5 * dot(facing, outwards);
    vec3 sky = mix(vec3(1.0), vec3(0.84, 0.95, 1.14), air ? 1.0 : 0.0) * (ambient * day * open);
    return sun * (1.0 - ambient) + sky + vec3(0.004, 0.006, 0.012);
}

#if PLANET_LAMPS
// What the sun is at noon, by `light_on`: lamps are as bright as their distances say.
const float kSunOnLevelGround = 1.6;

// Of the mesh itself, which is what casts.
vec3 triangle_normal(vec3 outwards)
{
    vec3 across = cross(dFdx(from_eye_m), dFdy(from_eye_m));
    return dot(across, outwards) < 0.0 ? -across : across;
}
#endif

void main()
{
    vec3 outwards = normalize(eye_m + from_eye_m);
    float upright = clamp(dot(normalize(normal), outwards), 0.02, 1.0);
    float steepness = sqrt(1.0 - upright * upright) / upright;
    PlanetPlace place = PlanetPlace(from_eye_m, normal, at, height_m, turned, tile_layers, in_parent,
                                    second_shadows);
    float lit = planet_shadow(place);
#if PLANET_PROBE == 1
    pixel = vec4(from_eye_m, dot(normal, towards_sun) > 0.0 ? lit : -1.0);
    return;
#elif PLANET_PROBE == 2
    vec3 triangle = triangle_normal(outwards);
    bool lights = lamp_unshaded(probed_lamp, from_eye_m, normalize(normal)) > 0.0;
    pixel = vec4(from_eye_m, lights ? lamp_visible(probed_lamp, from_eye_m, triangle) : -1.0);
    return;
#endif
    float land = living ? land_share() : 1.0;
    vec3 colour = ground_colour(outwards, steepness, land) * 2.2;
    if (show_made && is_made())
        colour = mix(colour, vec3(0.9, 0.1, 0.6), 0.35);
    // The sea is level, though the mesh rises from it before the shore.
    vec3 facing = normalize(mix(outwards, normalize(normal), land));
    vec3 light = light_on(outwards, facing, lit);
#if PLANET_LAMPS
    light += kSunOnLevelGround * lamp_light(from_eye_m, facing, triangle_normal(outwards));
#endif
    colour *= light;
    vec4 overlay = planet_shadow_overlay(place, lit);
    colour = mix(colour, overlay.rgb, overlay.a);
    Haze haze = haze_before(from_eye_m);
    pixel = vec4(srgb(soft_clip(exposure * (colour * haze.passed + haze.added))), 1.0);
}
