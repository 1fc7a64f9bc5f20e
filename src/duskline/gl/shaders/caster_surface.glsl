// The surface that shadow maps of a terrain have: a place is put on the triangle of the casters' mesh that it lies over, so
// that both are one surface and ground does not shade itself however coarse the mesh is.
//
//        low ---- east     the mesh's triangles; rows grow southwards
//         |  \     |
//         |    \   |
//       south ---- high

#include "caster_place.glsl"

// From the origin of caster_place.glsl: the eye.
struct CasterSurface {
    vec3 place_m;
    vec3 normal;
};

CasterSurface caster_surface(vec2 cell, int step)
{
    ivec2 last = caster_last_cell();
    vec2 within = clamp(cell, vec2(0.0), vec2(last));
    ivec2 low = min(ivec2(within), max(last - 1, 0)) / step * step;
    ivec2 high = min(low + step, last);
    vec2 rest = (within - vec2(low)) / vec2(max(high - low, ivec2(1)));
    bool south = rest.y > rest.x;
    vec3 first = caster_place(low);
    vec3 corner = caster_place(south ? ivec2(low.x, high.y) : ivec2(high.x, low.y));
    vec3 eastwards = south ? caster_place(high) - corner : corner - first;
    vec3 southwards = south ? corner - first : caster_place(high) - corner;
    return CasterSurface(first + rest.x * eastwards + rest.y * southwards, cross(southwards, eastwards));
}
