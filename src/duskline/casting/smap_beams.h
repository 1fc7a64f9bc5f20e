#pragma once

// How a silhouette map (smap.h) is built: band by band of neighbouring beams, which have nothing to do with each other.
// Not installed.

#include <duskline/casting/smap.h>

namespace duskline {

/// By how much a section must look higher than the lines before and after it to be surely no silhouette: the light's
/// drop, with the rounding of heights taken off. See SilhouetteMap::rise_m and fall_m.
struct SilhouetteMargins {
    float rise_m = 0.0f;
    float fall_m = 0.0f;
};
SilhouetteMargins silhouette_margins(double drop_m, float greatest_m);

/// The lines of a frame. `greatest_m` is the greatest magnitude of all heights.
std::vector<SilhouetteLineFacts> silhouette_lines(const LightFrame& frame, std::size_t lines,
                                                  float greatest_m);

/// What all bands have in common.
struct SilhouetteBuild {
    LightOrder<const float> heights;
    const std::vector<SilhouetteLineFacts>& lines;
    SilhouetteMargins margins;
    SilhouetteMapOptions options;
};

/// All texels. Throws Cancelled.
Grid<SilhouetteTexel> silhouette_texels(const SilhouetteBuild& build, const Execution& execution);

} // namespace duskline
