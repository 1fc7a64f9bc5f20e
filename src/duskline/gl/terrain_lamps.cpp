#include <duskline/gl/terrain_lamps.h>

namespace duskline::gl {

TerrainLamps::TerrainLamps(const ShaderSources& sources, const TerrainTextures& terrain,
                           const LampMapOptions& options)
    : casters_(sources, terrain), maps_(options)
{}

std::size_t TerrainLamps::update(std::span<const SceneLamp> lamps)
{
    return maps_.update(lamps, [this](const LampFace& face) { casters_.draw(face); });
}

void TerrainLamps::heights_changed(const CellRectangle& rectangle)
{
    casters_.heights_changed(rectangle);
    maps_.casters_changed();
}

void TerrainLamps::bind(const Program& program, const Vector3& eye_m, unsigned int unit) const
{
    casters_.set_places(program, eye_m, unit);
    maps_.bind(maps_.block(eye_m), block_);
}

} // namespace duskline::gl
