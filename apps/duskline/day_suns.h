#pragma once

#include "cli11_names.h"
#include "light_options.h"
#include "report.h"

#include <duskline/raster_io/read_height_field.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace duskline::cli {

/// Over which times maps are spread: --date or --from and --to, --maps, and the sun as others look at it.
struct DaySunOptions {
    std::optional<CalendarDate> date;
    std::optional<DateTime> from;
    std::optional<DateTime> to;
    std::optional<std::chrono::minutes> utc_offset;
    std::size_t maps = 24;
    SunlightOptions sunlight;
};

/// The suns of a day's maps, in order.
struct DaySuns {
    SunView view;
    TimeSpan span;                      ///< from sunrise to sunset, or between the two times
    bool dark_outside = false;          ///< before the span and after it the sun is down
    std::chrono::minutes utc_offset{0}; ///< of the clock that times are told by
    std::vector<ChosenLight> suns;      ///< each with its time
};

/// `options` must outlive `app`'s parsing.
void add_day_sun_options(CLI::App& app, DaySunOptions& options);

/// Throws UsageError, before anything is read, for options that do not go together.
void require_possible(const DaySunOptions& options);

/// The suns the options ask for. `soft` suns shine while any of their disc is up. Throws UsageError for a day or a span
/// without sun.
DaySuns choose_day_suns(const DaySunOptions& options, bool soft, const HeightFile& file, Report& report);

} // namespace duskline::cli
