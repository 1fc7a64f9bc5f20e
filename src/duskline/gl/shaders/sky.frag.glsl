// What is behind the terrain.

#version 430 core
#include "sky_colour.glsl"
#include "srgb.glsl"

uniform vec2 picture_size;
uniform vec3 forward;    // of the camera
uniform vec3 half_right; // to the middle of the right border of the picture, and of the upper one, one metre ahead
uniform vec3 half_up;
uniform float sun_cosine; // of the disc's radius

out vec4 pixel;

void main()
{
    vec2 at = 2.0 * gl_FragCoord.xy / picture_size - 1.0;
    vec3 direction = normalize(forward + at.x * half_right + at.y * half_up);
    vec3 colour = sky_colour(direction);
    if (dot(direction, towards_sun) > sun_cosine)
        colour += 4.0 * glow;
    pixel = vec4(srgb(soft_clip(colour)), 1.0);
}
