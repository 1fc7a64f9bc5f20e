#pragma once

#include <duskline/geometry/angle.h>
#include <duskline/geometry/vector.h>
#include <duskline/terrain/height_field.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace duskline {

/// Something that stands upright on a cell of the ground, wherever that is now. Sizes above 0.
struct StandingObject {
    std::uint32_t row = 0;
    std::uint32_t column = 0;
    double height_m = 10.0;
    double width_m = 5.0;
    Angle turn = {};
};

/// An aircraft that flies a level circle, counter-clockwise from above.
struct CirclingAircraft {
    GridPoint middle = {}; ///< and its height, metres
    double radius_m = 1000.0;
    double span_m = 40.0;   ///< from wing tip to wing tip
    double period_s = 30.0; ///< once around; above 0
};

/// Clouds in a thin level layer over the whole terrain.
struct CloudLayer {
    double height_m = 1000.0;
    double feature_m = 2000.0;  ///< from cloud to cloud
    double cover = 0.4;         ///< of the sky, 0 to 1
    double drift_m_per_s = 0.0; ///< eastwards
};

/// What stands on a terrain and flies over it, to see its shadow on.
struct Scenery {
    std::vector<StandingObject> trees = {};
    std::vector<StandingObject> towers = {};
    std::optional<CirclingAircraft> aircraft = {};
    std::optional<CloudLayer> clouds = {};
};

/// A scenery for any terrain, the same each time: groves of trees where the ground is neither level, as water is, nor
/// steeper than 35 degrees nor high; towers on low and gentle ground; an aircraft that keeps clear of the ground under
/// its circle; clouds at half the relief. Sizes follow the terrain's sides and relief, larger than life,
/// so that all of it shows when the whole terrain does. Throws InvalidInput for cell sizes out of range. Cost: a pass.
Scenery usual_scenery(const HeightField& field);

/// Where an aircraft is at a time.
GridPoint place_of(const CirclingAircraft& aircraft, CellSize cell_size_m, double seconds);
/// Which way it flies then, clockwise from the grid's north.
Angle heading_of(const CirclingAircraft& aircraft, double seconds);

/// From the lowest to the highest any of it may be: for depths of a picture. The ground is that of the field.
HeightRange height_range(const Scenery& scenery, HeightRange ground);

} // namespace duskline
