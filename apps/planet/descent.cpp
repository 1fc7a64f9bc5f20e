#include "descent.h"

#include "descent_figures.h"
#include "ground_probe.h"
#include "interruption.h"
#include "lamp_errors.h"
#include "picture_target.h"
#include "planet_files.h"
#include "planet_frame.h"
#include "shadow_truth.h"
#include "shadow_variants.h"

#include <duskline/gl/headless_context.h>
#include <duskline/planet/planet_flight.h>
#include <duskline/raster_io/write_picture.h>

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <filesystem>
#include <iterator>
#include <vector>

namespace duskline::planet_app {
namespace {

// What frames of a window may do, too.
constexpr FrameBudget kBudget = {};

// One flight down, drawn in every frame by every variant.
class Descent {
public:
    Descent(const PlanetOptions& options, const ViewedPlanet& viewed, const gl::ShaderSources& sources,
            const std::vector<ShadowVariant>& variants)
        : options_(options), viewed_(viewed), sources_(sources), variants_(variants),
          first_(first_state(options, *viewed.terrain)), target_(options.width, options.height)
    {
        for (const ShadowVariant& variant : variants)
            figures_.emplace_back(variant.name);
    }

    // How right the shadows are: in so many frames of the way down, everything there.
    void compare()
    {
        if (options_.errors == 0)
            return;
        PlanetScene scene(viewed_, sources_, first_.square_pixels, execution());
        std::deque<PlanetShadowing> shadowings = new_shadowings(scene);
        const GroundProbe probe(options_.width, options_.height);
        for (std::size_t pose = 0; pose < options_.errors; ++pose) {
            cli::stop_if_interrupted();
            const std::size_t frame = pose * (*options_.flydown_frames - 1) / (options_.errors - 1);
            const PlanetState first = state_at(variants_.front(), frame);
            const ProbedPicture seen = probe.settled(scene, shadowings.front(), first);
            PictureTruth truth(*viewed_.terrain, sunlight(first.sun.direction), first.camera.eye_m,
                               scene.quadtree().patches(), seen, options_.errors_step, execution());
            figures_.front().note(band_at(first), truth.errors_of(seen));
            for (std::size_t i = 1; i < variants_.size(); ++i)
                figures_[i].note(band_at(first), truth.errors_of(probe.settled(
                                                     scene, shadowings[i], state_at(variants_[i], frame))));
        }
    }

    // The same of the shadows of lamps.
    LampErrors lamp_errors() const
    {
        LampErrors errors(first_.lamps);
        if (first_.lamps.empty() || options_.errors == 0)
            return errors;
        PlanetScene scene(viewed_, sources_, first_.square_pixels, execution());
        const GroundProbe probe(options_.width, options_.height);
        for (std::size_t pose = 0; pose < options_.errors; ++pose) {
            cli::stop_if_interrupted();
            const std::size_t frame = pose * (*options_.flydown_frames - 1) / (options_.errors - 1);
            errors.compare(scene, probe, state_at({}, frame), options_.errors_step);
        }
        return errors;
    }

    void fly()
    {
        PlanetScene scene(viewed_, sources_, first_.square_pixels, execution());
        std::deque<PlanetShadowing> shadowings = new_shadowings(scene);
        // Shaders are compiled and the first tiles read before anything is timed.
        for (std::size_t i = 0; i < variants_.size(); ++i) {
            target_.begin();
            draw_settled(scene, shadowings[i], state_at(variants_[i], 0), options_.width, options_.height);
        }
        for (std::size_t frame = 0; frame < *options_.flydown_frames; ++frame) {
            cli::stop_if_interrupted();
            fly_frame(scene, shadowings, frame);
        }
    }

    const std::vector<DescentFigures>& figures() const { return figures_; }
    const FrameTimes& load_ms() const { return load_ms_; }
    /// Of drawing lamps' maps; nothing without lamps.
    const FrameTimes* lamps_ms() const { return first_.lamps.empty() ? nullptr : &lamps_ms_; }

private:
    Execution execution() const { return {.threads = options_.run.threads, .progress = {}}; }

