#include <duskline/gl/framebuffer.h>
#include <duskline/gl/picture_uniforms.h>
#include <duskline/gl/read_back.h>
#include <duskline/gl/screen_pass.h>
#include <duskline/gl/silhouette_passes.h>
#include <duskline/gl/terrain_lamps.h>
#include <duskline/gl/terrain_renderer.h>
#include <duskline/gl/terrain_shadow_map.h>

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace duskline::gl {

namespace {

enum Unit : int { mesh_heights, ground, heights, shadow, truth, silhouettes, later = silhouettes + 3 };

constexpr std::size_t kMostLevels = 24; // of the array in terrain.vert.glsl: grids of up to 2^28 cells a side

ProgramDescription with_lookup(std::vector<std::string> stages, const TerrainShadow& shadow,
                               const TerrainLamps* lamps)
{
    std::vector<ShaderDefine> defines;
    if (shadow.silhouettes != nullptr)
        defines = shadow.silhouettes->look_up_defines(Unit::silhouettes);
    if (shadow.map != nullptr)
        defines = shadow.map->look_up_defines();
    if (lamps != nullptr && lamps->shine())
        defines.push_back({"TERRAIN_LAMPS", "1"});
    defines.push_back({"SHADOW_LOOKUP", std::to_string(static_cast<int>(shadow.lookup))});
    return {std::move(stages), std::move(defines)};
}

// What the mesh may not turn into at all begins at infinity, which shaders need not know of.
void set_morph(const Program& program, const std::vector<MorphRange>& ranges)
{
    for (std::size_t level = 0; level < std::min(ranges.size(), kMostLevels); ++level) {
        const bool turns = std::isfinite(ranges[level].end_m);
        // A thousandth early, so that float distances do not fall short.
        const double length_m = 0.999 * ranges[level].end_m - ranges[level].begin_m;
        const std::array<float, 2> morph = {turns ? static_cast<float>(ranges[level].begin_m) : 0.0f,
                                            turns ? static_cast<float>(1.0 / length_m) : 0.0f};
        program.set(("morph[" + std::to_string(level) + "]").c_str(), morph);
    }
}

// As products/lit_fraction.h has it: what a shadow over level ground loses from one corner of a cell to the other.
double drop_over_a_cell_m(const DirectionalLight& light, CellSize cell_size_m)
{
    const double altitude_deg = std::clamp(light.altitude.degrees(), 0.1, 89.0);
    return tangent(Angle::from_degrees(altitude_deg)) * std::hypot(cell_size_m.x, cell_size_m.y);
}

} // namespace

TerrainRenderer::TerrainRenderer(const ShaderSources& sources, const TerrainTextures& terrain)
    : sources_(sources), terrain_(terrain), detail_(terrain.field()),
      sky_(sources, {.stages = {"full_screen.vert.glsl", "sky.frag.glsl"}})
{}

const Program& TerrainRenderer::program(const char* vertex_stage, const char* fragment_stage,
                                        const TerrainShadow& shadow, const TerrainLamps* lamps)
{
    const ProgramDescription description = with_lookup({vertex_stage, fragment_stage}, shadow, lamps);
    std::string key = fragment_stage;
    for (const ShaderDefine& define : description.defines)
        key += " " + define.name + "=" + define.value;
    const auto found = programs_.find(key);
    return found != programs_.end() ? found->second
                                    : programs_.emplace(key, Program(sources_, description)).first->second;
}

void TerrainRenderer::set_lookup(const Program& program, const TerrainShadow& shadow,
                                 double shadow_drop_m) const
{
    terrain_.heights().bind(Unit::heights);
    if (shadow.texture != nullptr)
        shadow.texture->bind(Unit::shadow);
    if (shadow.later != nullptr)
        shadow.later->bind(Unit::later);
    if (shadow.silhouettes != nullptr)
        shadow.silhouettes->bind(program, Unit::silhouettes); // takes three
    program.set("later_shadow", static_cast<int>(Unit::later));
    program.set("later_share", shadow.later_share);
    if (shadow.map != nullptr)
        shadow.map->bind(program, Unit::mesh_heights);
    program.set("heights_m", static_cast<int>(Unit::heights));
    program.set("shadow", static_cast<int>(Unit::shadow));
    program.set("shadow_drop_m", static_cast<float>(shadow_drop_m));
}

void TerrainRenderer::draw_sky(const TerrainView& view, const TerrainLight& light)
{
    const CameraAxes axes = axes_of(view.camera);
    const double half_height = tangent(Angle::from_degrees(view.camera.vertical_view.degrees() / 2.0));
    const double aspect = static_cast<double>(view.width) / static_cast<double>(view.height);
    sky_.use();
    set_sky(sky_, light);
    sky_.set("picture_size",
             std::array<float, 2>{static_cast<float>(view.width), static_cast<float>(view.height)});
    sky_.set("forward", as_floats(axes.forward));
    sky_.set("half_right", as_floats(axes.right * (half_height * aspect)));
    sky_.set("half_up", as_floats(axes.up * half_height));
    const Angle radius = Angle::from_degrees(std::max(0.25, light.light.angular_diameter.degrees() / 2.0));
    sky_.set("sun_cosine", static_cast<float>(sine_cosine(radius).cosine));
    glDisable(GL_DEPTH_TEST);
    no_vertices_.draw(VertexArray::Shape::triangles, 0, 3);
}

DrawnMesh TerrainRenderer::draw(const TerrainView& view, const TerrainLight& light,
                                const TerrainShadow& shadow, const Texture* truth)
{
    draw_sky(view, light);
    return draw_terrain(view, light, shadow, truth);
}

DepthRange TerrainRenderer::depths(const TerrainView& view) const
{
    HeightRange heights = detail_.heights();
    heights.include(view.others);
    return depth_range(view.camera, terrain_.field(), heights);
}

DrawnMesh TerrainRenderer::draw_terrain(const TerrainView& view, const TerrainLight& light,
                                        const TerrainShadow& shadow, const Texture* truth)
{
    const HeightField& field = terrain_.field();
    const double aspect = static_cast<double>(view.width) / static_cast<double>(view.height);
    const DepthRange depth = depths(view);
    const auto ranges = detail_.morph_ranges(pixels_per_radian(view.camera, static_cast<double>(view.height)),
                                             view.pixel_error);
    const std::vector<MeshPatch> patches =
        detail_.select(view.camera.position_m, Frustum(view.camera, aspect, depth.nearest_m), ranges);
    if (patches.empty())
        return {};

    const Program& program = this->program("terrain.vert.glsl", "terrain.frag.glsl", shadow, light.lamps);
    program.use();
    terrain_.mesh_heights().bind(Unit::mesh_heights);
    terrain_.ground().bind(Unit::ground);
    if (truth != nullptr)
        truth->bind(Unit::truth);
    program.set("mesh_heights_m", static_cast<int>(Unit::mesh_heights));
    program.set("ground", static_cast<int>(Unit::ground));
    program.set("truth", static_cast<int>(Unit::truth));
    program.set("show_difference", truth != nullptr ? 1 : 0);
    set_lookup(program, shadow, drop_over_a_cell_m(light.light, field.cell_size_m));
    // Both put places on the casters' mesh, relative to one eye.
    if (light.lamps != nullptr && light.lamps->shine())
        light.lamps->bind(program, shadow.map != nullptr ? shadow.map->eye_m() : view.camera.position_m,
                          Unit::mesh_heights);
    set_light(program, light, field);
    set_eye(program, view.camera, field.cell_size_m);
    set_morph(program, ranges);
    program.set("last_cell", std::array<int, 2>{static_cast<int>(field.columns()) - 1,
                                                static_cast<int>(field.rows()) - 1});
    program.set_matrix("eye_to_clip", eye_to_clip(view.camera, aspect, depth));

    glEnable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    mesh_.draw(patches);
    glDisable(GL_DEPTH_TEST);
    return {patches.size(), patches.size() * PatchMesh::kTrianglesPerPatch};
}

ShadowMask TerrainRenderer::lit_mask(const TerrainShadow& shadow)
{
    const HeightField& field = terrain_.field();
    const Texture answers(TextureFormat::r8, field.columns(), field.rows());
    const Framebuffer framebuffer({&answers});
    const Program& program = this->program("full_screen.vert.glsl", "lit_mask.frag.glsl", shadow);
    set_lookup(program, shadow, 1.0);
    ScreenPass().draw(program, framebuffer);
    const Grid<std::uint8_t> bytes = read_back<std::uint8_t>(answers);
    ShadowMask mask(field.rows(), field.columns());
    for (std::size_t row = 0; row < field.rows(); ++row)
        for (std::size_t column = 0; column < field.columns(); ++column)
            mask(row, column) = std::isnan(field.heights_m(row, column)) ? Lit::unknown
                                : bytes(row, column) != 0                ? Lit::yes
                                                                         : Lit::no;
    return mask;
}

bool TerrainRenderer::reload_if_changed()
{
    bool changed = sky_.reload_if_changed(sources_);
    for (auto& [key, program] : programs_)
        changed = program.reload_if_changed(sources_) || changed;
    return changed;
}

} // namespace duskline::gl
