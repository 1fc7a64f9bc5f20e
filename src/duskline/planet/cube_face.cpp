#include <duskline/planet/cube_face.h>

#include <cmath>

namespace duskline {

std::uint32_t face_of(const Vector3& direction)
{
    const double x = std::abs(direction.x);
    const double y = std::abs(direction.y);
    const double z = std::abs(direction.z);
    if (x >= y && x >= z)
        return direction.x >= 0.0 ? 0 : 2;
    if (y >= z)
        return direction.y >= 0.0 ? 1 : 3;
    return direction.z >= 0.0 ? 4 : 5;
}

} // namespace duskline
