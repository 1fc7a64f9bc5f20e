#include "fly_by.h"

#include "exit_code.h"
#include "interruption.h"
#include "picture_target.h"
#include "raster_site.h"
#include "scene.h"
#include "stopwatch.h"

#include <duskline/gl/headless_context.h>
#include <duskline/products/mask_difference.h>
#include <duskline/raster_io/write_picture.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <optional>
#include <vector>

namespace duskline::viewer {
namespace {

// Of a flight, frames whose masks are compared with the truth: 7, so that the light of few is that of a map made before.
constexpr std::size_t kCompared = 7;
constexpr std::size_t kTrials = 3;        // of a flight that may take no longer than so much
constexpr double kFramesPerSecond = 25.0; // of animations
constexpr double kClearanceOverCells = 1.0;

// One flight with one technique.
struct Flight {
    std::string technique;
    bool still = false; ///< the light is at rest, and shadows are found before
};

struct FlightFigures {
    std::vector<double> frame_ms;
    double cast_ms = 0.0; ///< sum over the frames
    double ground_ms = 0.0;
    double draw_ms = 0.0; ///< the rest of them
    double triangles = 0.0;
    MaskDifference difference;        ///< of all frames compared
    std::vector<double> black_shares; ///< of silhouette maps, in these frames
};

double mean(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

struct FrameRates {
    double least = 0.0;
    double most = 0.0;
    double mean = 0.0; ///< frames over seconds
};

FrameRates frame_rates(const std::vector<double>& frame_ms)
{
    const auto [shortest, longest] = std::ranges::minmax(frame_ms);
    return {1000.0 / longest, 1000.0 / shortest, 1000.0 / mean(frame_ms)};
}

// The first is what drawing alone costs, and with the light at rest each technique differs from that by its look-up.
std::vector<Flight> flights(const ViewerOptions& options, const ViewerState& state)
{
    if (options.technique != "all")
        return {{state.technique, false}, {state.technique, true}};
    std::vector<Flight> all;
    for (const gl::ShadowTechniqueKind& kind : gl::shadow_techniques()) {
        all.push_back({std::string(kind.name), false});
        if (kind.name != "none")
            all.push_back({std::string(kind.name), true});
    }
    return all;
}

class FlyBy {
public:
    FlyBy(const ViewerOptions& options, ViewedTerrain& viewed, const SunClock& clock,
          const gl::ShaderSources& sources)
        : options_(options), first_(first_state(options, viewed, clock)), scene_(viewed, clock, sources),
          target_(options.width, options.height),
          path_(options.flight.empty() ? usual_flight(
                    scene_.field(), static_cast<double>(options.width) / static_cast<double>(options.height))
                                       : read_flight(options.flight))
    {}

    const ViewerState& first() const { return first_; }

    FlightFigures fly(const Flight& flight)
    {
        FlightFigures figures;
        const std::size_t frames = *options_.flyby_frames;
        warm_up(flight);
        const std::size_t step = frames_from_one_to_the_next(flight);
        const std::size_t apart = step * std::max<std::size_t>(1, frames / step / kCompared);
        for (std::size_t frame = 0; frame < frames; frame += step) {
            cli::stop_if_interrupted();
            fly_frame(flight, frame, figures);
            if (frame % apart == 0)
                compare(figures);
            if (!options_.frames.empty())
                write_frame(flight, frame);
        }
        return figures;
    }

private:
    // 1 unless all would take longer than they may, as some from all parts of the flight tell; at least two are flown.
    std::size_t frames_from_one_to_the_next(const Flight& flight)
    {
        const std::size_t frames = *options_.flyby_frames;
        if (!options_.at_most_s)
            return 1;
        FlightFigures trial;
        double trial_s = 0.0;
        for (std::size_t i = 0; i < kTrials && trial_s < *options_.at_most_s; ++i) {
            // Not the first frame, which comes next: its shadows would be there.
            fly_frame(flight, std::max<std::size_t>(1, (i + 1) * frames / (kTrials + 1)), trial);
            trial_s += trial.frame_ms.back() / 1000.0;
        }
        const double step =
            std::ceil(mean(trial.frame_ms) / 1000.0 * static_cast<double>(frames) / *options_.at_most_s);
        return static_cast<std::size_t>(std::clamp(step, 1.0, static_cast<double>(frames - 1)));
    }

    ViewerState state_at(const Flight& flight, std::size_t frame) const
    {
        const auto frames = static_cast<double>(*options_.flyby_frames);
        ViewerState state = first_;
        state.camera = pose_at(path_, static_cast<double>(frame) / (frames - 1.0));
        state.technique = flight.technique;
        if (!flight.still) {
            state.light.time = std::nullopt;
            state.light.azimuth_deg += 360.0 * static_cast<double>(frame) / frames;
        }
        state.animation_s += state.animation_speed * static_cast<double>(frame) / kFramesPerSecond;
        return state;
    }

    double clearance_m() const
    {
        return kClearanceOverCells * std::max(scene_.field().cell_size_m.x, scene_.field().cell_size_m.y);
    }

    // Shaders are compiled and textures made before anything is timed.
    void warm_up(const Flight& flight)
    {
        ViewerState state = state_at(flight, 0);
        target_.begin();
        if (!flight.still)
            state.light.azimuth_deg += 1.0;
        scene_.cast(state, options_.width, options_.height, true);
        scene_.settle();
        scene_.draw(state, options_.width, options_.height, true);
    }

    void fly_frame(const Flight& flight, std::size_t frame, FlightFigures& figures)
    {
        ViewerState state = state_at(flight, frame);
        FrameCost cast;
        FrameCost drawn;
        double seconds = 0.0;
        {
            const cli::Stopwatch watch(seconds);
            target_.begin();
            cast = scene_.cast(state, options_.width, options_.height, true);
            state.camera = kept_above_ground(state.camera, scene_.field(), clearance_m()); // of this frame
            drawn = scene_.draw(state, options_.width, options_.height, true);
        }
        figures.cast_ms += cast.cast_ms;
        figures.ground_ms += cast.ground_ms;
        figures.draw_ms += 1000.0 * seconds - cast.cast_ms - cast.ground_ms;
        figures.triangles += static_cast<double>(drawn.mesh.triangles);
        figures.frame_ms.push_back(1000.0 * seconds);
    }

    void compare(FlightFigures& figures)
    {
        if (const auto share = scene_.black_share())
            figures.black_shares.push_back(*share);
        MaskDifference& sum = figures.difference;
        const MaskDifference here = mask_difference(scene_.true_mask(), scene_.lit_mask());
        sum.cells += here.cells;
        sum.differing += here.differing;
        sum.false_light += here.false_light;
        sum.false_shadow += here.false_shadow;
    }

    void write_frame(const Flight& flight, std::size_t frame)
    {
        const std::string name =
            fmt::format("{}{}_{:04}.png", flight.technique, flight.still ? "_still" : "", frame);
        write_picture((std::filesystem::path(options_.frames) / name).string(), target_.picture().view(),
                      options_.overwrite);
    }

    const ViewerOptions& options_;
    ViewerState first_;
    Scene scene_;
    window::PictureTarget target_;
    CameraPath path_;
};

// Looking shadows up is what drawing takes longer than without any, where that is known.
nlohmann::ordered_json as_json(const Flight& flight, const FlightFigures& figures,
                               std::optional<double> draw_without_ms)
{
    const FrameRates rates = frame_rates(figures.frame_ms);
    const auto frames = static_cast<double>(figures.frame_ms.size());
    const auto cells = static_cast<double>(figures.difference.cells);
    nlohmann::ordered_json json = {
        {"technique", flight.technique},
        {"light_at_rest", flight.still},
        {"frames", figures.frame_ms.size()},
        {"fps", {{"least", rates.least}, {"most", rates.most}, {"mean", rates.mean}}},
        {"mean_cast_ms", figures.cast_ms / frames},
        {"mean_ground_ms", figures.ground_ms / frames},
        {"mean_draw_ms", figures.draw_ms / frames},
        {"mean_triangles", figures.triangles / frames},
        {"wrong_share", static_cast<double>(figures.difference.differing) / cells},
        {"false_light_share", static_cast<double>(figures.difference.false_light) / cells},
        {"false_shadow_share", static_cast<double>(figures.difference.false_shadow) / cells}};
    if (draw_without_ms)
        json["mean_look_up_ms"] = figures.draw_ms / frames - *draw_without_ms;
    if (!figures.black_shares.empty())
        json["black_share"] = mean(figures.black_shares);
    return json;
}

std::string as_line(const nlohmann::ordered_json& flight)
{
    return fmt::format("{:<22} {:>6} {:9.2f} {:9.2f} {:9.2f} {:10.2f} {:10.2f} {:11.4f} %{}",
                       flight["technique"].get<std::string>()
                           + (flight["light_at_rest"].get<bool>() ? ", at rest" : ""),
                       flight["frames"].get<std::size_t>(), flight["fps"]["least"].get<double>(),
                       flight["fps"]["most"].get<double>(), flight["fps"]["mean"].get<double>(),
                       flight["mean_cast_ms"].get<double>(), flight["mean_draw_ms"].get<double>(),
                       100.0 * flight["wrong_share"].get<double>(),
                       flight.contains("black_share")
                           ? fmt::format(", {:.2f} % Black", 100.0 * flight["black_share"].get<double>())
                           : "");
}

} // namespace

void fly_by(const ViewerOptions& options, cli::Report& report)
{
    window::require_new_report(options);
    const gl::HeadlessContext context;
    const gl::ContextInfo info = gl::current_context();
    ViewedTerrain viewed = read_viewed_terrain(options, report);
    const SunClock clock(cli::light_site(viewed.file.ground()), options.light.sun,
                         options.light.sun_size_deg);
    const gl::ShaderSources sources;
    FlyBy fly_by(options, viewed, clock, sources);

    report.field("renderer", info.renderer);
    report.field("opengl", info.version);
    report.field("terrain", options.input.path);
    const HeightField field = viewed.ground->terrain();
    report.field("rows", field.rows());
    report.field("columns", field.columns());
    report.field("width", options.width);
    report.field("height", options.height);
    report.field("frames", *options.flyby_frames);
    if (options.at_most_s)
        report.field("at_most_s", *options.at_most_s);
    report.field("altitude_deg", fly_by.first().light.altitude_deg);
    report.line(fmt::format("{} x {} cells, {} x {} pixels, {} frames, {}", field.columns(), field.rows(),
                            options.width, options.height, *options.flyby_frames, info.renderer));
    report.line(fmt::format("{:<22} {:>6} {:>9} {:>9} {:>9} {:>10} {:>10} {:>13}", "technique", "frames",
                            "least fps", "most fps", "mean fps", "cast, ms", "draw, ms", "cells wrong"));
    std::optional<double> draw_without_ms;
    for (const Flight& flight : flights(options, fly_by.first())) {
        const auto json = as_json(flight, fly_by.fly(flight), draw_without_ms);
        if (flight.technique == "none")
            draw_without_ms = json["mean_draw_ms"].get<double>();
        report.json()["flights"].push_back(json);
        report.line(as_line(json));
    }
    window::write_report(options, report.json());
}

} // namespace duskline::viewer
