// Shadows of a planet from a depth map that goes with the viewer.

#include "shadow_map.glsl"

// Of the triangle itself, which is what casts; the place's own normal goes on from triangle to triangle, and where it
// still faces the light the triangle may not.
vec3 facet_normal(vec3 from_eye_m, vec3 outwards)
{
    vec3 facet = cross(dFdx(from_eye_m), dFdy(from_eye_m));
    return dot(facet, outwards) < 0.0 ? -facet : facet;
}

float planet_shadow(PlanetPlace place)
{
    return shadow_map_factor(place.from_eye_m, facet_normal(place.from_eye_m, place.normal), length(place.from_eye_m));
}

vec4 planet_shadow_overlay(PlanetPlace place, float lit)
{
    return shadow_map_overlay(place.from_eye_m, length(place.from_eye_m), lit);
}
