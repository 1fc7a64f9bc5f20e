#pragma once

#include "cli11_names.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace duskline::window {

/// What every program that draws can be asked for.
struct DrawingOptions {
    std::size_t width = 1024; ///< of the window or picture, pixels
    std::size_t height = 768;
    std::string render;           ///< a picture to write, without a window
    std::optional<double> soak_s; ///< how long to use everything at random, seconds
    std::uint64_t seed = 1;       ///< of that
    std::string report;           ///< a file for the figures of a flight
    std::string frames;           ///< a folder for its pictures
    bool overwrite = false;
};

inline constexpr auto kHeadlessGroup = "Without a window";

// `options` must outlive `app`'s parsing. `flight` is the option that flies and reports, such as --flyby.

/// --size WxH.
void add_size_option(CLI::App& app, DrawingOptions& options, const std::string& group);

/// --render.
void add_render_option(CLI::App& app, DrawingOptions& options);

/// --soak, which does what `soak_text` says, and --seed.
void add_soak_options(CLI::App& app, DrawingOptions& options, const std::string& soak_text);

/// --report, --frames and --overwrite.
void add_output_options(CLI::App& app, DrawingOptions& options, const std::string& flight);

/// Throws cli::UsageError when more than one of a picture, a flight and a soak is wanted, and for outputs of a flight that is not.
void require_one_task(const DrawingOptions& options, bool flies, const std::string& flight);

/// Throws OutputError when the picture of --render is there and may not be replaced.
void require_new_picture(const DrawingOptions& options);

/// The same for the report of a flight, and when there is no folder for its pictures.
void require_new_report(const DrawingOptions& options);

/// Writes the report, if one is wanted. Throws OutputError.
void write_report(const DrawingOptions& options, const nlohmann::ordered_json& json);

} // namespace duskline::window
