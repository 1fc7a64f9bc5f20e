#pragma once

#include <duskline/casting/ray.h>
#include <duskline/casting/terrain_shadows.h>
#include <duskline/execution/progress.h>
#include <duskline/light/sun_sample.h>
#include <duskline/terrain/height_field.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace duskline {

/// Seconds that the sun shone on each cell so far.
using SunSeconds = Grid<std::uint32_t>;

/// Adds to every cell the stretches of those suns that light it, in whole seconds (the ends of stretches are rounded,
/// so that stretches without a gap add up to the second). Cells without data stay as they were.
///
/// A cell that comes to the light or leaves it between two neighbouring suns does so somewhere between the two, and is
/// taken to do so where their stretches meet: at most half of the longer stretch wrong, at each change. What is shorter
/// than a stretch, the shadow of a mast passing by, may be missed or counted in full.
///
/// The same for any number of threads. Throws InvalidInput when sizes differ or angles are out of range, Cancelled
/// (with `seconds` of no more use). Cost: a mask of `exact` and a pass over the cells for each sun; no memory besides.
void add_sunlight(TerrainShadows& shadows, std::span<const SunSample> suns, SunSeconds& seconds,
                  const Execution& execution = {});

/// When the sun shines on cells for the first and the last time, and how long in all.
struct SunTimes {
    Grid<float> hours; ///< in the sun; NaN where there is no data
    Grid<float> first; ///< hours after a moment of the caller's; NaN as well where the sun never shines
    Grid<float> last;  ///< likewise
};

/// The sun over a terrain from its first light to its last, say that of a day: hours, first and last light of each
/// cell.
///
///     SunCourse course(terrain, sample_sun(day, view, 5min));
///     course.cast();
///     const SunTimes times = course.times(0, terrain.heights_m.rows(), midnight);
///
/// Hours as for `add_sunlight`. First and last light are where the stretches of two suns meet, too, or with a
/// `TerrainRays` of the same terrain found by bisection between those suns: right to 1/64 of the time from one to the
/// other, with the sun on the straight way between them and no second change between them; the hours then hold those
/// better times. Where a stretch of daylight begins or ends (sunrise) first and last light are that moment.
///
/// Keeps a view of the heights, which must outlive it and stay as they are. Memory: 9 bytes a cell.
class SunCourse {
public:
    /// Throws InvalidInput for cell sizes out of range, for more than 65534 suns and suns that are not in order.
    SunCourse(const HeightField& field, std::vector<SunSample> suns, const Execution& execution = {});

    /// Casts every sun. To be called once. Throws as add_sunlight.
    void cast(const Execution& execution = {});

    /// What came of `row_count` rows from `first_row` on, first and last light counted in hours from `origin`. About
    /// 10 microseconds a cell with rays. Throws InvalidInput for rows out of range, Cancelled.
    SunTimes times(std::size_t first_row, std::size_t row_count, UtcTime origin,
                   const TerrainRays* rays = nullptr, const Execution& execution = {}) const;

private:
    static constexpr std::uint16_t kNever = std::numeric_limits<std::uint16_t>::max();

    UtcTime change_of_light(std::size_t row, std::size_t column, std::size_t dark, std::size_t lit,
                            const TerrainRays& rays) const;
    TimeSpan light_of(std::size_t row, std::size_t column, const TerrainRays* rays) const;

    HeightField field_;
    std::vector<SunSample> suns_;
    TerrainShadows shadows_;
    SunSeconds seconds_;
    Grid<std::uint16_t> first_; // the first sun that lights a cell, and the last; kNever: none does
    Grid<std::uint16_t> last_;
};

} // namespace duskline
