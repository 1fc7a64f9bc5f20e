#pragma once

#include <duskline/geometry/vector.h>

#include <gtest/gtest.h>

namespace duskline {

/// Expects two points at most so far apart.
inline void expect_near(const Vector3& a, const Vector3& b, double tolerance)
{
    EXPECT_LT(length(a - b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " and " << b.x << ' ' << b.y << ' ' << b.z;
}

} // namespace duskline
