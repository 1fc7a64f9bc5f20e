// A surface over a terrain under its sun and sky, in the terrain's shadow.

#version 430 core
#include "terrain_shadow.glsl"
#include "sky_colour.glsl"
#include "srgb.glsl"

in vec3 from_eye_m;
in vec3 direction;
in vec3 colour;

uniform vec3 towards_light;
uniform float ambient;
uniform float exposure;
uniform vec3 sun_colour;
uniform vec3 sky_light;
uniform float clear_m; // how far away haze takes up two thirds; 0 for none

out vec4 pixel;

void main()
{
    vec3 normal = normalize(direction);
    float direct = max(0.0, dot(normal, towards_light)) * shadow_factor(from_eye_m);
    vec3 light = sky_light * (ambient * (0.65 + 0.35 * normal.z)) + sun_colour * ((1.0 - ambient) * 1.5 * direct);
    vec3 seen = exposure * colour * light;
    if (clear_m > 0.0) {
        float distance_m = length(from_eye_m);
        float clear = distance_m / clear_m;
        seen = mix(sky_colour(from_eye_m / distance_m), seen, exp(-clear * clear));
    }
    pixel = vec4(srgb(soft_clip(seen)), 1.0);
}
