#pragma once

#include "cli11_names.h"
#include "drawing_options.h"
#include "input_options.h"
#include "light_options.h"
#include "picture_options.h"
#include "run_options.h"
#include "viewer_lamps.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace duskline::viewer {

/// What `duskline-viewer` was asked for.
struct ViewerOptions : window::DrawingOptions {
    cli::InputOptions input;
    cli::PictureOptions picture;
    cli::LightOptions light;
    cli::RunOptions run;
    std::string technique;  ///< empty: of the state; "all" in a fly-by
    std::string shadow_map; ///< settings; empty: of the state
    bool soft = false;
    std::optional<std::size_t> light_maps;
    bool difference = false;
    bool objects = false;
    std::vector<MapLamp> lamps; ///< beside those of the state
    std::string animation;      ///< empty: of the state
    std::optional<double> animation_s;
    std::optional<double> animation_speed;
    std::string state;  ///< a file to begin with
    std::string flight; ///< a file with the poses of a flight
    std::optional<std::size_t> flyby_frames;
    std::optional<double> at_most_s; ///< what flying one technique's frames may take
};

/// `options` must outlive `app`'s parsing.
void add_viewer_options(CLI::App& app, ViewerOptions& options);

/// Throws UsageError for options that do not go together.
void require_consistent(const ViewerOptions& options);

} // namespace duskline::viewer
