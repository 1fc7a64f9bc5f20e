#pragma once

#include <duskline/light/date_time.h>
#include <duskline/light/place.h>
#include <duskline/light/sun_position.h>
#include <duskline/light/sun_sample.h>

#include <optional>

namespace duskline {

/// What the sun does on a day.
enum class SunDayKind {
    rises_or_sets, ///< it crosses the horizon at least once
    polar_day,     ///< it stays above
    polar_night,   ///< it stays below
};

/// One day's sun over an open horizon at sea level.
struct SunDay {
    SunDayKind kind = SunDayKind::rises_or_sets;
    UtcTime noon;                   ///< when the sun crosses the meridian
    TimeSpan midnights;             ///< half a day before it and after
    Angle noon_altitude;            ///< geometric; below 0 in polar night
    std::optional<UtcTime> sunrise; ///< none on polar days and nights, nor on the last day before them where
    std::optional<UtcTime> sunset;  ///< the sun does only the other
    std::chrono::microseconds daylight{0}; ///< above the horizon between these midnights
};

/// Sunrise and sunset are when the centre of the sun is geometrically 0.8333 degrees below the horizontal: the
/// upper limb on the horizon with usual refraction (34') and a mean disc (16'), the convention of almanacs and
/// the NREL SPA. Higher or lower ground, and mountains around, are not looked at.
inline constexpr Angle kSunriseAltitude = Angle::from_degrees(-0.8333);

/// The day whose solar noon is the one nearest 12:00 on `date` by a clock `utc_offset` ahead of UTC; its sunrise
/// and sunset lie within half a day of that noon, whatever their date. Right to about a second where the sun
/// rises steeply, less near polar day and night. About 10 ms. Throws InvalidInput as sun_position does.
SunDay sun_day(CalendarDate date, std::chrono::minutes utc_offset, const Place& place,
               const SunOptions& options = {});

} // namespace duskline
