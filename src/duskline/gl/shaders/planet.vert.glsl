// The surface of a planet as the eye sees it: see planet_surface.glsl.

#version 430 core
#include "planet_surface.glsl"

layout(location = 0) in vec3 corner; // column and row, 0 to 128; 1 for the lower border of a seam

uniform mat4 to_clip;

out vec3 from_eye_m;
out vec3 normal;
out vec2 at; // column and row in the tile
out float height_m;
out float turned;
flat out ivec4 tile_layers; // layers of the tile and its parent; whether they have shadow heights
flat out ivec2 in_parent;   // where the tile begins there
flat out vec2 second_shadows; // their shares, of the tile's shadows and the parent's

void main()
{
    PlanetTile tile = tiles[first_tile + gl_InstanceID];
    PlanetCorner here = planet_corner(tile, ivec2(corner.xy));
    from_eye_m = here.from_eye_m;
    height_m = here.height_m;
    turned = here.turned;
    normal = planet_normal(tile, ivec2(corner.xy), here.turned);
    at = corner.xy;
    tile_layers = ivec4(tile.layer, tile.parent_layer, tile.has_shadow, tile.parent_has_shadow);
    in_parent = tile.in_parent;
    second_shadows = vec2(tile.second_shadow, tile.parent_second_shadow);
    vec3 outwards = normalize(tile.middle + on_face(tile, corner.xy));
    gl_Position = to_clip * vec4(from_eye_m - corner.z * seam_depth_m(tile) * outwards, 1.0);
}
