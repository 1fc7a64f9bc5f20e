#pragma once

#include <duskline/casting/terrain_shadows.h>
#include <duskline/execution/progress.h>
#include <duskline/geometry/grid.h>
#include <duskline/light/directional_light.h>
#include <duskline/light/sun_sample.h>
#include <duskline/products/light_map.h>
#include <duskline/terrain/height_field.h>
#include <duskline/terrain/normals.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace duskline {

/// Moments at which maps of a span are made.
enum class Spread {
    ends,    ///< the first and the last at the ends of the span
    middles, ///< each in the middle of one of `count` equal parts
};

/// `count` moments in even steps, to the microsecond. Throws InvalidInput for none, for one where there are to be ends,
/// and for a span of no length.
std::vector<UtcTime> evenly_spread(const TimeSpan& span, std::size_t count, Spread spread);

/// The two maps that show a moment between them, and how much of the second to take: first + weight (second - first).
struct Blend {
    std::size_t first = 0;
    std::size_t second = 0; ///< `first` itself before the first map and after the last
    double weight = 0.0;    ///< 0 to 1
};

/// What to blend at a moment; `times`, of the maps, rise. Throws InvalidInput when there are none.
Blend blend_at(std::span<const UtcTime> times, UtcTime now);

/// What the maps of a day show, a byte a cell.
struct DayMapOptions {
    /// How bright the ground is, 0 to 255 (`light_map`); else shadows alone, 0 to 255 in full light.
    bool light = true;

    /// Edges of shadows as soft as the sun's disc makes them (`visible_fraction`); else the hard mask.
    bool soft = false;

    /// How light is drawn. Its ambient light is from 0 to 1, grey; the sun's has what is left of 1, so that ground square
    /// to the sun is just white.
    LightMapOptions model = {};
};

/// What a hard shadow map says where there is no data; others say 0 there.
inline constexpr std::uint8_t kNoDataInShadowMap = 128;

/// Maps of one terrain under many suns, with the terrain set up once.
///
///     DayMaps maps(lowered, upward_normals(terrain), {.soft = true});
///     for (const DirectionalLight& sun : suns)
///         write(maps.map(sun));
///
/// `field` is what shadows are cast on (lowered for the curvature of the earth), `normals` those of the ground itself.
/// Keeps a view of the heights, which must outlive it and stay as they are. Not to be used by two threads at a time.
///
/// Memory: a byte a cell for a mask, 12 for normals, and while a map is made 4 for the light and 8.5 for soft edges.
class DayMaps {
public:
    /// Normals may be empty where no light is asked for. Throws InvalidInput for sizes that differ, cell sizes and
    /// options out of range.
    DayMaps(const HeightField& field, NormalField normals, const DayMapOptions& options,
            const Execution& execution = {});

    /// The map under a sun. Same bytes for any number of threads. Throws InvalidInput for angles out of range,
    /// Cancelled. Cost: that of `exact`, with 4 nanoseconds a cell for light and 2 microseconds for each cell in
    /// half-shadow.
    Grid<std::uint8_t> map(const DirectionalLight& sun, const Execution& execution = {});

private:
    Grid<std::uint8_t> shadow_map(const DirectionalLight& sun, const Execution& execution);
    Grid<std::uint8_t> lit_map(const DirectionalLight& sun, const Execution& execution);

    HeightField field_;
    NormalField normals_;
    DayMapOptions options_;
    TerrainShadows shadows_;
};

} // namespace duskline
