#pragma once

#include "cli11_names.h"
#include "input_options.h"
#include "light_options.h"
#include "report.h"
#include "run_options.h"

#include <duskline/light/point_light.h>
#include <duskline/raster_io/read_height_field.h>
#include <duskline/terrain/earth_curvature.h>

#include <string>
#include <vector>

namespace duskline::cli {

/// Lamps instead of a sun: --point, --count.
struct LampOptions {
    std::vector<std::string> points; ///< X,Y,Z or X,Y,+Z
    bool count = false;              ///< write how many lamps light a cell

    bool given() const { return !points.empty(); }
};

/// A lamp as it was asked for, and as casters take it.
struct ChosenLamp {
    double x = 0.0; ///< map coordinates
    double y = 0.0;
    double height_m = 0.0; ///< over the zero of the input's heights
    PointLight light;      ///< lowered as the ground is by the earth's curvature
};

/// `options` must outlive `app`'s parsing.
void add_point_option(CLI::App& app, LampOptions& options, const std::string& more = {});
void add_lamp_options(CLI::App& app, LampOptions& options);

/// Throws UsageError unless the text is X,Y,Z.
void require_point(const std::string& text);

/// Throws UsageError when lamps are mixed with a sun, or when --count has none to count.
void require_lamps_or_sun(const LampOptions& lamps, const LightOptions& sun);

/// The lamps the options ask for. Warns of lamps under the ground and far outside, notes others outside. Reads the
/// ground under them from the file anew. Throws UsageError for points that are none, or that are to stand above
/// ground where there is none.
std::vector<ChosenLamp> choose_lamps(const LampOptions& options, const InputOptions& input,
                                     const RunOptions& run, const HeightFile& file,
                                     const EarthCurvature& curvature, Report& report);

/// "500000,2150000,4205".
std::string in_words(const ChosenLamp& lamp);

} // namespace duskline::cli
