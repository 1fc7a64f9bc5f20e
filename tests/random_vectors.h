#pragma once

#include <duskline/geometry/vector.h>

#include <random>

namespace duskline {

/// Numbers from -1 to 1, and vectors of them: the same for the same seed.
class RandomVectors {
public:
    explicit RandomVectors(unsigned int seed) : random_(seed) {}

    double number() { return static_cast<double>(random_()) / 4294967295.0 * 2.0 - 1.0; }
    Vector3 vector()
    {
        const double x = number();
        const double y = number();
        return {x, y, number()};
    }

private:
    std::mt19937 random_;
};

} // namespace duskline
