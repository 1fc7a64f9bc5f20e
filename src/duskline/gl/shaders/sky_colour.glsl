// The sky in a direction: paler towards the horizon, warm around a low sun. A drawing, not a model of air.

uniform vec3 towards_sun;
uniform vec3 zenith;
uniform vec3 horizon;
uniform vec3 glow; // around the sun

vec3 sky_colour(vec3 direction)
{
    float up = clamp(direction.z, 0.0, 1.0);
    float near_sun = max(0.0, dot(direction, towards_sun));
    float low = exp(-6.0 * up);
    return mix(zenith, horizon, low) + glow * (0.25 * pow(near_sun, 8.0) + 0.35 * pow(near_sun, 64.0)) * (0.3 + 0.7 * low);
}
