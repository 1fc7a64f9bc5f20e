#include "disc_average.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace duskline {

std::vector<DirectionalLight> suns_of_disc(const DirectionalLight& light, std::size_t count)
{
    const double golden_turn = std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double radius = light.angular_diameter.radians() / 2.0;
    const double sine = std::sin(light.altitude.radians());
    const double cosine = std::cos(light.altitude.radians());
    std::vector<DirectionalLight> suns;
    for (std::size_t i = 0; i < count; ++i) {
        const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
        const double off = 2.0 * std::asin(std::sqrt(share) * std::sin(radius / 2.0)); // from the middle
        const double turn = golden_turn * static_cast<double>(i);
        const double up = std::sin(off) * std::sin(turn);
        const double aside = std::sin(off) * std::cos(turn);
        const double z = sine * std::cos(off) + cosine * up;
        const double level = cosine * std::cos(off) - sine * up;
        DirectionalLight sun = light;
        sun.altitude = Angle::from_radians(std::atan2(z, std::hypot(level, aside)));
        sun.azimuth = light.azimuth + Angle::from_radians(std::atan2(aside, level));
        suns.push_back(sun);
    }
    return suns;
}

VisibleFraction disc_average(const HeightField& field, const DirectionalLight& light, std::size_t count)
{
    VisibleFraction sum(field.rows(), field.columns(), 0.0f);
    const TerrainRays rays(field);
    for (const DirectionalLight& sun : suns_of_disc(light, count)) {
        const ShadowMask mask = rays.cast(sun, {.threads = 1});
        for (std::size_t i = 0; i < sum.size(); ++i)
            sum.values()[i] += mask.values()[i] == Lit::unknown ? std::numeric_limits<float>::quiet_NaN()
                               : mask.values()[i] == Lit::yes   ? 1.0f
                                                                : 0.0f;
    }
    for (float& value : sum.values())
        value /= static_cast<float>(count);
    return sum;
}

FractionError fraction_error(const VisibleFraction& actual, const VisibleFraction& expected)
{
    const auto is_between = [](float value) { return value > 0.0f && value < 1.0f; };
    FractionError error;
    for (std::size_t i = 0; i < actual.size(); ++i) {
        const float a = actual.values()[i];
        const float b = expected.values()[i];
        const double off = std::abs(static_cast<double>(a) - b);
        if (!is_between(a) && !is_between(b) && !(off > 0.0))
            continue;
        error.mean += off;
        error.worst = std::max(error.worst, off);
        error.far_off += off > 0.1 ? 1U : 0U;
        ++error.cells;
    }
    error.mean /= static_cast<double>(std::max<std::size_t>(error.cells, 1));
    return error;
}

} // namespace duskline
