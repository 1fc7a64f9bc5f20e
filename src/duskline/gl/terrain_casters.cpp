#include <duskline/gl/terrain_casters.h>

#include <array>
#include <cmath>

namespace duskline::gl {

namespace {

constexpr double kErrorInTexels = 0.25;
constexpr unsigned int kHeightsUnit = 0;

} // namespace

TerrainCasters::TerrainCasters(const ShaderSources& sources, const TerrainTextures& terrain)
    : terrain_(terrain), detail_(terrain.field()), ground_(sources, {.stages = {"terrain_depth.vert.glsl"}}),
      skirt_(sources, {.stages = {"terrain_skirt.vert.glsl"}})
{}

std::size_t TerrainCasters::level(const ShadowBox& box) const
{
    std::size_t level = 0;
    while (level + 1 < detail_.levels() && detail_.error_m(level + 1) <= kErrorInTexels * box.texel_m)
        ++level;
    return level;
}

void TerrainCasters::draw(const ShadowBox& box)
{
    const auto wanted = [&](const Box& ground) { return may_cast_into(box, ground); };
    draw(level(box), detail_.patches_of(level(box), wanted), box_to_clip(box, box.centre_m), box.centre_m,
         2.0 * box.texel_m);
}

void TerrainCasters::draw(const LampFace& face)
{
    const auto wanted = [&](const Box& ground) { return may_cast_into(face, ground); };
    draw(0, detail_.patches_of(0, wanted), face_to_clip(face, face.lamp_m), face.lamp_m,
         length({terrain_.field().cell_size_m.x, terrain_.field().cell_size_m.y, 0.0}));
}

// The walls under the borders hang down so far below all ground.
void TerrainCasters::draw(std::size_t level, const std::vector<MeshPatch>& patches, const Matrix4& to_clip,
                          const Vector3& origin_m, double hang_m)
{
    if (patches.empty())
        return;
    const std::size_t step = std::size_t{1} << level;
    for (const Program* program : {&ground_, &skirt_}) {
        program->set_matrix("to_clip", to_clip);
        program->set("caster_step", static_cast<int>(step));
        set_places(*program, origin_m, kHeightsUnit);
    }
    skirt_.set("bottom_m", static_cast<float>(static_cast<double>(heights().lowest_m) - hang_m - origin_m.z));
    ground_.use();
    mesh_.draw(patches);
    draw_skirt(step);
}

void TerrainCasters::draw_skirt(std::size_t step) const
{
    const HeightField& field = terrain_.field();
    skirt_.use();
    for (const int border : {0, 1, 2, 3}) {
        const std::size_t cells = border < 2 ? field.columns() : field.rows();
        skirt_.set("border", border);
        no_vertices_.draw(VertexArray::Shape::triangle_strip, 0, 2 * ((cells - 1) / step + 2));
    }
}

void TerrainCasters::set_places(const Program& program, const Vector3& origin_m, unsigned int unit) const
{
    const CellSize cell_size_m = terrain_.field().cell_size_m;
    const GridPoint origin = grid_point(origin_m, cell_size_m);
    const std::array<double, 2> whole = {std::floor(origin.column), std::floor(origin.row)};
    terrain_.mesh_heights().bind(unit);
    program.set("caster_heights_m", static_cast<int>(unit));
    program.set("caster_cell_size_m",
                std::array<float, 2>{static_cast<float>(cell_size_m.x), static_cast<float>(cell_size_m.y)});
    program.set("caster_origin_cell",
                std::array<int, 2>{static_cast<int>(whole[0]), static_cast<int>(whole[1])});
    program.set("caster_origin_in_cell", std::array<float, 2>{static_cast<float>(origin.column - whole[0]),
                                                              static_cast<float>(origin.row - whole[1])});
    program.set("caster_origin_height_m", static_cast<float>(origin.height_m));
}

} // namespace duskline::gl
