#pragma once

#include <duskline/geometry/vector.h>

namespace duskline {

/// At right angles to both, as long as the area they span; a, b and it are right-handed.
constexpr Vector3 cross(Vector3 a, Vector3 b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

} // namespace duskline
