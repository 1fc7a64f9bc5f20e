#pragma once

#include <duskline/geometry/vector.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace duskline {

/// Relief that nobody measured, for ground seen more closely than any source: a number between -1 and 1, and hardly ever
/// near them, for every place and level. Bands of noise, each half as wide as the one before; band `level` has features
/// of four samples of the tiles of that level, so a tile has the bands up to its own level.
///
/// It depends on direction, level and seed alone, by basic arithmetic and integer hashes: the same bits on every machine.
/// Source: K. Perlin, Improving noise, 2002, on the sphere as a cut through space.
class DetailBand {
public:
    DetailBand(std::uint32_t level, std::uint64_t seed);

    /// About 15 ns; half of it when called for places one after the other. An object serves one thread.
    double at(const Vector3& direction);

    /// Distance between features, in radians.
    double wavelength() const { return 1.0 / frequency_; }

private:
    void enter_cell(std::int64_t x, std::int64_t y, std::int64_t z);

    double frequency_;
    std::uint64_t seed_;
    Vector3 offset_;
    // The corners of the cell that was asked for last.
    std::array<std::int64_t, 3> cell_ = {};
    bool has_cell_ = false;
    std::array<Vector3, 8> slopes_;
};

} // namespace duskline
