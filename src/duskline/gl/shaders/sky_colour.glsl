// The sky in a direction: paler towards the horizon, warm around a low sun; below the horizon darker again, so that the
// borders of a terrain stand out. A drawing, not a model of air.

uniform vec3 towards_sun;
uniform vec3 zenith;
uniform vec3 horizon;
uniform vec3 glow; // around the sun

vec3 sky_colour(vec3 direction)
{
    float up = clamp(direction.z, 0.0, 1.0);
    float near_sun = max(0.0, dot(direction, towards_sun));
    float low = exp(-6.0 * up);
    float below = 1.0 - 0.5 * smoothstep(0.0, 0.9, -direction.z);
    return below * mix(zenith, horizon, low) + glow * (0.25 * pow(near_sun, 8.0) + 0.35 * pow(near_sun, 64.0)) * (0.3 + 0.7 * low);
}
