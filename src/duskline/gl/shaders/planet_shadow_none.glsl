// No shadows but those of ground that faces away from the sun.

float planet_shadow(PlanetPlace place)
{
    return 1.0;
}
