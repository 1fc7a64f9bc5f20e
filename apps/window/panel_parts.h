#pragma once

#include "shadow_map_settings.h"

#include <imgui.h>

#include <string>

namespace duskline::window {

// Parts that panels of several programs have. Between ImGui::Begin and ImGui::End.

/// A line of text.
void text(const std::string& line);

/// For a double. Whether it was changed.
bool slider(const char* label, double& value, double least, double most, const char* format,
            ImGuiSliderFlags flags = 0);

/// All settings of a shadow map. What no control shows exactly stays as it is until its control is used.
void shadow_map_controls(gl::ShadowMapOptions& options, gl::ShadowMapLook& look);

} // namespace duskline::window
