#include <duskline/gl/terrain_renderer.h>
#include <duskline/gl/terrain_shadow_map.h>

#include <algorithm>
#include <cmath>

namespace duskline::gl {

namespace {

double extent_m(const HeightField& field)
{
    return std::hypot(static_cast<double>(field.columns()) * field.cell_size_m.x,
                      static_cast<double>(field.rows()) * field.cell_size_m.y);
}

// The farthest corner of the box round all ground.
double farthest_ground_m(const Vector3& eye_m, const HeightField& field, const HeightRange& heights)
{
    const Vector3 last = position_m({static_cast<double>(field.rows()), static_cast<double>(field.columns()),
                                     static_cast<double>(heights.highest_m)},
                                    field.cell_size_m);
    const double lowest_m = static_cast<double>(heights.lowest_m);
    return length({std::max(std::abs(eye_m.x), std::abs(eye_m.x - last.x)),
                   std::max(std::abs(eye_m.y), std::abs(eye_m.y - last.y)),
                   std::max(std::abs(eye_m.z - lowest_m), std::abs(eye_m.z - last.z))});
}

// Over a terrain that ends somewhere, shadows fade by distance alone.
ShadowMapOptions for_terrain(ShadowMapOptions options, const HeightField& field)
{
    options.fade_from_m = 1e9;
    options.fade_to_m = 2e9;
    options.farthest_caster_m = std::max(1.0, 2.0 * extent_m(field));
    return options;
}

// Between the middle of the picture and its corners.
Angle half_view(const TerrainView& view)
{
    const double aspect = static_cast<double>(view.width) / static_cast<double>(view.height);
    const double half_height = tangent(Angle::from_degrees(view.camera.vertical_view.degrees() / 2.0));
    return Angle::from_radians(std::atan(half_height * std::hypot(1.0, aspect)));
}

bool same(const Vector3& a, const Vector3& b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

} // namespace

TerrainShadowMap::TerrainShadowMap(const ShaderSources& sources, const TerrainTextures& terrain,
                                   const ShadowMapOptions& options)
    : terrain_(terrain), casters_(sources, terrain), map_(sources, for_terrain(options, terrain.field())),
      view_(whole_terrain())
{}

// A ball round all ground, which lies before the fade.
ShadowView TerrainShadowMap::whole_terrain() const
{
    const HeightField& field = terrain_.field();
    const HeightRange heights = casters_.heights();
    const bool has_data = heights.lowest_m <= heights.highest_m;
    const double lowest_m = has_data ? static_cast<double>(heights.lowest_m) : 0.0;
    const double highest_m = has_data ? static_cast<double>(heights.highest_m) : 0.0;
    ShadowView view;
    view.eye_m = position_m({0.5 * static_cast<double>(field.rows()),
                             0.5 * static_cast<double>(field.columns()), 0.5 * (lowest_m + highest_m)},
                            field.cell_size_m);
    view.half_view = Angle::from_degrees(180.0);
    view.clearance_m = std::hypot(extent_m(field), highest_m - lowest_m) / (1.8 * map_.options().reach);
    return view;
}

bool TerrainShadowMap::look_from(const TerrainView& view)
{
    const ShadowView before = view_;
    view_.eye_m = view.camera.position_m;
    view_.forward = axes_of(view.camera).forward;
    view_.half_view = half_view(view);
    view_.clearance_m = std::max(0.0, clearance_m(view.camera.position_m, terrain_.field()));
    return !same(before.eye_m, view_.eye_m) || !same(before.forward, view_.forward)
           || before.half_view != view_.half_view || before.clearance_m != view_.clearance_m;
}

void TerrainShadowMap::cast(const DirectionalLight& light)
{
    require_valid(light);
    lit_ = light.altitude.degrees() > 0.0;
    view_.towards_light = direction_towards(light);
    const HeightRange heights = casters_.heights();
    if (heights.lowest_m <= heights.highest_m) {
        view_.highest_above_eye_m = static_cast<double>(heights.highest_m) - view_.eye_m.z;
        view_.farthest_ground_m = farthest_ground_m(view_.eye_m, terrain_.field(), heights);
    }
    map_.update(view_, [this](const ShadowBox& box) { casters_.draw(box); });
}

void TerrainShadowMap::heights_changed(const CellRectangle& rectangle)
{
    casters_.heights_changed(rectangle);
    map_.casters_changed();
    map_.update(view_, [this](const ShadowBox& box) { casters_.draw(box); });
}

TerrainShadow TerrainShadowMap::shadow() const
{
    TerrainShadow shadow;
    shadow.lookup = ShadowLookup::shadow_map;
    shadow.map = this;
    return shadow;
}

void TerrainShadowMap::bind(const Program& program, unsigned int unit) const
{
    casters_.set_places(program, view_.eye_m, unit);
    program.set("caster_step", static_cast<int>(casters_.step(map_.box())));
    program.set("wide_caster_step", static_cast<int>(casters_.step(map_.widest_box())));
    program.set("light_is_below", lit_ ? 0 : 1);
    map_.bind(map_.block(view_.eye_m, look_), block_);
}

} // namespace duskline::gl
