#pragma once

#include "planet_frame.h"
#include "planet_state.h"

#include <string>

namespace duskline::planet_app {

/// What the last frames cost, smoothed.
struct FrameFigures {
    double frame_ms = 0.0;
    double load_ms = 0.0;
    double cast_ms = 0.0;
    double lamps_ms = 0.0;
    double draw_ms = 0.0;
    gl::DrawnPlanet drawn;
    std::size_t tiles_in_memory = 0;
};

/// What is going on besides looking.
struct Activity {
    bool clock_runs = false;
    bool panel = true;
    bool help = false;

    // Set by the panel, done and cleared by the window.
    bool wants_screenshot = false;
};

/// Draws the panel, with a message of what was last done, and changes state and activity as hands on it do.
void draw_panel(PlanetState& state, Activity& activity, const ViewedPlanet& viewed,
                const FrameFigures& figures, const std::string& message);

} // namespace duskline::planet_app
