// Shadows of a planet from a depth map that goes with the viewer.

#include "shadow_map.glsl"

float planet_shadow(PlanetPlace place)
{
    return shadow_map_factor(place.from_eye_m, place.normal, length(place.from_eye_m));
}

vec4 planet_shadow_overlay(PlanetPlace place, float lit)
{
    return shadow_map_overlay(place.from_eye_m, length(place.from_eye_m), lit);
}
