#include "soak.h"

#include "interruption.h"
#include "picture_target.h"
#include "raster_site.h"
#include "scene.h"

#include <duskline/casting/exact.h>
#include <duskline/gl/debug_messages.h>
#include <duskline/gl/headless_context.h>
#include <duskline/gl/live_objects.h>
#include <duskline/products/mask_difference.h>

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <fstream>
#include <map>
#include <random>
#include <stdexcept>

namespace duskline::viewer {
namespace {

constexpr std::size_t kFramesAScene = 40;

// What may stay for good once two scenes have been there: Mesa's compiled shaders above all.
constexpr double kMostGrowth_MiB = 96.0;

// Resident memory of this process; 0 where the system does not tell.
double resident_mib()
{
    std::ifstream file("/proc/self/status");
    for (std::string word; file >> word;) {
        double kibibytes = 0.0;
        if (word == "VmRSS:" && file >> kibibytes)
            return kibibytes / 1024.0;
    }
    return 0.0;
}

std::string as_text(const gl::LiveObjects& live)
{
    return fmt::format("{} textures, {} buffers, {} framebuffers, {} vertex arrays, {} programs, {} queries",
                       live.textures, live.buffers, live.framebuffers, live.vertex_arrays, live.programs,
                       live.queries);
}

class Dice {
public:
    explicit Dice(std::size_t seed) : bits_(seed) {}

    double between(double low, double high)
    {
        constexpr double unit = 1.0 / 9007199254740992.0; // 2^-53
        return low + (high - low) * static_cast<double>(bits_() >> 11U) * unit;
    }
    std::size_t below(std::size_t count) { return static_cast<std::size_t>(bits_() % count); }

private:
    std::mt19937_64 bits_;
};

class Soak {
public:
    Soak(const ViewerOptions& options, ViewedTerrain& viewed, const SunClock& clock,
         const gl::ShaderSources& sources)
        : dice_(options.seed), viewed_(viewed), clock_(clock), sources_(sources),
          state_(first_state(options, viewed, clock)), empty_(gl::live_objects())
    {
        begin_scene();
    }

    void frame()
    {
        if (++frames_ % kFramesAScene == 0)
            begin_scene();
        const Action& action = kActions.at(dice_.below(kActions.size()));
        doing_ =
            fmt::format("frame {}, {}, {}{}{}, ground {}", frames_, action.name, state_.technique,
                        state_.soft ? ", soft" : "", state_.objects ? ", objects" : "", state_.animation);
        (this->*action.act)();
        state_.animation_s += dice_.between(0.0, 0.5);
        state_.camera = kept_above_ground(state_.camera, scene_->field(), scene_->field().cell_size_m.x);
        target_->begin();
        scene_->cast(state_, target_->width(), target_->height());
        scene_->draw(state_, target_->width(), target_->height());
        ++done_[action.name];
        messages_.throw_if_any(doing_);
    }

    // The scene goes, and nothing of it may be left.
    void end_scene()
    {
        scene_.reset();
        target_.reset();
        messages_.throw_if_any(doing_ + ", leaving");
        if (const gl::LiveObjects left = gl::live_objects(); !(left == empty_))
            throw std::runtime_error(doing_ + ": objects of OpenGL are left over when their scene has gone, "
                                     + as_text(left) + " instead of " + as_text(empty_));
        resident_mib_.push_back(resident_mib());
        // The first two fill the driver's caches.
        if (resident_mib_.size() > 2 && resident_mib_.back() > resident_mib_[1] + kMostGrowth_MiB)
            throw std::runtime_error(
                fmt::format("{}: memory grows, from {:.0f} MiB after {} frames to {:.0f} MiB", doing_,
                            resident_mib_[1], 2 * kFramesAScene, resident_mib_.back()));
    }

    std::size_t frames() const { return frames_; }
    const std::map<std::string, std::size_t>& done() const { return done_; }
    const std::vector<double>& resident() const { return resident_mib_; }

private:
    struct Action {
        const char* name;
        void (Soak::*act)();
    };

    void begin_scene()
    {
        if (scene_)
            end_scene();
        scene_.emplace(viewed_, clock_, sources_);
        resize();
    }

    void move_sun()
    {
        state_.light.time = std::nullopt;
        state_.light.azimuth_deg = dice_.between(-400.0, 400.0);
        state_.light.altitude_deg = dice_.between(-5.0, 90.0);
    }

    void change_technique()
    {
        const auto kinds = gl::shadow_techniques();
        state_.technique = kinds[dice_.below(kinds.size())].name;
    }

    void change_look()
    {
        state_.soft = dice_.below(2) == 0;
        state_.difference = dice_.below(4) == 0;
        state_.exposure = static_cast<float>(dice_.between(0.25, 4.0));
        state_.pixel_error = dice_.between(0.5, 10.0);
    }

