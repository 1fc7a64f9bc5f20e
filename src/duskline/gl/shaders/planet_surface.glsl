// The surface of a planet as meshes of its tiles, in space relative to the eye, axes planet-fixed.
//
// A tile is a square of a face of the cube around the planet: directions middle + x right + y up, for x and y up to half
// its side. Its heights are 129 x 129 with one more all round. Floats cannot hold places on a planet, so nothing here
// is one: the processor gives where the tile's middle is from the eye, subtracted in double, and what is added to that
// is a difference in closed form, which loses nothing:
//
//     (m + d) / |m + d|  -  m / |m|  =  (d s + m (s - 1)) / |m|,     s = 1 / sqrt(1 + e),  e = (2 m + d) . d / m . m
//     s - 1 = -e / ((1 + e) + sqrt(1 + e))
//
// and the same with the ellipsoid's norm. So corners are right to some 2^-23 of the tile's size, on every level.
//
// Towards the end of its range a tile's mesh turns into its parent's (F. Strugar, Continuous distance-dependent level of
// detail for rendering heightmaps, 2009): every corner moves to where the parent's triangles are, on an edge of them
// half way between two of the parent's corners.

struct PlanetTile {
    vec3 centre_m; // from the eye: the point at the middle, at the reference height
    float step;    // of a square, on the face
    vec3 right;    // of the face, columns; unit
    float reference_m;
    vec3 up; // of the face, rows; unit
    float morph_begin_m;
    vec3 middle; // direction, not normalised: as on the cube of half side 1
    float morph_per_m;
    int layer; // of all texture arrays
    int parent_layer;
    ivec2 in_parent;     // column and row of the parent's corner where this tile begins
    int has_shadow;      // whether its shadow heights are there: 0 or 1
    int parent_has_shadow;
    float second_shadow; // share of the second of its shadows, while the sun moves
    float parent_second_shadow;
};

layout(std430, binding = 0) readonly buffer Tiles
{
    PlanetTile tiles[];
};

uniform int first_tile;  // of those that are drawn at once
uniform float mesh_step; // their mesh has every so many-th corner
uniform sampler2DArray planet_heights_m;
uniform vec3 norm; // 1, 1 and the square of equatorial over polar radius
uniform float equatorial_radius_m;

const int kTileSquares = 128;

// (m + d) over its norm less m over its norm; `by` weighs the squares of the components.
vec3 normalized_difference(vec3 m, vec3 d, vec3 by)
{
    float square = dot(by * m, m);
    float e = dot(by * d, 2.0 * m + d) / square;
    float less_one = -e / ((1.0 + e) + sqrt(1.0 + e));
    return (d * inversesqrt(1.0 + e) + m * less_one) * inversesqrt(square);
}

// From the middle of the tile to the corner, on its face.
vec3 on_face(PlanetTile tile, vec2 corner)
{
    vec2 squares = corner - 0.5 * float(kTileSquares);
    return tile.step * (squares.x * tile.right + squares.y * tile.up);
}

float tile_height_m(int layer, ivec2 corner)
{
    return texelFetch(planet_heights_m, ivec3(corner + 1, layer), 0).r;
}

vec3 point_from_eye_m(PlanetTile tile, vec2 corner, float height_m)
{
    vec3 d = on_face(tile, corner);
    vec3 base_m = equatorial_radius_m * normalized_difference(tile.middle, d, norm);
    vec3 raised_m = tile.reference_m * normalized_difference(tile.middle, d, vec3(1.0));
    return tile.centre_m + base_m + raised_m + (height_m - tile.reference_m) * normalize(tile.middle + d);
}

// Rise of the heights around a corner, columns and rows, metres over two squares.
vec2 tile_rise_m(int layer, ivec2 corner)
{
    return vec2(tile_height_m(layer, corner + ivec2(1, 0)) - tile_height_m(layer, corner - ivec2(1, 0)),
                tile_height_m(layer, corner + ivec2(0, 1)) - tile_height_m(layer, corner - ivec2(0, 1)));
}

// Outwards, from such a rise over `squares` squares of this tile.
vec3 normal_of(PlanetTile tile, vec2 corner, vec2 rise_m, float squares)
{
    vec3 q = tile.middle + on_face(tile, corner);
    float square = dot(norm * q, q);
    vec3 outwards = normalize(q);
    float scale_m = squares * tile.step * equatorial_radius_m * inversesqrt(square);
    vec3 along = scale_m * (tile.right - q * (dot(norm * q, tile.right) / square)) + rise_m.x * outwards;
    vec3 upwards = scale_m * (tile.up - q * (dot(norm * q, tile.up) / square)) + rise_m.y * outwards;
    return normalize(cross(along, upwards));
}

struct PlanetCorner {
    vec3 from_eye_m;
    float height_m;
    float turned; // into the parent: 0 to 1
};

// How far it has turned follows from the place on the parent's mesh, which neighbours of either level know.
PlanetCorner planet_corner(PlanetTile tile, ivec2 corner)
{
    float height_m = tile_height_m(tile.layer, corner);
    vec3 own_m = point_from_eye_m(tile, vec2(corner), height_m);
    if (tile.morph_per_m == 0.0)
        return PlanetCorner(own_m, height_m, 0.0);
    ivec2 a = corner & ~1;
    ivec2 b = corner + (corner & 1);
    float height_a_m = tile_height_m(tile.parent_layer, tile.in_parent + a / 2);
    float height_b_m = tile_height_m(tile.parent_layer, tile.in_parent + b / 2);
    vec3 parent_m = 0.5 * (point_from_eye_m(tile, vec2(a), height_a_m) + point_from_eye_m(tile, vec2(b), height_b_m));
    float turned = clamp((length(parent_m) - tile.morph_begin_m) * tile.morph_per_m, 0.0, 1.0);
    return PlanetCorner(mix(own_m, parent_m, turned), mix(height_m, 0.5 * (height_a_m + height_b_m), turned), turned);
}

vec3 planet_normal(PlanetTile tile, ivec2 corner, float turned)
{
    vec3 own = normal_of(tile, vec2(corner), tile_rise_m(tile.layer, corner), 2.0);
    if (turned == 0.0)
        return own;
    ivec2 a = tile.in_parent + corner / 2;
    ivec2 b = a + (corner & 1);
    vec2 rise_m = 0.5 * (tile_rise_m(tile.parent_layer, a) + tile_rise_m(tile.parent_layer, b));
    return normalize(mix(own, normal_of(tile, vec2(corner), rise_m, 4.0), turned));
}

// Metres that the seams hang down under a tile's border, to hide what rounding and meshes of other steps leave open.
float seam_depth_m(PlanetTile tile)
{
    return mesh_step * tile.step * equatorial_radius_m;
}
