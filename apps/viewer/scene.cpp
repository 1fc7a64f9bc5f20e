#include "scene.h"

#include "exit_code.h"
#include "stopwatch.h"

#include <duskline/gl/context.h>
#include <duskline/gl/terrain_shadow_map.h>
#include <duskline/products/daylight.h>
#include <duskline/products/relief.h>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace duskline::viewer {
namespace {

// What techniques that spread their work over frames may take of each.
constexpr std::chrono::milliseconds kAdvanceInAFrame(2);

std::array<float, 3> as_array(const Colour& colour)
{
    return {colour.red, colour.green, colour.blue};
}

bool same(const DirectionalLight& a, const DirectionalLight& b)
{
    return a.azimuth == b.azimuth && a.altitude == b.altitude && a.angular_diameter == b.angular_diameter;
}

// In perspective the forms show by themselves: half of what a map needs.
float usual_exaggeration(const HeightField& field)
{
    const double of_a_map =
        shading_exaggeration(field, {.azimuth = Angle(), .altitude = Angle::from_degrees(25.0)});
    return static_cast<float>(std::clamp(0.5 + 0.5 * of_a_map, 1.0, 2.0));
}

} // namespace

Scene::Scene(ViewedTerrain& viewed, const SunClock& clock, const gl::ShaderSources& sources)
    : viewed_(viewed), clock_(clock), sources_(sources), field_(viewed.ground->terrain()),
      textures_(field_, viewed.ground->colours().view()), renderer_(sources, textures_),
      scenery_(usual_scenery(viewed.ground->at_rest()))
{}

void Scene::choose_technique(const ViewerState& state)
{
    const std::string shadow_map = window::text_of({state.shadow_map.options, {}});
    if (technique_ && technique_name_ == state.technique && soft_ == state.soft && shadow_map_ == shadow_map)
        return;
    const gl::ShadowTechniqueKind& kind = gl::shadow_technique_named(state.technique);
    if (kind.name == window::kShadowMapTechnique)
        technique_ = std::make_unique<gl::TerrainShadowMap>(sources_, textures_, state.shadow_map.options);
    else
        technique_ = kind.make(sources_, textures_, state.soft && kind.has_soft_edges);
    shadow_map_ = shadow_map;
    technique_name_ = state.technique;
    if (soft_ != state.soft)
        object_sweep_.reset();
    soft_ = state.soft;
    cast_light_ = std::nullopt;
    course_asked_ = {};
}

void Scene::set_course(const ViewerState& state)
{
    if (!gl::shadow_technique_named(technique_name_).follows_course)
        return;
    CourseAsked asked = {.maps = state.light_maps};
    if (state.light.time)
        asked.day =
            std::chrono::floor<std::chrono::days>(state.light.time->utc + state.light.time->utc_offset);
    else
        asked.altitude_deg = state.light.altitude_deg;
    if (asked == course_asked_)
        return;
    technique_->set_course(clock_.course(state.light, state.light_maps));
    course_asked_ = asked;
}

namespace {

// Of this run of a pass when it is waited for; else of the one before, if that is known by now.
template <typename Work>
std::optional<double> time_pass(PassTimer& timer, bool wait, const Work& work)
{
    const std::optional<double> before_ms = timer.ran && !wait ? timer.query.milliseconds() : std::nullopt;
    timer.query.begin();
    work();
    timer.query.end();
    timer.ran = true;
    return wait ? timer.query.wait_for_milliseconds() : before_ms;
}

} // namespace

namespace {

bool has_heights(gl::ShadowLookup lookup)
{
    return lookup == gl::ShadowLookup::heights || lookup == gl::ShadowLookup::limbs;
}

bool has_cells(const CellRectangle& rectangle)
{
    return rectangle.rows > 0 && rectangle.columns > 0;
}

template <typename Work>
double milliseconds(const Work& work)
{
    double seconds = 0.0;
    {
        const cli::Stopwatch watch(seconds);
        work();
    }
    return 1000.0 * seconds;
}

} // namespace

