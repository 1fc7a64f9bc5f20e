// Clouds of a thin layer in the terrain's shadow. Their shape is noise: a drawing, not a model of air.

#version 430 core
#include "terrain_shadow.glsl"
#include "sky_colour.glsl"
#include "srgb.glsl"

in vec3 from_eye_m;
in vec2 cell;

uniform sampler2D mesh_heights_m;
uniform vec2 last_cell;
uniform vec2 cell_size_m;
uniform float layer_m;
uniform float feature_m; // from cloud to cloud
uniform float cover;
uniform float drifted_m; // eastwards
uniform float ambient;
uniform float exposure;
uniform vec3 sun_colour;
uniform vec3 sky_light;
uniform float clear_m;

out vec4 pixel;

float random_at(ivec2 node)
{
    uint bits = uint(node.x) * 0x9e3779b1u ^ uint(node.y) * 0x85ebca77u;
    bits = (bits ^ (bits >> 15)) * 0x2c1b3c6du;
    bits = (bits ^ (bits >> 12)) * 0x297a2d39u;
    return float((bits ^ (bits >> 15)) >> 8) / 16777216.0;
}

float noise(vec2 at)
{
    vec2 first = floor(at);
    vec2 rest = at - first;
    vec2 t = rest * rest * (3.0 - 2.0 * rest);
    ivec2 node = ivec2(first);
    return mix(mix(random_at(node), random_at(node + ivec2(1, 0)), t.x),
               mix(random_at(node + ivec2(0, 1)), random_at(node + ivec2(1, 1)), t.x), t.y);
}

// 0 to 1, 0.5 on average.
float billows(vec2 at)
{
    float sum = 0.0;
    float share = 0.5;
    for (int octave = 0; octave < 5; ++octave) {
        sum += share * noise(at);
        at = mat2(1.6, 1.2, -1.2, 1.6) * at + vec2(7.3, 2.9);
        share *= 0.5;
    }
    return sum / 0.96875;
}

// Thin where mountains come through, and towards the borders.
float opening()
{
    float ground_m = texture(mesh_heights_m, (cell + 0.5) / vec2(textureSize(mesh_heights_m, 0))).r;
    float over_ground = smoothstep(0.0, 0.08 * feature_m, layer_m - ground_m);
    vec2 from_border = min(cell, last_cell - cell) / (0.08 * last_cell + 1.0);
    return over_ground * smoothstep(0.0, 1.0, min(from_border.x, from_border.y));
}

void main()
{
    vec2 place_m = cell * cell_size_m - vec2(drifted_m, 0.0);
    float thick = billows(place_m / feature_m) - (0.75 - 0.5 * cover);
    float opacity = 0.9 * opening() * smoothstep(0.0, 0.14, thick);
    if (opacity < 0.004)
        discard;
    float own_shade = 1.0 - 0.6 * max(0.0, thick);
    vec3 light = sky_light * (1.3 * ambient) + sun_colour * ((1.0 - ambient) * own_shade * shadow_factor(from_eye_m));
    vec3 seen = exposure * 0.9 * light;
    if (clear_m > 0.0) {
        float distance_m = length(from_eye_m);
        float clear = distance_m / clear_m;
        seen = mix(sky_colour(from_eye_m / distance_m), seen, exp(-clear * clear));
    }
    pixel = vec4(srgb(soft_clip(seen)), opacity);
}
