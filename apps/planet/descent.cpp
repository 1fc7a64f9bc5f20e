#include "descent.h"

#include "interruption.h"
#include "picture_target.h"
#include "planet_files.h"
#include "planet_scene.h"

#include <duskline/gl/headless_context.h>
#include <duskline/planet/planet_flight.h>
#include <duskline/raster_io/write_picture.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <vector>

namespace duskline::planet_app {
namespace {

// What frames of a window may do, too.
constexpr FrameBudget kBudget = {};

struct DescentFigures {
    std::vector<double> frame_ms;
    double load_ms = 0.0; ///< sums over the frames
    double cast_ms = 0.0;
    double draw_ms = 0.0;
    double triangles = 0.0;
    std::size_t settled = 0; ///< frames in which all was there that the view wants
};

class Descent {
public:
    Descent(const PlanetOptions& options, const ViewedPlanet& viewed, const gl::ShaderSources& sources)
        : options_(options), viewed_(viewed), sources_(sources),
          first_(first_state(options, *viewed.terrain)), target_(options.width, options.height)
    {}

    DescentFigures fly(PlanetTechnique technique) const
    {
        PlanetScene scene(viewed_, sources_, first_.square_pixels,
                          {.threads = options_.run.threads, .progress = {}});
        DescentFigures figures;
        // Shaders are compiled and the first tiles read before anything is timed.
        target_.begin();
        scene.draw_settled(state_at(technique, 0), options_.width, options_.height);
        for (std::size_t frame = 0; frame < *options_.flydown_frames; ++frame) {
            cli::stop_if_interrupted();
            target_.begin();
            note(scene.draw(state_at(technique, frame), options_.width, options_.height, kBudget, true),
                 figures);
            if (!options_.frames.empty())
                write_frame(technique, frame);
        }
        return figures;
    }

private:
    PlanetState state_at(PlanetTechnique technique, std::size_t frame) const
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
        state.technique = technique;
        return state;
    }

    static void note(const FrameCost& cost, DescentFigures& figures)
    {
        figures.load_ms += cost.load_ms;
        figures.cast_ms += cost.cast_ms;
        figures.draw_ms += cost.draw_ms;
        figures.frame_ms.push_back(cost.load_ms + cost.cast_ms + cost.draw_ms);
        figures.triangles += static_cast<double>(cost.drawn.triangles);
        figures.settled += cost.settled ? 1U : 0U;
    }

    void write_frame(PlanetTechnique technique, std::size_t frame) const
    {
        const std::string name = fmt::format("{}_{:04}.png", name_of(technique), frame);
        write_picture((std::filesystem::path(options_.frames) / name).string(), target_.picture().view(),
                      options_.overwrite);
    }

    const PlanetOptions& options_;
    const ViewedPlanet& viewed_;
    const gl::ShaderSources& sources_;
    PlanetState first_;
    window::PictureTarget target_;
};

nlohmann::ordered_json as_json(PlanetTechnique technique, const DescentFigures& figures)
{
    const auto [shortest, longest] = std::ranges::minmax(figures.frame_ms);
    const double sum_ms = std::accumulate(figures.frame_ms.begin(), figures.frame_ms.end(), 0.0);
    const auto frames = static_cast<double>(figures.frame_ms.size());
    return {{"technique", name_of(technique)},
            {"frames", figures.frame_ms.size()},
            {"fps",
             {{"least", 1000.0 / longest}, {"most", 1000.0 / shortest}, {"mean", 1000.0 * frames / sum_ms}}},
            {"mean_load_ms", figures.load_ms / frames},
            {"mean_cast_ms", figures.cast_ms / frames},
            {"mean_draw_ms", figures.draw_ms / frames},
            {"mean_triangles", figures.triangles / frames},
            {"settled_share", static_cast<double>(figures.settled) / frames}};
}

std::string as_line(const nlohmann::ordered_json& flight)
{
    return fmt::format("{:<12} {:9.2f} {:9.2f} {:9.2f} {:10.2f} {:10.2f} {:10.2f} {:12.0f} {:8.0f} %",
                       flight["technique"].get<std::string>(), flight["fps"]["least"].get<double>(),
                       flight["fps"]["most"].get<double>(), flight["fps"]["mean"].get<double>(),
                       flight["mean_load_ms"].get<double>(), flight["mean_cast_ms"].get<double>(),
                       flight["mean_draw_ms"].get<double>(), flight["mean_triangles"].get<double>(),
                       100.0 * flight["settled_share"].get<double>());
}

void require_places(const PlanetOptions& options)
{
    if (!options.report.empty() && !options.overwrite && std::filesystem::exists(options.report))
        throw OutputError(fmt::format("'{}' is there already: --overwrite replaces it", options.report));
    if (!options.frames.empty() && !std::filesystem::is_directory(options.frames))
        throw OutputError(fmt::format("--frames: there is no folder '{}'", options.frames));
}

void write_report(const std::string& path, const nlohmann::ordered_json& json)
{
    std::ofstream file(path);
    file << json.dump(2) << '\n';
    file.close();
    if (!file)
        throw OutputError(fmt::format("cannot write '{}'", path));
}

std::vector<PlanetTechnique> techniques_of(const PlanetOptions& options, const PlanetState& usual)
{
    if (options.technique != "all")
        return {options.technique.empty() ? usual.technique : technique_named(options.technique)};
    std::vector<PlanetTechnique> all;
    for (const TechniqueName& known : planet_techniques())
        all.push_back(known.technique);
    return all;
}

} // namespace

void fly_down(const PlanetOptions& options, cli::Report& report)
{
    require_places(options);
    const gl::HeadlessContext context;
    const gl::ContextInfo info = gl::current_context();
    const ViewedPlanet viewed = read_viewed_planet(options, report);
    const gl::ShaderSources sources;
    const Descent descent(options, viewed, sources);

    report.field("renderer", info.renderer);
    report.field("opengl", info.version);
    report.field("width", options.width);
    report.field("height", options.height);
    report.field("frames", *options.flydown_frames);
    report.field("from_km", options.from_km);
    report.field("to_m", options.to_m);
    report.line(fmt::format("{} x {} pixels, {} frames from {} km to {} m, {}", options.width, options.height,
                            *options.flydown_frames, options.from_km, options.to_m, info.renderer));
    report.line(fmt::format("{:<12} {:>9} {:>9} {:>9} {:>10} {:>10} {:>10} {:>12} {:>10}", "technique",
                            "least fps", "most fps", "mean fps", "load, ms", "cast, ms", "draw, ms",
                            "triangles", "all there"));
    for (const PlanetTechnique technique : techniques_of(options, options.look)) {
        const auto json = as_json(technique, descent.fly(technique));
        report.json()["descents"].push_back(json);
        report.line(as_line(json));
    }
    if (!options.report.empty())
        write_report(options.report, report.json());
}

} // namespace duskline::planet_app