FrameCost Scene::cast(const ViewerState& state, std::size_t width, std::size_t height, bool wait)
{
    CellRectangle changed;
    const double ground_ms = milliseconds([&] {
        changed =
            united(std::exchange(edited_, {}), viewed_.ground->move_to(state.animation, state.animation_s));
        if (has_cells(changed))
            upload_ground(changed);
        if (wait)
            gl::wait_until_done();
    });
    choose_technique(state);
    set_course(state);
    technique_->set_look(state.shadow_map.look);
    const bool view_changed = technique_->look_from({state.camera, width, height, state.pixel_error});
    FrameCost cost = cast_changes(changed, clock_.on_grid(state.light), view_changed, wait);
    cost.ground_ms = has_cells(changed) ? ground_ms : 0.0;
    if (cost.cast_ms > 0.0)
        object_heights_ = nullptr;
    if (state.objects)
        cost.cast_ms += cast_for_objects(wait);
    cost.cast_ms += cast_lamps(state, wait);
    if (state.difference)
        true_mask();
    return cost;
}

void Scene::upload_ground(const CellRectangle& changed)
{
    textures_.heights_changed(changed);
    textures_.colours_changed(viewed_.ground->colours().view(), viewed_.ground->repainted(changed));
    renderer_.heights_changed(changed);
    if (lamps_)
        lamps_->heights_changed(changed);
    not_in_truth_ = united(not_in_truth_, changed);
}

// A technique that has cast is told of changes even where the light has moved as well, and casts again.
FrameCost Scene::cast_changes(const CellRectangle& changed, const DirectionalLight& light, bool view_changed,
                              bool wait)
{
    FrameCost cost;
    const bool ground_changed = has_cells(changed);
    const bool must_cast = view_changed || !cast_light_ || !same(*cast_light_, light);
    if (!ground_changed && !must_cast && technique_->done() >= 1.0)
        return cost;
    cost.cast_ms = milliseconds([&] {
        cost.cast_gpu_ms = time_pass(cast_timer_, wait, [&] {
            if (ground_changed && cast_light_)
                technique_->heights_changed(changed);
            if (must_cast)
                technique_->cast(light);
            technique_->advance(kAdvanceInAFrame);
        });
    });
    cast_light_ = light;
    return cost;
}

void Scene::settle()
{
    while (technique_ && technique_->done() < 1.0)
        technique_->advance(kAdvanceInAFrame);
}

// Objects ask for shadow heights. Where the technique leaves none, those of the sweep are found besides.
double Scene::cast_for_objects(bool wait)
{
    if (!objects_)
        objects_.emplace(sources_, textures_, std::move(scenery_));
    const gl::ShadowLookup lookup = technique_->shadow().lookup;
    if (object_heights_ != nullptr || lookup == gl::ShadowLookup::none || has_heights(lookup))
        return 0.0;
    return milliseconds([&] {
        if (!object_sweep_)
            object_sweep_.emplace(sources_, gl::ShadowSweepOptions{.limbs = soft_});
        object_heights_ = &object_sweep_->cast(textures_.heights(), field_.cell_size_m, *cast_light_);
        if (wait)
            gl::wait_until_done();
    });
}

// Draws the maps of lamps that have changed; 0 when none has.
double Scene::cast_lamps(const ViewerState& state, bool wait)
{
    const std::vector<SceneLamp> lamps = shining(state.lamps);
    if (lamps.empty() && !lamps_)
        return 0.0;
    std::size_t drawn = 0;
    const double spent_ms = milliseconds([&] {
        if (!lamps_)
            lamps_.emplace(sources_, textures_);
        drawn = lamps_->update(lamps);
        if (wait && drawn > 0)
            gl::wait_until_done();
    });
    return drawn > 0 ? spent_ms : 0.0;
}

const gl::Texture* Scene::heights_for_objects() const
{
    const gl::TerrainShadow shadow = technique_->shadow();
    if (shadow.lookup == gl::ShadowLookup::none)
        return nullptr;
    return has_heights(shadow.lookup) ? shadow.texture : object_heights_;
}

bool Scene::reload_shaders()
{
    const bool objects = objects_ && objects_->reload_if_changed();
    const bool sweep = object_sweep_ && object_sweep_->reload_if_changed(sources_);
    return renderer_.reload_if_changed() || objects || sweep;
}

