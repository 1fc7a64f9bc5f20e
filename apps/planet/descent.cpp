#include "descent.h"

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
#include <array>
#include <deque>
#include <filesystem>
#include <iterator>
#include <limits>
#include <vector>

namespace duskline::planet_app {
namespace {

// What frames of a window may do, too.
constexpr FrameBudget kBudget = {};

// Heights over the ground that are reported by themselves.
struct Band {
    const char* name;
    double below_m;
};
constexpr std::array<Band, 7> kBands = {{{"below 50 m", 50.0},
                                         {"50 to 200 m", 200.0},
                                         {"200 m to 1 km", 1e3},
                                         {"1 to 10 km", 1e4},
                                         {"10 to 100 km", 1e5},
                                         {"100 to 1000 km", 1e6},
                                         {"above 1000 km", std::numeric_limits<double>::infinity()}}};

std::size_t band_of(double clearance_m)
{
    const auto band = std::ranges::find_if(kBands, [&](const Band& it) { return clearance_m < it.below_m; });
    return static_cast<std::size_t>(band - kBands.begin());
}

// Of the frames of a band, or of all.
struct DescentFigures {
    std::vector<double> frame_ms;
    double load_ms = 0.0; ///< sums over the frames
    double cast_ms = 0.0;
    double draw_ms = 0.0;
    double triangles = 0.0;
    std::size_t settled = 0; ///< frames in which all was there that the view wants

    void note(const FrameCost& cost)
    {
        load_ms += cost.load_ms;
        cast_ms += cost.cast_ms;
        draw_ms += cost.draw_ms;
        frame_ms.push_back(cost.load_ms + cost.cast_ms + cost.draw_ms);
        triangles += static_cast<double>(cost.drawn.triangles);
        settled += cost.settled ? 1U : 0U;
    }

    double frames() const { return static_cast<double>(frame_ms.size()); }
    double mean_frame_ms() const { return (load_ms + cast_ms + draw_ms) / frames(); }

    // Sorts them.
    double median_frame_ms()
    {
        std::ranges::sort(frame_ms);
        return frame_ms[frame_ms.size() / 2];
    }
};

template <typename T>
using OfBands = std::array<T, kBands.size()>;

struct DescentRun {
    DescentFigures all;
    OfBands<DescentFigures> bands;
};

class Descent {
public:
    Descent(const PlanetOptions& options, const ViewedPlanet& viewed, const gl::ShaderSources& sources)
        : options_(options), viewed_(viewed), sources_(sources),
          first_(first_state(options, *viewed.terrain)), target_(options.width, options.height)
    {}

    DescentRun fly(const ShadowVariant& variant) const
    {
        PlanetScene scene(viewed_, sources_, first_.square_pixels, execution());
        PlanetShadowing shadowing(scene);
        DescentRun run;
        // Shaders are compiled and the first tiles read before anything is timed.
        target_.begin();
        draw_settled(scene, shadowing, state_at(variant, 0), options_.width, options_.height);
        for (std::size_t frame = 0; frame < *options_.flydown_frames; ++frame) {
            cli::stop_if_interrupted();
            target_.begin();
            const PlanetState state = state_at(variant, frame);
            const FrameCost cost =
                draw_frame(scene, shadowing, state, options_.width, options_.height, kBudget, true);
            run.all.note(cost);
            run.bands.at(band_at(state)).note(cost);
            if (!options_.frames.empty())
                write_frame(variant, frame);
        }
        return run;
    }

