#pragma once

// Soft shadows as nobody would compute them: hundreds of suns.

#include <duskline/casting/ray.h>
#include <duskline/casting/visible_fraction.h>

#include <cstddef>
#include <vector>

namespace duskline {

/// Points that share out the disc of a light evenly: a spiral of golden turns (Vogel 1979) on the cap.
std::vector<DirectionalLight> suns_of_disc(const DirectionalLight& light, std::size_t count);

/// The share of that many suns whose rays reach each cell; NaN for no data.
VisibleFraction disc_average(const HeightField& field, const DirectionalLight& light, std::size_t count);

/// How two grids of fractions differ where either is neither 0 nor 1.
struct FractionError {
    double mean = 0.0;
    double worst = 0.0;
    std::size_t cells = 0;   ///< in half-shadow
    std::size_t far_off = 0; ///< of them by more than a tenth
};
FractionError fraction_error(const VisibleFraction& actual, const VisibleFraction& expected);

} // namespace duskline
