#pragma once

#include <duskline/light/place.h>
#include <duskline/light/sun_position.h>
#include <duskline/light/sun_sample.h>

#include <chrono>
#include <functional>
#include <vector>

namespace duskline {

/// How much of the sun's disc has to stand over a horizon for a place to count as in the sun.
enum class Limb {
    upper,  ///< any of it, as almanacs have it
    centre, ///< half of it, as hard shadows have it
    lower,  ///< all of it
};

/// From where, through what air, and by what part of its disc the sun is looked at.
struct SunView {
    Place place;
    SunOptions options = {};
    Angle true_to_grid_north = {}; ///< added to azimuths; see `sunlight`
    Limb limb = Limb::upper;
};

/// The sun as a point at that part of its disc: the apparent altitude of the centre, and the disc's radius above or
/// below it. Throws InvalidInput as sun_position does.
DirectionalLight sunlight_at(UtcTime time, const SunView& view);

/// The stretches of `whole` in which an altitude is above 0, to a millisecond. Looks every 15 minutes: shorter
/// stretches may be missed.
std::vector<TimeSpan> spans_above_horizon(const TimeSpan& whole,
                                          const std::function<Angle(UtcTime)>& altitude);

/// The stretches of `whole` in which the sun of a view is above the horizontal. With `Limb::upper` and the default air
/// they begin and end at the almanac's sunrise and sunset (day.h). About 5 ms a day.
std::vector<TimeSpan> daylight_spans(const TimeSpan& whole, const SunView& view);

/// The suns of all daylight in `whole`, in order. Each stands in the middle of a stretch of time; the stretches leave
/// no gap and end at sunrise and sunset. They are `longest_step` long, and shorter where the sun is lower than 15
/// degrees and shadows move fast: in proportion to its altitude, down to a tenth of that at 1.5 degrees. None where it
/// does not rise.
///
/// About 80 microseconds a sun. Throws InvalidInput unless longest_step is above 0, and as sun_position does.
std::vector<SunSample> sample_sun(const TimeSpan& whole, const SunView& view,
                                  std::chrono::microseconds longest_step);

} // namespace duskline
