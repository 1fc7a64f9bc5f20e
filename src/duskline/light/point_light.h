#pragma once

#include <duskline/geometry/vector.h>

namespace duskline {

/// Light from one point: a lamp, a tower's beacon, a flare, a fire.
///
///   position  its place over the grid, in rows and columns from the centre of cell (0, 0), and its height in
///             metres above the same zero as the ground's. Anywhere: over the grid or beside it, over the
///             summits, between them or in a pit. Under the ground it lights nothing.
///
/// It shines alike in all directions, as far as the grid goes.
struct PointLight {
    GridPoint position;
};

/// Throws InvalidInput, with the value, unless the place and the height are finite numbers of at most 2^52.
void require_valid(const PointLight& light);

} // namespace duskline
