#pragma once

#include <duskline/casting/exact.h>
#include <duskline/casting/line_march.h>
#include <duskline/casting/ray.h>
#include <duskline/casting/shadow_mask.h>
#include <duskline/casting/smap.h>
#include <duskline/casting/strider.h>
#include <duskline/casting/sweep.h>
#include <duskline/execution/progress.h>

#include <array>
#include <string_view>

namespace duskline {

/// One way to find shadows. The command line, the tests, the benchmarks and the docs iterate over
/// `kCasters`: a new technique is a new file and one row.
struct Caster {
    std::string_view name;        ///< as typed after --caster
    std::string_view description; ///< one line for --help and the docs
    std::string_view source;      ///< where the method comes from
    bool exact;                   ///< agrees with `ray` cell for cell, but for ties within float rounding

    ShadowMask (*cast)(const HeightField&, const DirectionalLight&, const Execution&);
    ShadowField (*shadow_heights)(const HeightField&, const DirectionalLight&, const Execution&);

    /// The same for a lamp; null where the caster takes none. See lamps.h.
    ShadowMask (*cast_lamp)(const HeightField&, const PointLight&, const Execution&);
    ShadowField (*lamp_shadow_heights)(const HeightField&, const PointLight&, const Execution&);

    /// Memory for what it keeps of the whole terrain beside heights and answers, where that is not less than a share
    /// of them that planners add anyway: about so many bytes a cell.
    double bytes_per_cell = 0.0;
};

/// Every caster there is, the reference first.
inline constexpr std::array kCasters = {
    Caster{"ray", "march every cell towards the light in double precision; slow, the reference",
           "the definition of a shadow on the grid-line surface", true, cast_by_ray, shadow_heights_by_ray,
           cast_by_ray, shadow_heights_by_ray},
    Caster{"fast-ray", "the same rays over a min/max pyramid, the same answers in a small part of the time",
           "Tevs, Ihrke and Seidel, maximum mipmaps, 2008", true, cast_by_fast_ray,
           shadow_heights_by_fast_ray, cast_by_fast_ray, shadow_heights_by_fast_ray},
    Caster{"exact", "carry the true front across the grid; the ray's answers at nearly the sweep's price",
           "upper envelope by plane sweep, Reif and Sen 1988", true, cast_by_exact, shadow_heights_by_exact,
           cast_by_exact, shadow_heights_by_exact},
    Caster{"sweep", "carry one front of shadow heights across the grid; fastest, off only at shadow edges",
           "plane sweep in the frame of the beams", false, cast_by_sweep, shadow_heights_by_sweep, nullptr,
           nullptr},
    Caster{"smap",
           "ask a map of silhouettes, the only ground that can shade; lines along the light do not count",
           "Sakalauskas, Hybrid Terrain Shadow Ray Casting, 2008", false, cast_by_smap,
           shadow_heights_by_smap, nullptr, nullptr, sizeof(SilhouetteTexel)},
    Caster{"strider",
           "cast lines from what is lit, away from the light; fast, off by half a cell at shadow edges",
           "Strahan, Strider Technique, gamedev.net 2004", false, cast_by_strider, shadow_heights_by_strider,
           nullptr, nullptr},
    Caster{"line-march", "look at the nearest sample, one cell at a time towards the light; darkens slopes",
           "Fast Computation of Terrain Shadow Maps, gamedev.net", false, cast_by_line_march,
           shadow_heights_by_line_march, cast_by_line_march, shadow_heights_by_line_march},
    Caster{"line-march-bilinear",
           "the same steps over the bilinear surface; off at shadow edges and thin crests",
           "Fast Computation of Terrain Shadow Maps, gamedev.net", false, cast_by_line_march_bilinear,
           shadow_heights_by_line_march_bilinear, cast_by_line_march_bilinear,
           shadow_heights_by_line_march_bilinear},
};

/// The caster of that name. Throws InvalidInput, listing the names there are.
const Caster& caster_named(std::string_view name);

} // namespace duskline
