// How much of the sun's disc is seen from between two shadow heights: below the first nothing, above the second all.
//
// Also compiled as C++, by the tests.

// The part of a disc (radius 1, centre 0) that stands above a level horizon.
float disc_above(float horizon)
{
    float t = clamp(horizon, -1.0f, 1.0f);
    return max(0.0f, 0.5f - (t * sqrt(1.0f - t * t) + asin(t)) / 3.14159265f);
}

// Clearances over both edges of the disc -> its visible part. All of it is seen from above the second shadow height,
// nothing from under the first, and of what is under the horizontal nothing at all.
float visible_disc(vec2 clearance_m, float lowest_limb)
{
    float hidden = clearance_m.y >= 0.0 ? 0.0
                   : clearance_m.x < 0.0 ? 1.0
                   : -clearance_m.y / (clearance_m.x - clearance_m.y);
    return disc_above(mix(lowest_limb, 1.0f, hidden));
}
