#pragma once

#include "shadow_map_settings.h"

#include <duskline/light/date_time.h>

#include <imgui.h>

#include <optional>
#include <string>

namespace duskline::window {

// Parts that panels of several programs have.

inline constexpr float kPanelWidth = 300.0f;

/// Begins the panel, and ends it with what there is to say.
void begin_panel();
void end_panel(const std::string& message);

/// A small window with the keys there are, until it is closed.
void show_keys(bool& open, const std::string& keys);

/// A line of text.
void text(const std::string& line);

/// For a double. Whether it was changed.
bool slider(const char* label, double& value, double least, double most, const char* format,
            ImGuiSliderFlags flags = 0);

/// The date and time of the sun by its own offset from UTC, the clock, and whether it runs; none: the sun stands by angles.
void clock_controls(std::optional<DateTime>& time, bool& runs, double& seconds_per_second);

/// All settings of a shadow map. What no control shows exactly stays as it is until its control is used.
void shadow_map_controls(gl::ShadowMapOptions& options, gl::ShadowMapLook& look);

} // namespace duskline::window
