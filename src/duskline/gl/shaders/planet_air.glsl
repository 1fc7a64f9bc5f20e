// Air around a planet: how much of it lies along a line, and the light it takes and gives. A drawing, not a model: one
// exponential layer, light scattered once, its amounts chosen to please.
//
//          sun light            along a line that rises by `climb` at its lowest point, heights are
//            \                      h + climb s + s^2 / 2R
//   eye --o---\------- - -      so what lies between two points of it is a difference of error functions:
//        .  lowest point            integral of exp(-(climb s + s^2 / 2R) / H) ds  =  sqrt(pi R H / 2) erfcx(...)
//      '  planet  '
//
// The planet is stretched to a sphere first. Lengths are in scale heights of the air, so 1 is all air above a place.

const float kPi = 3.14159265;
const float kScaleHeight_m = 8000.0;
const vec3 kScattered = vec3(0.024, 0.055, 0.130); // of a ray straight up: red, green and blue

uniform vec3 eye_stretched_m; // from the centre; the polar axis stretched so that the planet is a sphere
uniform float polar_stretch;
uniform float radius_m;
uniform vec3 towards_sun;
uniform bool air;
uniform vec3 sun_colour;

// exp(x^2) erfc(x) for x of 0 or more, within 3 per cent.
float scaled_erfc(float x)
{
    return 2.0 / (sqrt(kPi) * (x + sqrt(x * x + 4.0 / kPi)));
}

// From a height, outwards along a line that climbs so much there (0 to 1).
float air_outwards(float low_m, float climb, float length_m)
{
    float spread_m = sqrt(2.0 * radius_m * kScaleHeight_m);
    float begin = climb * radius_m / spread_m;
    float end = begin + length_m / spread_m;
    float thinner = exp(min(0.0, begin * begin - end * end));
    float all = 0.5 * sqrt(kPi) * (spread_m / kScaleHeight_m) * exp(-max(low_m, 0.0) / kScaleHeight_m);
    return all * max(0.0, scaled_erfc(begin) - thinner * scaled_erfc(end));
}

float height_of(vec3 stretched_m)
{
    return length(stretched_m) - radius_m;
}

// From the eye so far in a direction (stretched both); 1e9 for as far as there is air.
float air_between(vec3 direction, float length_m)
{
    float to_lowest_m = -dot(eye_stretched_m, direction);
    vec3 end_m = eye_stretched_m + length_m * direction;
    if (to_lowest_m <= 0.0)
        return air_outwards(height_of(eye_stretched_m), -to_lowest_m / length(eye_stretched_m), length_m);
    if (to_lowest_m >= length_m)
        return air_outwards(height_of(end_m), (to_lowest_m - length_m) / length(end_m), length_m);
    float low_m = height_of(eye_stretched_m + to_lowest_m * direction);
    return air_outwards(low_m, 0.0, to_lowest_m) + air_outwards(low_m, 0.0, length_m - to_lowest_m);
}

// Light of the sun where the air's upper side or the ground is: warm when it is low, none at night.
vec3 sunlight_at(vec3 outwards, float height_m)
{
    float sine = dot(outwards, towards_sun);
    if (!air)
        return sun_colour;
    vec3 left = exp(-kScattered * air_outwards(height_m, max(sine, 0.0), 1e9));
    return sun_colour * left * smoothstep(-0.10, 0.02, sine);
}

vec3 stretched(vec3 v)
{
    return vec3(v.xy, polar_stretch * v.z);
}

struct Haze {
    vec3 passed; // of what is behind
    vec3 added;
};

// Between the eye and a place relative to it.
Haze haze_before(vec3 from_eye_m)
{
    if (!air)
        return Haze(vec3(1.0), vec3(0.0));
    vec3 line_m = stretched(from_eye_m);
    float length_m = min(length(line_m), 1e9);
    vec3 direction = normalize(line_m);
    vec3 passed = exp(-kScattered * air_between(direction, length_m));
    // Most of the air on the way is around its lowest point.
    float lowest_m = clamp(-dot(eye_stretched_m, direction), 0.0, length_m);
    vec3 middle_m = eye_stretched_m + lowest_m * direction;
    vec3 light = sunlight_at(normalize(middle_m), max(height_of(middle_m), 0.0) + kScaleHeight_m);
    float forward = max(0.0, dot(normalize(from_eye_m), towards_sun));
    // From within, the sky looks brighter than from space, where eyes are used to sunlit ground.
    float brightness = 0.9 + 0.9 * exp(-max(height_of(eye_stretched_m), 0.0) / (3.0 * kScaleHeight_m));
    vec3 glow = light * (brightness + 0.35 * pow(forward, 8.0) + 0.6 * pow(forward, 64.0));
    return Haze(passed, (1.0 - passed) * (glow + vec3(0.004, 0.007, 0.016)));
}
