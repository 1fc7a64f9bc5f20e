// No shadows but those of ground that faces away from the sun.

float planet_shadow(PlanetPlace place)
{
    return 1.0;
}

vec4 planet_shadow_overlay(PlanetPlace place, float lit)
{
    return vec4(0.0);
}
