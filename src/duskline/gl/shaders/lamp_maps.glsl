// Light of lamps and searchlights in the shadows of their depth maps, for any renderer: view/scene_lamp.h, gl/lamp_maps.h.
//
//     #include "lamp_maps.glsl"
//     vec3 light = lamp_light(from_eye_m, facing, normal);
//
// Positions are relative to the eye, in the axes of the scene. `facing` is the unit normal that the surface is shaded by,
// `normal` that of the casters' surface there (any length).
//
//       * lamp            Maps keep 1 over the distance ahead, which is a linear function over a map for all points of a
//      /|\                plane: each tap of a kernel is compared with the plane through the place, so that a surface
//     / | \               does not shade itself however obliquely the light falls on it. What remains, the depth between
//    /..|..\ map          the middle of a texel and its corners, is the polygon offset of the casters.
//   /   |   \             Faces of a cube overlap by what kernels need: a place is looked up in one face only.
//
// DUSKLINE_LAMP_TEXTURE, _BLOCK   their units; 10 and 10
//
// Sources: W. Reeves, D. Salesin, R. Cook, Rendering antialiased shadows with depth maps, 1987; J. Isidoro, Shadow mapping:
// GPU-based tips and techniques, 2006 (planes); B. Karis, Real shading in Unreal Engine 4, 2013 (the end of the range).

#ifndef DUSKLINE_LAMP_TEXTURE
#define DUSKLINE_LAMP_TEXTURE 10
#endif
#ifndef DUSKLINE_LAMP_BLOCK
#define DUSKLINE_LAMP_BLOCK 10
#endif

layout(binding = DUSKLINE_LAMP_TEXTURE) uniform sampler2DArrayShadow lamp_depths;
#include "lamp_maps_block.h"

// Of places, by their distance from the eye, and of what is computed from them.
const float kPlaceRounding = 5e-7;
const float kDepthOfLampRounding = 2e-5;

/// Lamps that shine.
int lamp_count()
{
    return lamp_maps.count;
}

// A place and a normal in the axes of a face: right, up and ahead.
struct LampFacePlace {
    vec3 at_m;
    vec3 normal;
    int layer;
};

// Cube: for the face along an axis, the next axis and the one after that become up and right; for the other, right and up.
LampFacePlace lamp_cube_place(LampOnCard lamp, vec3 p, vec3 n)
{
    vec3 size = abs(p);
    int axis = size.x >= max(size.y, size.z) ? 0 : size.y >= size.z ? 1 : 2;
    p = axis == 0 ? p.yzx : axis == 1 ? p.zxy : p;
    n = axis == 0 ? n.yzx : axis == 1 ? n.zxy : n;
    int face = 2 * axis + (p.z > 0.0 ? 0 : 1);
    int layer = face < 4 ? lamp.first_layers[face] : lamp.last_layers[face - 4];
    return p.z > 0.0 ? LampFacePlace(p.yxz, n.yxz, layer)
                     : LampFacePlace(vec3(p.xy, -p.z), vec3(n.xy, -n.z), layer);
}

LampFacePlace lamp_face_place(LampOnCard lamp, vec3 p, vec3 n)
{
    if (lamp.faces != 1)
        return lamp_cube_place(lamp, p, n);
    mat3 axes = mat3(lamp.right.xyz, lamp.up.xyz, lamp.axis.xyz);
    return LampFacePlace(p * axes, n * axes, lamp.first_layers.x);
}

/// What gets through to a place, 0 to 1, of light of a lamp that shines on it.
float lamp_visible(int index, vec3 from_eye_m, vec3 normal)
{
    LampOnCard lamp = lamp_maps.lamps[index];
    LampFacePlace place = lamp_face_place(lamp, from_eye_m - lamp.place.xyz, normal);
    if (place.at_m.z <= 0.0)
        return 1.0; // behind a searchlight
    float ahead_m = place.at_m.z;
    vec2 at = 0.5 + 0.5 * lamp.right.w * place.at_m.xy / ahead_m;
    float rounding_m = kPlaceRounding * (length(from_eye_m) + length(lamp.place.xyz));
    float depth = lamp_maps.nearest_m / ahead_m * (1.0 + kDepthOfLampRounding + rounding_m / ahead_m);
    // How the plane's depth grows over the map; what faces away from the lamp has something before it.
    float towards_m = -dot(place.at_m, place.normal);
    vec2 slope = towards_m > 0.0 ? -2.0 * lamp_maps.nearest_m / (lamp.right.w * towards_m) * place.normal.xy : vec2(0.0);
    float first = -0.5 * float(lamp_maps.taps - 1);
    float sum = 0.0;
    for (int row = 0; row < lamp_maps.taps; ++row)
        for (int column = 0; column < lamp_maps.taps; ++column) {
            vec2 beside = lamp_maps.texel * (first + vec2(column, row));
            // Beyond the plane's horizon there is nothing of it.
            float reference = max(depth + dot(slope, beside), 0.0);
            sum += textureGrad(lamp_depths, vec4(at + beside, place.layer, reference), vec2(0.0), vec2(0.0));
        }
    return sum / float(lamp_maps.taps * lamp_maps.taps);
}

/// Light of a lamp on a surface with nothing between them, white and as if it gave 1 at a distance of 1 m.
float lamp_unshaded(int index, vec3 from_eye_m, vec3 facing)
{
    LampOnCard lamp = lamp_maps.lamps[index];
    vec3 to_lamp_m = lamp.place.xyz - from_eye_m;
    float distance_m = max(length(to_lamp_m), lamp_maps.nearest_m);
    float of_range = distance_m / lamp.place.w;
    float cosine = dot(facing, to_lamp_m) / distance_m;
    if (of_range >= 1.0 || cosine <= 0.0)
        return 0.0;
    float window = 1.0 - of_range * of_range * of_range * of_range;
    float inside = clamp((-dot(lamp.axis.xyz, to_lamp_m) / distance_m - lamp.axis.w) * lamp.light.w, 0.0, 1.0);
    float beam = inside * inside * (3.0 - 2.0 * inside);
    return beam * cosine * window * window / (distance_m * distance_m);
}

/// The light of all lamps on a surface, in suns.
vec3 lamp_light(vec3 from_eye_m, vec3 facing, vec3 normal)
{
    vec3 sum = vec3(0.0);
    for (int i = 0; i < lamp_maps.count; ++i) {
        float unshaded = lamp_unshaded(i, from_eye_m, facing);
        if (unshaded > 0.0)
            sum += lamp_maps.lamps[i].light.rgb * (unshaded * lamp_visible(i, from_eye_m, normal));
    }
    return sum;
}

vec3 lamp_light(vec3 from_eye_m, vec3 facing)
{
    return lamp_light(from_eye_m, facing, facing);
}
