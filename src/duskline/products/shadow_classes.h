#pragma once

#include <duskline/casting/shadow_mask.h>
#include <duskline/execution/progress.h>
#include <duskline/light/directional_light.h>

#include <cstdint>

namespace duskline {

/// Why a cell is dark. A byte, so that the classes go to a file as they are.
enum class ShadowClass : std::uint8_t {
    lit = 0,
    self_shaded = 1, ///< in shadow, and its own slope looks away from the light
    cast = 2,        ///< in shadow although its slope looks towards the light: something else stands between
    unknown = 255    ///< no data
};

using ShadowClasses = Grid<ShadowClass>;

/// Splits the shadow of a mask in two. The slope of a cell looks away when its normal, by Horn's slope
/// (terrain/normals.h), is at right angles to the light or farther from it. What the mask calls lit stays
/// lit, whatever its slope: Horn's slope is that of a cell and its neighbours, and the far side of a sharp
/// ridge can be lit on its crest. At night everything is in shadow, and mostly its own.
///
/// Throws InvalidInput when the mask has another size than the field, or for angles out of range; Cancelled.
/// Cost: a pass over heights and mask.
ShadowClasses shadow_classes(const HeightField& field, const ShadowMask& mask, const DirectionalLight& light,
                             const Execution& execution = {});

} // namespace duskline
