#pragma once

#include <duskline/view/shadow_box.h>

#include <functional>

namespace duskline::gl {

/// A place of the ground or above it, and the truth about it.
struct GroundPlace {
    Vector3 position_m;
    bool lit = false;
};

/// The ground at so many metres, two ways across, from the place that is asked about, and so many above it.
using GroundAround = std::function<GroundPlace(double x_m, double y_m, double above_m)>;

/// Whether an edge of the true shadows passes a place of the ground, `around(0, 0, 0)`, within so many texels of the box's
/// map, measured as the light sees it: some ground around has the other truth, or a place in shadow comes out of it when it
/// is lifted. (Not the other way round: what is lowered into the ground is in its shadow.)
///
///      light \   \                    a  where the shadow truly ends
///             \___\__                 b  where the map lets it end: wrong is what lies between the two; how far they are
///         ____/\   \ |  in texels        apart on the ground says how the light falls on it, and nothing of the map
///        /      \___a_b____
///
/// Ground is tried in 24 directions, up to 60 texels along it.
bool has_edge_within(double texels, const GroundAround& around, const ShadowBox& box);

} // namespace duskline::gl