    std::deque<PlanetShadowing> new_shadowings(PlanetScene& scene) const
    {
        std::deque<PlanetShadowing> shadowings; // which stay where they are
        for (std::size_t i = 0; i < variants_.size(); ++i)
            shadowings.emplace_back(scene);
        return shadowings;
    }

    // Another variant is first in each frame, so that none profits from what others have left in caches.
    void fly_frame(PlanetScene& scene, std::deque<PlanetShadowing>& shadowings, std::size_t frame)
    {
        const PlanetState any = state_at(variants_.front(), frame);
        const double load_ms = load_tiles(scene, any, options_.width, options_.height, kBudget, true);
        const double lamps_ms = light_lamps(scene, any, false, true);
        std::vector<FrameCost> costs(variants_.size());
        for (std::size_t i = 0; i < variants_.size(); ++i) {
            const std::size_t which = (frame + i) % variants_.size();
            target_.begin();
            costs[which] = draw_loaded(scene, shadowings[which], state_at(variants_[which], frame),
                                       options_.width, options_.height, kBudget, true);
            costs[which].load_ms = load_ms;
            costs[which].lamps_ms = lamps_ms;
            if (!options_.frames.empty())
                write_frame(variants_[which], frame);
        }
        note(band_at(any), costs);
    }

    void note(std::size_t band, const std::vector<FrameCost>& costs)
    {
        load_ms_.note(band, costs.front().load_ms);
        lamps_ms_.note(band, costs.front().lamps_ms);
        const auto none = std::ranges::find(variants_, PlanetTechnique::none, &ShadowVariant::technique);
        const FrameCost* without_shadows =
            none != variants_.end() ? &costs[static_cast<std::size_t>(none - variants_.begin())] : nullptr;
        for (std::size_t i = 0; i < costs.size(); ++i)
            figures_[i].note(band, costs[i], without_shadows);
    }

    std::size_t band_at(const PlanetState& state) const
    {
        return descent_band(clearance_m(state.camera, *viewed_.terrain));
    }

    PlanetState state_at(const ShadowVariant& variant, std::size_t frame) const
    {
        const FlyDown flight = {.place = options_.pose.place,
                                .from_m = 1000.0 * options_.from_km,
                                .to_m = options_.to_m,
                                .heading = options_.pose.heading,
                                .last_pitch = options_.pose.pitch,
                                .vertical_view = options_.pose.vertical_view};
        PlanetState state = first_;
        const auto last = static_cast<double>(*options_.flydown_frames - 1);
        state.camera = duskline::fly_down(*viewed_.terrain, flight, static_cast<double>(frame) / last);
        state.technique = variant.technique;
        state.shadow_map = variant.shadow_map;
        return state;
    }

    void write_frame(const ShadowVariant& variant, std::size_t frame) const
    {
        const std::string name = fmt::format("{}_{:04}.png", variant.name, frame);
        write_picture((std::filesystem::path(options_.frames) / name).string(), target_.picture().view(),
                      options_.overwrite);
    }

