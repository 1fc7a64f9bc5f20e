#include "soak.h"

#include "interruption.h"
#include "peak_memory.h"
#include "picture_target.h"
#include "planet_files.h"
#include "planet_frame.h"
#include "shadow_variants.h"
#include "stopwatch.h"

#include <duskline/gl/debug_messages.h>
#include <duskline/gl/headless_context.h>
#include <duskline/planet/planet_flight.h>

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <random>
#include <stdexcept>

namespace duskline::planet_app {
namespace {

constexpr std::size_t kWidth = 192;
constexpr std::size_t kHeight = 144;
constexpr std::size_t kFramesOfLeg = 12;

// What memory may come to. Layers: for every tile there is, and half as many again.
constexpr double kLayersPerTile = 1.5;
constexpr double kMostMegabytes = 2000.0;
constexpr std::size_t kMapSize = 1024; // of shadow maps, so that a frame does not take seconds

// The same numbers everywhere, which distributions of the standard library do not promise.
class Chance {
public:
    explicit Chance(std::uint64_t seed) : engine_(seed) {}

    double between(double least, double most)
    {
        return least + (most - least) * static_cast<double>(engine_() >> 11U) * 0x1p-53;
    }
    bool happens(double chance) { return between(0.0, 1.0) < chance; }
    std::size_t below(std::size_t count) { return static_cast<std::size_t>(engine_() % count); }

    Vector3 direction()
    {
        const double z = between(-1.0, 1.0);
        const auto [sine, cosine] = sine_cosine(Angle::from_degrees(between(0.0, 360.0)));
        const double across = std::sqrt(1.0 - z * z);
        return {across * cosine, across * sine, z};
    }

private:
    std::mt19937_64 engine_;
};

struct SoakFigures {
    std::size_t frames = 0;
    std::size_t most_tiles = 0;
    std::size_t most_front_tiles = 0;
    std::size_t most_layers = 0;
    double most_megabytes = 0.0; ///< beyond what there was before; 0 where the system does not say
};

class Soak {
public:
    Soak(const PlanetOptions& options, const ViewedPlanet& viewed, const gl::ShaderSources& sources)
        : options_(options), viewed_(viewed), chance_(options.seed), target_(kWidth, kHeight),
          scene_(viewed, sources, options.look.square_pixels,
                 {.threads = options.run.threads, .progress = {}}),
          shadowing_(scene_), state_(first_state(options, *viewed.terrain))
    {
        gl::ShadowMapOptions usual = options.look.shadow_map;
        usual.size = kMapSize;
        variants_ = shadow_techniques(usual);
        for (const ShadowVariant& variant : shadow_map_variants(usual))
            variants_.push_back(variant);
    }

    const SoakFigures& fly()
    {
        double seconds = 0.0;
        while (seconds < *options_.soak_s) {
            const cli::Stopwatch watch(seconds);
            fly_leg();
        }
        return figures_;
    }

private:
    void fly_leg()
    {
        state_.soft = leg_ / 2 % 2 == 1; // of the fronts every other time
        const ShadowVariant& variant = next_variant();
        state_.technique = variant.technique;
        state_.shadow_map = variant.shadow_map;
        if (chance_.happens(0.5))
            state_.sun.direction = chance_.direction();
        const Vector3 turning = chance_.direction() * (chance_.happens(0.5) ? 1e-3 : 0.0);
        const PlanetCamera from = state_.camera;
        const PlanetCamera to = somewhere();
        const bool leap = chance_.happens(0.25);
        light_lamp(to);
        for (std::size_t frame = 1; frame <= kFramesOfLeg; ++frame) {
            const double share = static_cast<double>(frame) / kFramesOfLeg;
            state_.camera = leap ? to : between(*viewed_.terrain, from, to, 1.0, share);
            state_.sun.direction = normalized(state_.sun.direction + turning);
            draw();
        }
    }

    // Over every fourth leg a lamp or a searchlight shines where it ends.
    void light_lamp(const PlanetCamera& where)
    {
        state_.lamps.clear();
        if (leg_ % 4 == 0)
            state_.lamps.push_back(lamp_at_eye(*viewed_.terrain, where,
                                               chance_.happens(0.5)
                                                   ? window::usual_lamp()
                                                   : window::usual_searchlight(beam_of_view(where))));
    }

