// The light of the ground: its own colour under a sun and a sky, as products/relief.h says, with cast shadows, and haze
// before what is far away. Slopes come from the heights themselves, as coarse as the pixel is large.

#version 430 core
#ifndef TERRAIN_LAMPS // whether lamps shine
#define TERRAIN_LAMPS 0
#endif
#if TERRAIN_LAMPS || SHADOW_LOOKUP == 9
#include "caster_surface.glsl"
#endif
#if TERRAIN_LAMPS
#include "lamp_maps.glsl"
#endif
#include "terrain_lit.glsl"
#include "sky_colour.glsl"
#include "srgb.glsl"

in vec2 cell;
in vec3 from_eye_m;

uniform sampler2D mesh_heights_m;
uniform sampler2D ground; // opacity 0 where there are no data
uniform sampler2D truth;  // mask to compare with
uniform bool show_difference;
uniform vec2 cell_size_m;
uniform vec3 towards_light;
uniform vec3 towards_bright_sky;
uniform float exaggeration; // of slopes
uniform float ambient;      // light of level ground in shadow, 1 in the light
uniform float exposure;
uniform vec3 sun_colour;
uniform vec3 sky_light;
uniform float clear_m; // how far away haze takes up two thirds; 0 for none

out vec4 pixel;

float height_at(vec2 at, float level)
{
    return textureLod(mesh_heights_m, (at + 0.5) / vec2(textureSize(mesh_heights_m, 0)), level).r;
}

// Rise over run, eastwards and northwards, between places a pixel apart or a cell.
vec2 slope_at(vec2 at, float width)
{
    float level = max(0.0, log2(width));
    vec2 last = vec2(textureSize(mesh_heights_m, 0) - 1);
    vec2 low = max(at - exp2(level), vec2(0.0));
    vec2 high = min(at + exp2(level), last);
    vec2 run_m = max(high - low, 1e-3) * cell_size_m;
    float east_m = height_at(vec2(high.x, at.y), level) - height_at(vec2(low.x, at.y), level);
    float north_m = height_at(vec2(at.x, low.y), level) - height_at(vec2(at.x, high.y), level);
    return vec2(east_m, north_m) / run_m;
}

// Hollow ground sees less of the sky, ground that stands out more: its height against means over 8 and 32 cells.
float openness(vec2 at, float own_m)
{
    float open = 1.0;
    for (int level = 3; level <= 5; level += 2) {
        float width_m = exp2(float(level)) * sqrt(cell_size_m.x * cell_size_m.y);
        float hollow = 1.2 * exaggeration * (height_at(at, float(level)) - own_m) / width_m;
        open -= 0.19 * hollow * inversesqrt(1.0 + hollow * hollow);
    }
    return open;
}

float square(float x)
{
    return x * x;
}

// Light of the sun on ground that faces it so much, against level ground.
float sunlight(vec3 normal)
{
    float direct = max(0.0, dot(normal, towards_light)) / max(towards_light.z, 0.035);
    return 2.6 * direct / (1.6 + direct);
}

float skylight(vec3 normal, float open)
{
    float bright_sky = square(0.5 + 0.5 * dot(normal, towards_bright_sky)) / square(0.5 + 0.5 * towards_bright_sky.z);
    return open * mix(0.5 + 0.5 * normal.z, bright_sky, 0.6);
}

// What is wrong, in colours that no ground has: lit and should not be, dark and should not be.
vec3 marked(vec3 colour)
{
    ivec2 at = ivec2(cell + 0.5);
    bool lit = is_lit(at);
    bool should = texelFetch(truth, at, 0).r > 0.5;
    if (lit == should || !has_data(at))
        return colour;
    return lit ? vec3(1.0, 0.05, 0.02) : vec3(0.05, 0.25, 1.0);
}

void main()
{
    vec2 across = dFdx(cell);
    vec2 down = dFdy(cell);
    float width = max(length(across), length(down));
    vec4 own = texture(ground, (cell + 0.5) / vec2(textureSize(ground, 0)));
    if (own.a < 0.5)
        discard;

    float open = openness(cell, height_at(cell, max(0.0, log2(width))));
    vec3 normal = normalize(vec3(-exaggeration * slope_at(cell, width), 1.0));
    float sun = sunlight(normal);
    if (sun > 0.0) // ground that turns away is dark, whatever shades it
        sun *= lit_over(cell, across, down);
    vec3 light = sky_light * (ambient * skylight(normal, open)) + sun_colour * ((1.0 - ambient) * sun);
#if TERRAIN_LAMPS
    CasterSurface surface = caster_surface(cell, 1);
    light += lamp_light(surface.place_m, normal, surface.normal);
#endif
    vec3 colour = exposure * own.rgb / own.a * light;
    if (clear_m > 0.0) {
        float distance_m = length(from_eye_m);
        colour = mix(sky_colour(from_eye_m / distance_m), colour, exp(-square(distance_m / clear_m)));
    }
    colour = soft_clip(colour);
#if SHADOW_LOOKUP == 9
    if (shadow_map.overlay != 0) {
        vec4 overlay = terrain_shadow_map_overlay(cell, terrain_shadow_map(cell));
        colour = mix(colour, overlay.rgb, overlay.a);
    }
#endif
    pixel = vec4(srgb(show_difference ? marked(colour) : colour), 1.0);
}
