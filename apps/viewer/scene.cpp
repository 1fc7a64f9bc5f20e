#include "scene.h"

#include "exit_code.h"
#include "stopwatch.h"

#include <duskline/products/daylight.h>
#include <duskline/products/relief.h>

#include <algorithm>

namespace duskline::viewer {
namespace {

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

Scene::Scene(const ViewedTerrain& viewed, const SunClock& clock, const gl::ShaderSources& sources)
    : viewed_(viewed), clock_(clock), sources_(sources), field_(viewed.terrain),
      textures_(field_, viewed.ground.view()), renderer_(sources, textures_)
{}

void Scene::choose_technique(const ViewerState& state)
{
    if (technique_ && technique_name_ == state.technique && soft_ == state.soft)
        return;
    const gl::ShadowTechniqueKind& kind = gl::shadow_technique_named(state.technique);
    technique_ = kind.make(sources_, textures_, state.soft && kind.has_soft_edges);
    technique_name_ = state.technique;
    soft_ = state.soft;
    cast_light_ = std::nullopt;
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

FrameCost Scene::cast(const ViewerState& state, bool wait)
{
    FrameCost cost;
    choose_technique(state);
    const DirectionalLight light = clock_.on_grid(state.light);
    if (!cast_light_ || !same(*cast_light_, light)) {
        double seconds = 0.0;
        {
            const cli::Stopwatch watch(seconds);
            cost.cast_gpu_ms = time_pass(cast_timer_, wait, [&] { technique_->cast(light); });
        }
        cost.cast_ms = 1000.0 * seconds;
        cast_light_ = light;
    }
    if (state.difference)
        true_mask();
    return cost;
}

FrameCost Scene::draw(const ViewerState& state, std::size_t width, std::size_t height, bool wait)
{
    FrameCost cost;
    const gl::TerrainView view = {state.camera, width, height, state.pixel_error};
    const gl::Texture* truth = state.difference ? truth_->shadow().texture : nullptr;
    cost.draw_gpu_ms = time_pass(draw_timer_, wait, [&] {
        cost.mesh = renderer_.draw(view, light_of(state), technique_->shadow(), truth);
    });
    return cost;
}

void Scene::heights_changed(const CellRectangle& rectangle)
{
    textures_.heights_changed(rectangle);
    renderer_.heights_changed(rectangle);
    if (technique_)
        technique_->heights_changed(rectangle);
    if (truth_)
        truth_->heights_changed(rectangle);
}

const ShadowMask& Scene::true_mask()
{
    if (!truth_)
        truth_ = std::make_unique<gl::ExactUpload>(textures_);
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

} // namespace

ViewerState first_state(const ViewerOptions& options, const ViewedTerrain& viewed, const SunClock& clock)
{
    const HeightField field = viewed.terrain;
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
    state.soft = state.soft || options.soft;
    state.difference = state.difference || options.difference;
    clock.bring_up_to_date(state.light);
    return state;
}

} // namespace duskline::viewer
