#include <duskline/planet/made_up_detail.h>
#include <duskline/planet/planet_tile.h>

#include <cmath>

namespace duskline {

namespace {

constexpr double kSamplesPerFeature = 4.0;

std::uint64_t scrambled(std::uint64_t value)
{
    value = (value ^ (value >> 30U)) * 0xBF58476D1CE4E5B9U;
    value = (value ^ (value >> 27U)) * 0x94D049BB133111EBU;
    return value ^ (value >> 31U);
}

double fraction(std::uint64_t bits)
{
    return static_cast<double>(bits >> 11U) * 0x1p-53;
}

// To the middle of one of a cube's twelve edges.
Vector3 slope_of(std::uint64_t hash)
{
    const double a = (hash & 1U) != 0 ? 1.0 : -1.0;
    const double b = (hash & 2U) != 0 ? 1.0 : -1.0;
    switch ((hash >> 8U) % 3U) {
    case 0:
        return {a, b, 0.0};
    case 1:
        return {a, 0.0, b};
    default:
        return {0.0, a, b};
    }
}

double fade(double t)
{
    return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

double mix(double a, double b, double t)
{
    return a + t * (b - a);
}

} // namespace

DetailBand::DetailBand(std::uint32_t level, std::uint64_t seed)
    : frequency_(static_cast<double>(1U << level) * kTileSquares / (2.0 * kSamplesPerFeature)),
      seed_(scrambled(seed + 0x9E3779B97F4A7C15U * (level + 1)))
{
    // The lattices of different bands have no places in common.
    offset_ = {fraction(scrambled(seed_ + 1)), fraction(scrambled(seed_ + 2)),
               fraction(scrambled(seed_ + 3))};
}

void DetailBand::enter_cell(std::int64_t x, std::int64_t y, std::int64_t z)
{
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
        const auto i = static_cast<std::uint64_t>(x + (corner & 1U));
        const auto j = static_cast<std::uint64_t>(y + ((corner >> 1U) & 1U));
        const auto k = static_cast<std::uint64_t>(z + (corner >> 2U));
        slopes_.at(corner) = slope_of(
            scrambled(seed_ + i * 0x9E3779B97F4A7C15U + j * 0xC2B2AE3D27D4EB4FU + k * 0x165667B19E3779F9U));
    }
    cell_ = {x, y, z};
    has_cell_ = true;
}

double DetailBand::at(const Vector3& direction)
{
    const Vector3 place = direction * frequency_ + offset_;
    const Vector3 lowest = {std::floor(place.x), std::floor(place.y), std::floor(place.z)};
    const auto x = static_cast<std::int64_t>(lowest.x);
    const auto y = static_cast<std::int64_t>(lowest.y);
    const auto z = static_cast<std::int64_t>(lowest.z);
    if (!has_cell_ || cell_[0] != x || cell_[1] != y || cell_[2] != z)
        enter_cell(x, y, z);
    const Vector3 within = place - lowest;
    const auto plane = [&](std::uint32_t corner) {
        const Vector3 from = {within.x - (corner & 1U), within.y - ((corner >> 1U) & 1U),
                              within.z - (corner >> 2U)};
        return dot(slopes_[corner], from);
    };
    const double across = fade(within.x);
    const double along = fade(within.y);
    const auto layer = [&](std::uint32_t first) {
        return mix(mix(plane(first), plane(first + 1), across),
                   mix(plane(first + 2), plane(first + 3), across), along);
    };
    return mix(layer(0), layer(4), fade(within.z));
}

} // namespace duskline
