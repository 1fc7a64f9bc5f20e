#pragma once

#include "app_window.h"

#include <duskline/gl/shader_sources.h>
#include <duskline/light/date_time.h>

#include <functional>
#include <optional>
#include <string>

namespace duskline::window {

/// One sitting before a window: frame after frame until it is closed. Where nothing moves and hands are still it waits for
/// them, and draws four times a second.
class Sitting {
public:
    /// `window` must outlive it.
    explicit Sitting(const AppWindow& window) : window_(window) {}
    Sitting(const Sitting&) = delete;
    Sitting& operator=(const Sitting&) = delete;
    virtual ~Sitting() = default;

    /// Throws cli::Interrupted when told to stop.
    void run();

protected:
    /// Whether the next picture may be another one though nobody touches anything.
    virtual bool moves() const = 0;

    /// Between the beginning and the end of a frame of Dear ImGui.
    virtual void draw_frame() = 0;

    /// What cannot be done is said in the message; the window stays.
    void attempt(const std::function<std::string()>& work);

    /// Escape.
    void leave();

    const AppWindow& window_;
    std::string message_;   ///< what was last done
    double frame_ms_ = 0.0; ///< what frames take, smoothed

private:
    bool is_idle();
    void frame();

    int still_frames_ = 0;
};

/// A figure that follows its newest value slowly enough to be read.
void smooth(double& figure, double value);

/// Where W A S D, Q E fly: -1, 0 or 1 each, and how much of the height over ground in this frame; more with Shift.
struct FlightByKeys {
    double right = 0.0;
    double ahead = 0.0;
    double up = 0.0;
    double share = 0.0; ///< 0: nowhere
};
FlightByKeys flight_by_keys();

/// Moves a running clock on.
void advance_clock(std::optional<DateTime>& time, double seconds);

/// Those of the folder $DUSKLINE_SHADER_DIR before those of the program.
gl::ShaderSources shader_sources_of_environment();

} // namespace duskline::window
