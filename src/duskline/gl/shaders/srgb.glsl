// From light to the numbers of a screen.

// Bright light is held below white: the identity up to 0.65, 1 at infinity.
vec3 soft_clip(vec3 light)
{
    vec3 bent = 1.0 - 0.35 * exp((0.65 - light) / 0.35);
    return mix(light, bent, greaterThan(light, vec3(0.65)));
}

vec3 srgb(vec3 light)
{
    vec3 low = 12.92 * light;
    vec3 high = 1.055 * pow(max(light, 0.0), vec3(1.0 / 2.4)) - 0.055;
    vec3 encoded = mix(high, low, lessThan(light, vec3(0.0031308)));
    // A fixed noise hides the steps between bytes.
    float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
    return encoded + (noise - 0.5) / 255.0;
}