FrameCost Scene::draw(const ViewerState& state, std::size_t width, std::size_t height, bool wait)
{
    gl::require_context_kept();
    FrameCost cost;
    gl::TerrainView view = {state.camera, width, height, state.pixel_error};
    const bool with_objects = state.objects && objects_;
    if (with_objects)
        view.others = height_range(objects_->scenery(), renderer_.heights());
    const gl::Texture* truth = state.difference ? truth_->shadow().texture : nullptr;
    cost.draw_gpu_ms = time_pass(draw_timer_, wait, [&] {
        const gl::TerrainLight light = light_of(state);
        cost.mesh = renderer_.draw(view, light, technique_->shadow(), truth);
        if (with_objects)
            objects_->draw(view, renderer_.depths(view), light, heights_for_objects(), state.animation_s);
    });
    return cost;
}

void Scene::stroke(const GridPoint& at, const Brush& brush)
{
    edited_ = united(edited_, viewed_.ground->stroke(at, brush));
}

const ShadowMask& Scene::true_mask()
{
    if (!truth_)
        truth_ = std::make_unique<gl::ExactUpload>(textures_);
    else if (has_cells(not_in_truth_))
        truth_->heights_changed(not_in_truth_);
    not_in_truth_ = {};
    if (!true_light_ || !same(*true_light_, *cast_light_)) {
        truth_->cast(*cast_light_);
        true_light_ = cast_light_;
    }
    return truth_->mask();
}

gl::TerrainLight Scene::light_of(const ViewerState& state) const
{
    gl::TerrainLight light;
    light.light = clock_.on_grid(state.light);
    const Daylight daylight =
        viewed_.air ? clear_daylight(light.light.altitude, static_cast<double>(state.ambient)) : Daylight{};
    light.sun_colour = as_array(daylight.sun);
    light.sky_light = as_array(daylight.sky);
    light.ambient = state.ambient;
    light.exposure = state.exposure;
    light.exaggeration = state.exaggeration;
    light.air = viewed_.air;
    light.lamps = lamps_ ? &*lamps_ : nullptr;
    return light;
}

namespace {

void take_light(const cli::LightOptions& options, ViewerLight& light)
{
    if ((options.azimuth_deg || options.altitude_deg) && options.sun.time)
        throw cli::UsageError("give --azimuth and --altitude, or --time, not both");
    if (options.azimuth_deg || options.altitude_deg)
        light.time = std::nullopt;
    light.azimuth_deg = options.azimuth_deg.value_or(light.azimuth_deg);
    light.altitude_deg = options.altitude_deg.value_or(light.altitude_deg);
    if (options.sun.time)
        light.time = options.sun.time;
}

// Beside those of the state.
void take_lamps(const ViewerOptions& options, const ViewedTerrain& viewed, ViewerState& state)
{
    for (const MapLamp& lamp : options.lamps)
        state.lamps.push_back(placed_lamp(lamp, viewed));
    window::require_lamps_fit(state.lamps.size());
}

} // namespace

ViewerState first_state(const ViewerOptions& options, const ViewedTerrain& viewed, const SunClock& clock)
{
    const HeightField field = viewed.ground->terrain();
    ViewerState state;
    state.camera = overview(field, static_cast<double>(options.width) / static_cast<double>(options.height));
    state.ambient = viewed.ambient;
    state.exaggeration = usual_exaggeration(field);
    if (!options.state.empty())
        state = read_state(options.state, state);
    take_light(options.light, state.light);
    if (options.picture.ambient)
        state.ambient = static_cast<float>(*options.picture.ambient);
    if (!options.technique.empty() && options.technique != "all")
        state.technique = options.technique;
    if (!options.shadow_map.empty())
        state.shadow_map = window::parse_shadow_map(options.shadow_map);
    if (!options.animation.empty())
        state.animation = options.animation;
    state.animation_s = options.animation_s.value_or(state.animation_s);
    state.animation_speed = options.animation_speed.value_or(state.animation_speed);
    state.soft = state.soft || options.soft;
    state.light_maps = options.light_maps.value_or(state.light_maps);
    state.objects = state.objects || options.objects;
    state.difference = state.difference || options.difference;
    take_lamps(options, viewed, state);
    clock.bring_up_to_date(state.light);
    return state;
}

} // namespace duskline::viewer
