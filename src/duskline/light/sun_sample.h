#pragma once

#include <duskline/light/date_time.h>
#include <duskline/light/directional_light.h>

namespace duskline {

/// A stretch of time; `to` is not before `from`.
struct TimeSpan {
    UtcTime from;
    UtcTime to;

    std::chrono::microseconds length() const { return to - from; }
    UtcTime middle() const { return from + length() / 2; }
};

/// One sun that stands for all moments of a stretch of time.
struct SunSample {
    TimeSpan span;
    UtcTime time;           ///< when the sun stands there, within the span
    DirectionalLight light; ///< azimuth from the grid's north
};

} // namespace duskline