    // How right the shadows are, by variant and band: in so many frames of the way down, everything there.
    std::vector<OfBands<ShadowErrors>> errors(const std::vector<ShadowVariant>& variants) const
    {
        std::vector<OfBands<ShadowErrors>> errors(variants.size());
        if (options_.errors == 0)
            return errors;
        PlanetScene scene(viewed_, sources_, first_.square_pixels, execution());
        std::deque<PlanetShadowing> shadowings; // they stay where they are
        for (std::size_t i = 0; i < variants.size(); ++i)
            shadowings.emplace_back(scene);
        const GroundProbe probe(options_.width, options_.height);
        for (std::size_t pose = 0; pose < options_.errors; ++pose) {
            cli::stop_if_interrupted();
            const std::size_t frame = pose * (*options_.flydown_frames - 1) / (options_.errors - 1);
            const PlanetState first = state_at(variants.front(), frame);
            const ProbedPicture seen = probe.settled(scene, shadowings.front(), first);
            PictureTruth truth(*viewed_.terrain, sunlight(first.sun.direction), first.camera.eye_m,
                               scene.quadtree().patches(), seen, options_.errors_step, execution());
            for (std::size_t i = 0; i < variants.size(); ++i)
                errors[i].at(band_at(first)) += truth.errors_of(
                    i == 0 ? seen.copy() : probe.settled(scene, shadowings[i], state_at(variants[i], frame)));
        }
        return errors;
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

private:
    Execution execution() const { return {.threads = options_.run.threads, .progress = {}}; }

    std::size_t band_at(const PlanetState& state) const
    {
        return band_of(clearance_m(state.camera, *viewed_.terrain));
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
    PlanetState first_;
    window::PictureTarget target_;
};

nlohmann::ordered_json as_json(const ShadowErrors& errors)
{
    const auto pixels = static_cast<double>(errors.pixels);
    return {{"pixels", errors.pixels},
            {"wrong_share", static_cast<double>(errors.wrong) / pixels},
            {"wrong_apart_share", static_cast<double>(errors.wrong_apart) / pixels}};
}

// Of the bands that frames or errors fell into.
nlohmann::ordered_json as_json(OfBands<DescentFigures>& figures, const OfBands<ShadowErrors>& errors)
{
    nlohmann::ordered_json bands = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < kBands.size(); ++i) {
        DescentFigures& band = figures.at(i);
        if (band.frame_ms.empty())
            continue;
        nlohmann::ordered_json json = {{"band", kBands.at(i).name},
                                       {"frames", band.frame_ms.size()},
                                       {"mean_frame_ms", band.mean_frame_ms()},
                                       {"median_frame_ms", band.median_frame_ms()},
                                       {"mean_load_ms", band.load_ms / band.frames()},
                                       {"mean_cast_ms", band.cast_ms / band.frames()},
                                       {"mean_draw_ms", band.draw_ms / band.frames()}};
        if (errors.at(i).pixels > 0)
            json["errors"] = as_json(errors.at(i));
        bands.push_back(json);
    }
    return bands;
}

nlohmann::ordered_json as_json(const ShadowVariant& variant, DescentRun& run,
                               const OfBands<ShadowErrors>& errors)
{
    DescentFigures& figures = run.all;
    const auto [shortest, longest] = std::ranges::minmax(figures.frame_ms);
    const double frames = figures.frames();
    nlohmann::ordered_json json = {{"technique", variant.name},
                                   {"frames", figures.frame_ms.size()},
                                   {"fps",
                                    {{"least", 1000.0 / longest},
                                     {"most", 1000.0 / shortest},
                                     {"mean", 1000.0 / figures.mean_frame_ms()}}},
                                   {"mean_frame_ms", figures.mean_frame_ms()},
                                   {"median_frame_ms", figures.median_frame_ms()},
                                   {"mean_load_ms", figures.load_ms / frames},
                                   {"mean_cast_ms", figures.cast_ms / frames},
                                   {"mean_draw_ms", figures.draw_ms / frames},
                                   {"mean_triangles", figures.triangles / frames},
                                   {"settled_share", static_cast<double>(figures.settled) / frames},
                                   {"bands", as_json(run.bands, errors)}};
    ShadowErrors all;
    for (const ShadowErrors& band : errors)
        all += band;
    if (all.pixels > 0)
        json["errors"] = as_json(all);
    return json;
}

// What a technique takes more than none, in the same frames.
void add_shadow_cost(nlohmann::ordered_json& flight, const nlohmann::ordered_json& none)
{
    const auto add = [](auto& of, const auto& without) {
        of["shadow_ms"] =
            of["mean_cast_ms"].template get<double>() + of["mean_draw_ms"].template get<double>()
            - without["mean_cast_ms"].template get<double>() - without["mean_draw_ms"].template get<double>();
    };
    add(flight, none);
    for (std::size_t i = 0; i < flight["bands"].size(); ++i)
        add(flight["bands"][i], none["bands"][i]);
}

std::string share(const nlohmann::ordered_json& figures, const char* name)
{
    return figures.contains("errors") ? fmt::format("{:.2f} %", 100.0 * figures["errors"][name].get<double>())
                                      : "";
}

std::string as_line(const std::string& name, const nlohmann::ordered_json& figures)
{
    return fmt::format("{:<20} {:9.1f} {:9.1f} {:9.1f} {:9.1f} {:9.1f} {:>9} {:>9}", name,
                       figures["mean_frame_ms"].get<double>(), figures["median_frame_ms"].get<double>(),
                       figures["mean_load_ms"].get<double>(), figures["mean_cast_ms"].get<double>(),
                       figures["mean_draw_ms"].get<double>(), share(figures, "wrong_share"),
                       share(figures, "wrong_apart_share"));
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
    report.line(fmt::format("{:<20} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}", "", "frame, ms", "median",
                            "load, ms", "cast, ms", "draw, ms", "wrong", "apart"));
}

} // namespace

void fly_down(const PlanetOptions& options, cli::Report& report)
{
    window::require_new_report(options);
    const gl::HeadlessContext context;
    const gl::ContextInfo info = gl::current_context();
    const ViewedPlanet viewed = read_viewed_planet(options, report);
    const gl::ShaderSources sources;
    const Descent descent(options, viewed, sources);
    const std::vector<ShadowVariant> variants = variants_of(options, options.look);

    report.field("renderer", info.renderer);
    report.field("opengl", info.version);
    report_way(report, options, info.renderer);
    const std::vector<OfBands<ShadowErrors>> errors = descent.errors(variants);
    nlohmann::ordered_json none;
    for (std::size_t i = 0; i < variants.size(); ++i) {
        DescentRun run = descent.fly(variants[i]);
        nlohmann::ordered_json flight = as_json(variants[i], run, errors[i]);
        if (variants[i].technique == PlanetTechnique::none)
            none = flight;
        if (!none.is_null())
            add_shadow_cost(flight, none);
        report_flight(report, flight);
    }
    descent.lamp_errors().add_to(report);
    window::write_report(options, report.json());
}

} // namespace duskline::planet_app