    const PlanetOptions& options_;
    const ViewedPlanet& viewed_;
    const gl::ShaderSources& sources_;
    const std::vector<ShadowVariant>& variants_;
    PlanetState first_;
    window::PictureTarget target_;
    FrameTimes load_ms_;
    FrameTimes lamps_ms_;
    std::vector<DescentFigures> figures_; ///< of the variants
};

std::string ms(const nlohmann::ordered_json& figures, const char* times, const char* which)
{
    return figures.contains(times) ? fmt::format("{:.1f}", figures[times][which].get<double>()) : "";
}

std::string share(const nlohmann::ordered_json& figures, const char* name)
{
    return figures.contains("errors") ? fmt::format("{:.2f} %", 100.0 * figures["errors"][name].get<double>())
                                      : "";
}

std::string as_line(const std::string& name, const nlohmann::ordered_json& figures)
{
    return fmt::format("{:<20} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}", name,
                       ms(figures, "frame_ms", "median"), ms(figures, "frame_ms", "p99"),
                       ms(figures, "cast_ms", "median"), ms(figures, "cast_ms", "mean"),
                       ms(figures, "cast_ms", "p99"), ms(figures, "draw_ms", "median"),
                       ms(figures, "draw_ms", "p99"), ms(figures, "shadow_ms", "median"),
                       share(figures, "wrong_share"), share(figures, "wrong_apart_share"));
}

void report_way(cli::Report& report, const PlanetOptions& options, const std::string& renderer)
{
    report.field("width", options.width);
    report.field("height", options.height);
    report.field("frames", *options.flydown_frames);
    report.field("from_km", options.from_km);
    report.field("to_m", options.to_m);
    report.field("error_frames", options.errors);
    report.line(fmt::format("{} x {} pixels, {} frames from {} km to {} m, {}", options.width, options.height,
                            *options.flydown_frames, options.from_km, options.to_m, renderer));
}

// What is done once a frame for all techniques.
void report_shared(cli::Report& report, const char* name, const std::string& what, const FrameTimes& ms)
{
    const auto all = ms.as_json();
    report.json()[name] = all;
    report.line(fmt::format("{} once a frame for all: median {:.1f} ms, 99 of 100 frames at most {:.1f} ms",
                            what, all["median"].get<double>(), all["p99"].get<double>()));
}

void report_heading(cli::Report& report)
{
    report.line(fmt::format("{:<20} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}",
                            "median, ms", "frame", "99 %", "cast", "mean", "99 %", "draw", "99 %", "shadows",
                            "wrong", "apart"));
}

void report_flight(cli::Report& report, const nlohmann::ordered_json& flight)
{
    report.json()["descents"].push_back(flight);
    report.line(fmt::format("{}, {:.1f} to {:.1f} frames a second, {:.0f} triangles, all there in {:.0f} %",
                            as_line(flight["technique"], flight), flight["fps"]["least"].get<double>(),
                            flight["fps"]["most"].get<double>(), flight["mean_triangles"].get<double>(),
                            100.0 * flight["settled_share"].get<double>()));
    for (const auto& band : flight["bands"])
        report.line(as_line("  " + band["band"].get<std::string>(), band));
}

std::vector<ShadowVariant> variants_of(const PlanetOptions& options, const PlanetState& usual)
{
    std::vector<ShadowVariant> variants = shadow_techniques(usual.shadow_map);
    if (options.variants)
        std::ranges::move(shadow_map_variants(usual.shadow_map), std::back_inserter(variants));
    if (options.technique == "all")
        return variants;
    const std::string wanted(options.technique.empty() ? name_of(usual.technique) : options.technique);
    std::erase_if(variants, [&](const ShadowVariant& variant) { return variant.name != wanted; });
    return variants;
}

} // namespace

void fly_down(const PlanetOptions& options, cli::Report& report)
{
    window::require_new_report(options);
    const gl::HeadlessContext context;
    const gl::ContextInfo info = gl::current_context();
    const ViewedPlanet viewed = read_viewed_planet(options, report);
    const gl::ShaderSources sources;
    const std::vector<ShadowVariant> variants = variants_of(options, options.look);
    Descent descent(options, viewed, sources, variants);

    report.field("renderer", info.renderer);
    report.field("opengl", info.version);
    report_way(report, options, info.renderer);
    descent.compare();
    descent.fly();
    report_shared(report, "load_ms", "Tiles are chosen and read", descent.load_ms());
    report.json()["bands"] = bands_as_json(descent.load_ms());
    if (const FrameTimes* lamps_ms = descent.lamps_ms())
        report_shared(report, "lamps_ms", "Maps of lamps are drawn", *lamps_ms);
    report_heading(report);
    for (const DescentFigures& figures : descent.figures())
        report_flight(report, figures.as_json());
    descent.lamp_errors().add_to(report);
    window::write_report(options, report.json());
}

} // namespace duskline::planet_app
