#pragma once

#include "scene.h"
#include "viewer_state.h"

#include <duskline/products/mask_difference.h>
#include <duskline/terrain/brush.h>

#include <optional>
#include <string>

namespace duskline::viewer {

/// What the last frames cost, smoothed.
struct FrameFigures {
    double frame_ms = 0.0;
    double ground_ms = 0.0;
    double cast_ms = 0.0; ///< of the last cast
    double cast_gpu_ms = 0.0;
    double draw_gpu_ms = 0.0;
    double done = 1.0; ///< of the shadows, which may take several frames
    gl::DrawnMesh mesh;
};

/// What is going on besides looking.
struct Activity {
    bool clock_runs = false;
    bool panel = true;
    bool help = false;
    bool replays = false;
    bool records = false;
    CameraPath flight;     ///< recorded, or read
    Brush brush;           ///< amount in metres a second
    double replayed = 0.0; ///< share of it
    std::optional<MaskDifference> counted;
    std::optional<double> black_share; ///< counted with it, of a silhouette map

    // Set by the panel, done and cleared by the window.
    bool wants_screenshot = false;
    bool wants_state_saved = false;
    bool wants_flight_saved = false;
    bool wants_count = false;
    bool wants_overview = false;
};

/// Draws the panel, with a message of what was last done, and changes state and activity as hands on it do.
void draw_panel(ViewerState& state, Activity& activity, const SunClock& clock, const FrameFigures& figures,
                const std::string& message);

} // namespace duskline::viewer
