#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/planet_renderer.h>
#include <duskline/gl/reversed_depth.h>

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_set>

namespace duskline::gl {

namespace {

enum Unit : int { heights, measured, shadows, second_shadows };

constexpr double kNearest_m = 0.1;

using Float3 = std::array<float, 3>;

Float3 as_floats(const Vector3& v)
{
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

// PlanetTile of planet_surface.glsl, laid out as std430 wants it.
struct TileOnCard {
    Float3 centre_m;
    float step;
    Float3 right;
    float reference_m;
    Float3 up;
    float morph_begin_m;
    Float3 middle;
    float morph_per_m;
    std::int32_t layer;
    std::int32_t parent_layer;
    std::array<std::int32_t, 2> in_parent;
    std::int32_t has_shadow;
    std::int32_t parent_has_shadow;
    float second_shadow;
    float parent_second_shadow;
};
static_assert(sizeof(TileOnCard) == 96);

constexpr std::uint32_t kCornersPerLine = kTileSquares + 1;

// Corner `i` of the border, counted once round: column and row.
std::array<std::uint32_t, 2> border_corner(std::uint32_t i)
{
    constexpr std::uint32_t side = kTileSquares;
    const std::uint32_t along = i % side;
    switch (i / side) {
    case 0:
        return {along, 0};
    case 1:
        return {side, along};
    case 2:
        return {side - along, side};
    default:
        return {0, side - along};
    }
}
constexpr std::uint32_t kBorderCorners = 4 * kTileSquares;

// Column, row and 0; then the border once more with 1: the lower end of the seams.
std::vector<float> patch_corners()
{
    std::vector<float> corners;
    for (std::uint32_t row = 0; row < kCornersPerLine; ++row)
        for (std::uint32_t column = 0; column < kCornersPerLine; ++column)
            corners.insert(corners.end(), {static_cast<float>(column), static_cast<float>(row), 0.0f});
    for (std::uint32_t i = 0; i < kBorderCorners; ++i) {
        const auto [column, row] = border_corner(i);
        corners.insert(corners.end(), {static_cast<float>(column), static_cast<float>(row), 1.0f});
    }
    return corners;
}

// Two triangles a square, counter-clockwise from outside, parted along the diagonal on which the parent's squares are.
void add_squares(std::uint32_t step, std::vector<std::uint32_t>& indices)
{
    // In strips so narrow that cards still know the row before.
    constexpr std::uint32_t strip = 16;
    static_assert(strip % kLargestPatchStep == 0);
    for (std::uint32_t first = 0; first < kTileSquares; first += strip)
        for (std::uint32_t row = 0; row < kTileSquares; row += step)
            for (std::uint32_t column = first; column < first + strip; column += step) {
                const std::uint32_t low = row * kCornersPerLine + column;
                const std::uint32_t high = low + step * kCornersPerLine;
                indices.insert(indices.end(), {low, low + step, high + step, low, high + step, high});
            }
}

void add_seams(std::uint32_t step, std::vector<std::uint32_t>& indices)
{
    const auto upper = [](std::uint32_t i) {
        const auto [column, row] = border_corner(i);
        return row * kCornersPerLine + column;
    };
    const auto lower = [](std::uint32_t i) { return kCornersPerLine * kCornersPerLine + i; };
    for (std::uint32_t i = 0; i < kBorderCorners; i += step) {
        const std::uint32_t next = (i + step) % kBorderCorners;
        indices.insert(indices.end(), {upper(i), lower(i), lower(next), upper(i), lower(next), upper(next)});
    }
}

// All tiles and their parents, each once.
std::vector<PlanetTile> tiles_needed(std::span<const PlanetPatch> patches)
{
    std::unordered_set<PlanetTile> tiles;
    for (const PlanetPatch& patch : patches) {
        tiles.insert(patch.tile);
        if (patch.tile.level > 0)
            tiles.insert(parent_of(patch.tile));
    }
    return {tiles.begin(), tiles.end()};
}

// What has no end does not turn; a thousandth early, so that float distances do not fall short.
void set_morph(TileOnCard& tile, const MorphRange& morph)
{
    if (!std::isfinite(morph.end_m))
        return;
    tile.morph_begin_m = static_cast<float>(morph.begin_m);
    tile.morph_per_m = static_cast<float>(1.0 / (0.999 * morph.end_m - morph.begin_m));
}

} // namespace

// What the pixels tell: PLANET_PROBE of planet.frag.glsl.
struct PlanetRenderer::Asked {
    const char* probe = "0";
    std::size_t lamp = 0;
};

PlanetRenderer::PlanetRenderer(const ShaderSources& sources, const Globe& globe,
                               PlanetTextures::HeightsOf heights_of)
    : sources_(sources), globe_(globe), textures_(std::move(heights_of)),
      depth_(sources, {.stages = {"planet_depth.vert.glsl"}}),
      sky_(sources, {.stages = {"full_screen.vert.glsl", "planet_sky.frag.glsl"}})
{
    require_valid(globe);
    require_reversed_depth();
    corners_.upload(patch_corners());
    std::vector<std::uint32_t> indices;
    for (std::uint32_t step = 1; step <= kLargestPatchStep; step *= 2) {
        const std::size_t first = indices.size();
        add_squares(step, indices);
        add_seams(step, indices);
        meshes_.push_back({step, first, indices.size() - first});
    }
    indices_.upload(indices);
    patch_.set_floats(0, corners_, 3, 3 * sizeof(float));
    patch_.set_indices(indices_);
}

const Program& PlanetRenderer::ground_program(const PlanetLight& light, const PlanetShadow& shadow,
                                              const Asked& asked)
{
    std::vector<ShaderDefine> defines;
    if (shadow.map != nullptr)
        defines = shadow.map->defines();
    const char* kind = shadow.map != nullptr ? "1" : shadow.shadows_of ? "2" : "0";
    defines.push_back({"PLANET_SHADOW", kind});
    if (shadow.shadows_of && shadow.map == nullptr)
        defines.push_back({"PLANET_DISC", shadow.of_disc ? "1" : "0"});
    defines.push_back({"PLANET_LAMPS", light.lamps != nullptr && !light.lamps->lamps().empty() ? "1" : "0"});
    defines.push_back({"PLANET_PROBE", asked.probe});
    std::vector<std::string> key;
    key.reserve(defines.size());
    for (const ShaderDefine& define : defines)
        key.push_back(define.name + "=" + define.value);
    const auto found = ground_programs_.find(key);
    if (found != ground_programs_.end())
        return found->second;
    return ground_programs_
        .emplace(key, Program(sources_, {{"planet.vert.glsl", "planet.frag.glsl"}, defines}))
        .first->second;
}

void PlanetRenderer::hold(std::span<const PlanetPatch> patches, const PlanetShadow& shadow)
{
    const std::vector<PlanetTile> tiles = tiles_needed(patches);
    textures_.hold(tiles);
    if (shadow.shadows_of && shadow.map == nullptr)
        textures_.hold_shadows(tiles, shadow.shadows_of, shadow.of_disc);
}

void PlanetRenderer::upload_tiles(const Vector3& eye_m, std::span<const PlanetPatch> patches)
{
    std::vector<TileOnCard> on_card;
    on_card.reserve(patches.size());
    for (const PlanetPatch& patch : patches) {
        const PlanetTile& tile = patch.tile;
        const PlanetTextures::Layer& own = textures_.layer_of(tile);
        const PlanetTextures::Layer& parent = textures_.layer_of(tile.level > 0 ? parent_of(tile) : tile);
        const CubeFaceAxes face = axes_of_face(tile.face);
        const FacePlace middle = sample_place(tile, kTileSquares / 2.0, kTileSquares / 2.0);
        TileOnCard here = {};
        // The one difference of large numbers, in double.
        here.centre_m =
            as_floats(point_m(globe_, centre_direction(tile), static_cast<double>(own.reference_m)) - eye_m);
        here.step = static_cast<float>(sample_place(tile, 0.0, 1.0).u - sample_place(tile, 0.0, 0.0).u);
        here.right = as_floats(face.right);
        here.reference_m = own.reference_m;
        here.up = as_floats(face.up);
        here.middle = as_floats(face.axis + face.right * middle.u + face.up * middle.v);
        set_morph(here, patch.morph);
        here.layer = own.index;
        here.parent_layer = parent.index;
        here.in_parent = {static_cast<std::int32_t>(tile.column % 2) * kTileSquares / 2,
                          static_cast<std::int32_t>(tile.row % 2) * kTileSquares / 2};
        here.has_shadow = own.has_shadow() ? 1 : 0;
        here.parent_has_shadow = parent.has_shadow() ? 1 : 0;
        here.second_shadow = own.share_of_second;
        here.parent_second_shadow = parent.share_of_second;
        on_card.push_back(here);
    }
    tiles_.upload(on_card);
}

void PlanetRenderer::set_surface(const Program& program) const
{
    const double flattening = globe_.equatorial_radius_m / globe_.polar_radius_m;
    program.set("norm", Float3{1.0f, 1.0f, static_cast<float>(flattening * flattening)});
    program.set("equatorial_radius_m", static_cast<float>(globe_.equatorial_radius_m));
    textures_.heights().bind(Unit::heights);
    textures_.measured().bind(Unit::measured);
    for (std::size_t i = 0; i < 2; ++i)
        if (const TextureArray* array = textures_.shadows(i))
            array->bind(static_cast<unsigned int>(Unit::shadows) + static_cast<unsigned int>(i));
    program.set("planet_heights_m", static_cast<int>(Unit::heights));
    program.set("planet_measured", static_cast<int>(Unit::measured));
    program.set("planet_shadows_m", static_cast<int>(Unit::shadows));
    program.set("planet_second_shadows_m", static_cast<int>(Unit::second_shadows));
}

void PlanetRenderer::set_air(const Program& program, const Vector3& eye_m, const PlanetLight& light) const
{
    const double stretch = globe_.equatorial_radius_m / globe_.polar_radius_m;
    program.set("eye_stretched_m", as_floats({eye_m.x, eye_m.y, stretch * eye_m.z}));
    program.set("polar_stretch", static_cast<float>(stretch));
    program.set("radius_m", static_cast<float>(globe_.equatorial_radius_m));
    program.set("towards_sun", as_floats(light.to_sun));
    program.set("air", light.air ? 1 : 0);
    program.set("sun_colour", light.sun_colour);
    program.set("exposure", light.exposure);
}

void PlanetRenderer::draw_sky(const PlanetView& view, const PlanetLight& light)
{
    const double half_height = tangent(Angle::from_degrees(view.vertical_view.degrees() / 2.0));
    const double aspect = static_cast<double>(view.width) / static_cast<double>(view.height);
    sky_.use();
    set_air(sky_, view.eye_m, light);
    sky_.set("picture_size",
             std::array<float, 2>{static_cast<float>(view.width), static_cast<float>(view.height)});
    sky_.set("forward", as_floats(view.axes.forward));
    sky_.set("half_right", as_floats(view.axes.right * (half_height * aspect)));
    sky_.set("half_up", as_floats(view.axes.up * half_height));
    sky_.set("sun_cosine", static_cast<float>(sine_cosine(light.sun_radius).cosine));
    glDisable(GL_DEPTH_TEST);
    no_vertices_.draw(VertexArray::Shape::triangles, 0, 3);
}

// Those of the same mesh at once.
DrawnPlanet PlanetRenderer::draw_patches(const Program& program, const Vector3& eye_m,
                                         std::span<const PlanetPatch> patches)
{
    std::vector<PlanetPatch> by_step(patches.begin(), patches.end());
    std::ranges::stable_sort(by_step, {}, &PlanetPatch::step);
    upload_tiles(eye_m, by_step);
    tiles_.bind_as_storage(0);
    DrawnPlanet drawn;
    for (const Mesh& mesh : meshes_) {
        const auto count =
            static_cast<std::size_t>(std::ranges::count(by_step, mesh.step, &PlanetPatch::step));
        if (count == 0)
            continue;
        program.set("first_tile", static_cast<int>(drawn.tiles));
        program.set("mesh_step", static_cast<float>(mesh.step));
        patch_.draw_indexed(VertexArray::Shape::triangles, mesh.first_index, mesh.indices, count);
        drawn.tiles += count;
        drawn.triangles += count * mesh.indices / 3;
    }
    return drawn;
}

DrawnPlanet PlanetRenderer::draw(const PlanetView& view, const PlanetLight& light,
                                 std::span<const PlanetPatch> patches, const PlanetShadow& shadow)
{
    draw_sky(view, light);
    return draw_ground(view, light, patches, shadow);
}

DrawnPlanet PlanetRenderer::draw_ground(const PlanetView& view, const PlanetLight& light,
                                        std::span<const PlanetPatch> patches, const PlanetShadow& shadow)
{
    return draw_with({}, view, light, patches, shadow);
}

DrawnPlanet PlanetRenderer::probe_ground(const PlanetView& view, const PlanetLight& light,
                                         std::span<const PlanetPatch> patches, const PlanetShadow& shadow)
{
    return draw_with({.probe = "1"}, view, light, patches, shadow);
}

DrawnPlanet PlanetRenderer::probe_lamp(const PlanetView& view, const PlanetLight& light,
                                       std::span<const PlanetPatch> patches, std::size_t lamp)
{
    if (light.lamps == nullptr || lamp >= light.lamps->lamps().size())
        throw InvalidInput("there is no lamp " + std::to_string(lamp) + " to ask for");
    return draw_with({.probe = "2", .lamp = lamp}, view, light, patches, {});
}

DrawnPlanet PlanetRenderer::draw_with(const Asked& asked, const PlanetView& view, const PlanetLight& light,
                                      std::span<const PlanetPatch> patches, const PlanetShadow& shadow)
{
    hold(patches, shadow);
    const Program& program = ground_program(light, shadow, asked);
    const double aspect = static_cast<double>(view.width) / static_cast<double>(view.height);
    program.use();
    set_surface(program);
    set_air(program, view.eye_m, light);
    program.set_matrix("to_clip", eye_to_reversed_clip(view.axes, view.vertical_view, aspect, kNearest_m));
    program.set("eye_m", as_floats(view.eye_m));
    if (shadow.map != nullptr)
        shadow.map->bind(shadow.map->block(view.eye_m, shadow.look), shadow_map_block_);
    if (light.lamps != nullptr)
        light.lamps->bind(light.lamps->block(view.eye_m), lamp_block_);
    program.set("probed_lamp", static_cast<int>(asked.lamp));
    program.set("ambient", light.ambient);
    program.set("living", light.living ? 1 : 0);
    program.set("show_made", view.show_made ? 1 : 0);
    glDisable(GL_CULL_FACE);
    const ReversedDepth depth;
    return draw_patches(program, view.eye_m, patches);
}

DrawnPlanet PlanetRenderer::draw_depth(const Vector3& eye_m, const Matrix4& to_clip,
                                       std::span<const PlanetPatch> patches)
{
    hold(patches, {});
    depth_.use();
    set_surface(depth_);
    depth_.set_matrix("to_clip", to_clip);
    return draw_patches(depth_, eye_m, patches);
}

bool PlanetRenderer::reload_if_changed()
{
    bool changed = sky_.reload_if_changed(sources_);
    changed = depth_.reload_if_changed(sources_) || changed;
    for (auto& [key, program] : ground_programs_)
        changed = program.reload_if_changed(sources_) || changed;
    return changed;
}

} // namespace duskline::gl