    // Techniques in turn, fronts first, and any option of the shadow map between them.
    const ShadowVariant& next_variant()
    {
        const std::size_t techniques = planet_techniques().size();
        const std::size_t leg = leg_++;
        return variants_[leg % 2 == 0 ? techniques - 1 - leg / 2 % techniques
                                      : techniques + chance_.below(variants_.size() - techniques)];
    }

    PlanetCamera somewhere()
    {
        PlanetPose pose = options_.pose;
        if (chance_.happens(0.5)) // else over the place that was given
            pose.place = lon_lat_of(viewed_.terrain->globe(), chance_.direction());
        const double highest_m = 3.0 * viewed_.terrain->globe().equatorial_radius_m;
        pose.clearance_m = std::exp(chance_.between(std::log(1.5), std::log(highest_m)));
        pose.heading = Angle::from_degrees(chance_.between(0.0, 360.0));
        pose.pitch = Angle::from_degrees(chance_.between(-90.0, 20.0));
        return camera_at(*viewed_.terrain, pose);
    }

    void draw()
    {
        cli::stop_if_interrupted();
        target_.begin();
        draw_frame(scene_, shadowing_, state_, kWidth, kHeight, {}, true);
        ++figures_.frames;
        messages_.throw_if_any(fmt::format("drawing frame {} of --soak with --seed {} ({})", figures_.frames,
                                           options_.seed, name_of(state_.technique)));
        note_memory();
    }

    void note_memory()
    {
        figures_.most_tiles = std::max(figures_.most_tiles, scene_.quadtree().tiles().size());
        figures_.most_front_tiles = std::max(figures_.most_front_tiles, shadowing_.tiles_of_fronts());
        figures_.most_layers = std::max(figures_.most_layers, scene_.layers());
        figures_.most_megabytes = static_cast<double>(memory_.bytes().value_or(0)) / 1e6;
        const auto require = [&](double value, double bound, const char* what) {
            if (value > bound)
                throw std::runtime_error(
                    fmt::format("frame {} of --soak with --seed {}: {:.0f} {}, {:.0f} are allowed",
                                figures_.frames, options_.seed, value, what, bound));
        };
        const auto most_tiles = static_cast<double>(scene_.quadtree().tiles().most_tiles());
        require(static_cast<double>(figures_.most_tiles), most_tiles, "tiles in memory");
        require(static_cast<double>(figures_.most_front_tiles), most_tiles, "tiles with shadows");
        require(static_cast<double>(figures_.most_layers), kLayersPerTile * most_tiles, "layers on the card");
        require(figures_.most_megabytes, kMostMegabytes, "MB in memory");
    }

    const PlanetOptions& options_;
    const ViewedPlanet& viewed_;
    cli::PeakMemory memory_;
    gl::DebugMessages messages_;
    Chance chance_;
    window::PictureTarget target_;
    PlanetScene scene_;
    PlanetShadowing shadowing_;
    PlanetState state_;
    std::vector<ShadowVariant> variants_;
    std::size_t leg_ = 0;
    SoakFigures figures_;
};

} // namespace

void soak(const PlanetOptions& options, cli::Report& report)
{
    const gl::HeadlessContext context;
    const ViewedPlanet viewed = read_viewed_planet(options, report);
    const gl::ShaderSources sources;
    Soak flight(options, viewed, sources);
    const SoakFigures& figures = flight.fly();

    report.line(fmt::format(
        "{} frames without a complaint; at most {} tiles in memory, {} with shadows, {} layers on "
        "the card, {:.0f} MB",
        figures.frames, figures.most_tiles, figures.most_front_tiles, figures.most_layers,
        figures.most_megabytes));
    report.field("seed", options.seed);
    report.field("frames", figures.frames);
    report.field("most_tiles", figures.most_tiles);
    report.field("most_front_tiles", figures.most_front_tiles);
    report.field("most_layers", figures.most_layers);
    report.field("most_megabytes", figures.most_megabytes);
}

} // namespace duskline::planet_app
