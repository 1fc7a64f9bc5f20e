// What is behind a planet: its air against black, and the sun.

#version 430 core
#include "planet_air.glsl"
#include "srgb.glsl"

uniform vec2 picture_size;
uniform vec3 forward;    // of the camera
uniform vec3 half_right; // to the middle of the right border of the picture, and of the upper one, one metre ahead
uniform vec3 half_up;
uniform float sun_cosine; // of the disc's radius
uniform float exposure;

out vec4 pixel;

const float kAllAir_m = 1e9;

void main()
{
    vec2 at = 2.0 * gl_FragCoord.xy / picture_size - 1.0;
    vec3 direction = normalize(forward + at.x * half_right + at.y * half_up);
    Haze haze = haze_before(kAllAir_m * direction);
    vec3 behind = dot(direction, towards_sun) > sun_cosine ? 20.0 * sun_colour : vec3(0.0);
    pixel = vec4(srgb(soft_clip(exposure * (haze.passed * behind + haze.added))), 1.0);
}
