#pragma once

#include <duskline/geometry/grid.h>

namespace duskline {

/// The same values half as finely: each is the mean of the data in a square of two by two, NaN where there are none.
/// An odd last row or column makes narrower squares of its own. One pass.
Grid<float> halved(GridView<const float> values);

} // namespace duskline
