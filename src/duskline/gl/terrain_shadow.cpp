#include <duskline/geometry/cross_product.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/terrain_shadow.h>

#include <algorithm>
#include <cmath>

namespace duskline::gl {

namespace {

// p -> dot(direction, p - origin), in the components of a vec4.
BlockVec4 measured_along(Vector3 direction, Vector3 origin)
{
    return {static_cast<float>(direction.x), static_cast<float>(direction.y), static_cast<float>(direction.z),
            static_cast<float>(-dot(direction, origin))};
}

// Where the horizontal cuts the disc: -1 at its lower edge, 1 at its upper one.
float lowest_limb_of(const DirectionalLight& light)
{
    const double radius = 0.5 * light.angular_diameter.degrees();
    if (!(radius > 0.0))
        return -1.0f;
    return static_cast<float>(std::clamp(-light.altitude.degrees() / radius, -1.0, 1.0));
}

} // namespace

GridPlacement placement_in_metres(CellSize cell_size_m)
{
    return {.column_step = {cell_size_m.x, 0.0, 0.0}, .row_step = {0.0, -cell_size_m.y, 0.0}};
}

TerrainShadowBlock terrain_shadow_block(const GridPlacement& placement, const Texture& shadow_heights,
                                        const DirectionalLight& light)
{
    require_valid(light);
    const auto& [origin, column, row, up] = placement;
    const double volume = dot(column, cross(row, up));
    if (!(std::abs(volume) > 1e-12 * length(column) * length(row) * length(up)))
        throw InvalidInput("column step, row step and metre up of a grid must not lie in one plane");
    TerrainShadowBlock block;
    block.to_column = measured_along(cross(row, up) * (1.0 / volume), origin);
    block.to_row = measured_along(cross(up, column) * (1.0 / volume), origin);
    block.to_height = measured_along(cross(column, row) * (1.0 / volume), origin);
    block.soft = shadow_heights.format() == TextureFormat::rg32f ? 1.0f : 0.0f;
    block.lowest_limb = lowest_limb_of(light);
    return block;
}

void bind_terrain_shadow(const Texture& shadow_heights, const TerrainShadowBlock& block, Buffer& buffer,
                         unsigned int unit)
{
    shadow_heights.bind(unit);
    buffer.upload_block(block);
    buffer.bind_as_uniforms(unit);
}

} // namespace duskline::gl
