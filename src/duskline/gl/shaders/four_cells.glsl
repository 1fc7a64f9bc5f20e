// A place on a grid lies between four cells, told in the order of textureGather; rows grow southwards:
//
//       w------z      a place is (column, row) from the centre of cell (0, 0), fractions too;
//       |  x   |      its share of a cell is larger the nearer that is
//       x------y
//
// Also compiled as C++, by the tests.

// How much of each, for a place that lies `rest` of a cell to the right of the left ones and below the upper ones.
vec4 shares_of_four(vec2 rest)
{
    return vec4((1.0f - rest.x) * rest.y, rest.x * rest.y, rest.x * (1.0f - rest.y),
                (1.0f - rest.x) * (1.0f - rest.y));
}

// Cells of which nothing is known (NaN) have no share.
vec4 shares_of_known(vec4 shares, vec4 known)
{
    return mix(shares, vec4(0.0f), isnan(known));
}

// The mean of values, by shares; what has none may be anything. They must not all be 0.
float mean_of_four(vec4 values, vec4 shares)
{
    vec4 counted = mix(values, vec4(0.0f), equal(shares, vec4(0.0f)));
    return dot(counted, shares) / dot(shares, vec4(1.0f));
}
