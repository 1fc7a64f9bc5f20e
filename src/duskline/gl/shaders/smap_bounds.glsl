// What smap_bounds.frag.glsl has found, for the passes that leave silhouettes out.

layout(binding = 3) uniform sampler2D smap_bounds;

vec4 bounds_in(int column, int v)
{
    return texelFetch(smap_bounds, ivec2(column, v), 0);
}

// Whether the ground of a section hides a silhouette from all points on or above it.
bool cannot_shadow(vec4 silhouette, vec4 section)
{
    return silhouette.x <= section.z && silhouette.y <= section.w;
}