    void change_objects() { state_.objects = !state_.objects; }

    void change_animation()
    {
        const auto kinds = ground_motions();
        const std::size_t chosen = dice_.below(kinds.size() + 1);
        state_.animation = chosen < kinds.size() ? kinds[chosen].name : kNoMotion;
        state_.animation_s = dice_.between(-20.0, 40.0);
    }

    // Within the grid or a little beside it.
    GridPoint some_place()
    {
        const HeightField& field = scene_->field();
        return {dice_.between(-0.1, 1.1) * static_cast<double>(field.rows()),
                dice_.between(-0.1, 1.1) * static_cast<double>(field.columns()), 0.0};
    }

    void edit()
    {
        const double cell_m = scene_->field().cell_size_m.x;
        Brush brush;
        brush.effect =
            std::array{BrushEffect::raise, BrushEffect::lower, BrushEffect::smooth}.at(dice_.below(3));
        brush.radius_m = dice_.between(0.1, 40.0) * cell_m;
        brush.amount_m = dice_.between(0.0, 10.0) * cell_m;
        scene_->stroke(some_place(), brush);
    }

    void move_camera()
    {
        const CellSize cell_size_m = scene_->field().cell_size_m;
        state_.camera.position_m = position_m(some_place(), cell_size_m);
        state_.camera.position_m.z = dice_.between(0.0, 500.0) * cell_size_m.x;
        state_.camera = turned(state_.camera, Angle::from_degrees(dice_.between(-180.0, 180.0)),
                               Angle::from_degrees(dice_.between(-60.0, 40.0)));
    }

    void overlook() { state_.camera = overview(scene_->field(), dice_.between(0.3, 3.0)); }

    void resize() { target_.emplace(16 + dice_.below(300), 16 + dice_.below(200)); }

    void look_at_pixels() { target_->picture(); }

    void reload_shaders() { scene_->reload_shaders(); }

    // What has been brought up to date through all that was done is what a cast from scratch says.
    void check_shadows()
    {
        state_.technique = "exact";
        state_.soft = false;
        scene_->cast(state_, target_->width(), target_->height());
        const ShadowMask expected = cast_by_exact(scene_->field(), clock_.on_grid(state_.light));
        if (mask_difference(expected, scene_->lit_mask()).differing != 0)
            throw std::runtime_error(doing_ + ": the shadows are not those of the ground");
    }

    static constexpr std::array kActions = {
        Action{"sun", &Soak::move_sun},
        Action{"technique", &Soak::change_technique},
        Action{"look", &Soak::change_look},
        Action{"objects", &Soak::change_objects},
        Action{"animation", &Soak::change_animation},
        Action{"edit", &Soak::edit},
        Action{"camera", &Soak::move_camera},
        Action{"overview", &Soak::overlook},
        Action{"size", &Soak::resize},
        Action{"picture", &Soak::look_at_pixels},
        Action{"reload", &Soak::reload_shaders},
        Action{"check", &Soak::check_shadows},
    };

    Dice dice_;
    ViewedTerrain& viewed_;
    const SunClock& clock_;
    const gl::ShaderSources& sources_;
    ViewerState state_;
    gl::DebugMessages messages_;
    gl::LiveObjects empty_;
    std::optional<Scene> scene_;
    std::optional<window::PictureTarget> target_;
    std::size_t frames_ = 0;
    std::string doing_ = "the first frame";
    std::map<std::string, std::size_t> done_;
    std::vector<double> resident_mib_; ///< after each scene
};

} // namespace

void soak(const ViewerOptions& options, cli::Report& report)
{
    const gl::HeadlessContext context;
    ViewedTerrain viewed = read_viewed_terrain(options, report);
    const SunClock clock(cli::light_site(viewed.file.ground()), options.light.sun,
                         options.light.sun_size_deg);
    const gl::ShaderSources sources;
    Soak soak(options, viewed, clock, sources);
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(*options.soak_s);
    while (std::chrono::steady_clock::now() < end) {
        cli::stop_if_interrupted();
        soak.frame();
    }
    soak.end_scene();

    report.line(fmt::format("{} frames in {:.0f} s with seed {}: no complaint of OpenGL, nothing left over, "
                            "{:.0f} MiB after the first scene, {:.0f} MiB after the last of {}",
                            soak.frames(), *options.soak_s, options.seed, soak.resident().front(),
                            soak.resident().back(), soak.resident().size()));
    report.field("frames", soak.frames());
    report.field("seed", options.seed);
    report.field("done", soak.done());
    report.field("resident_mib", soak.resident());
}

} // namespace duskline::viewer
