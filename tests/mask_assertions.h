#pragma once

// What a caster's masks may differ in, and assertions that say where they do.

#include <duskline/casting/casters.h>

#include <gtest/gtest.h>

#include <iosfwd>

namespace duskline {

std::ostream& operator<<(std::ostream& out, Lit lit);
void PrintTo(const Caster& caster, std::ostream* out);

/// The name of a caster as GoogleTest allows it: fast-ray becomes fast_ray.
std::string test_name(const testing::TestParamInfo<Caster>& info);

/// Whether a caster is the truth itself, and owes every cell.
bool is_truth(const Caster& caster);

/// Whether a caster takes the nearest sample for the ground under a ray: slopes are stairs to it, whose steps cast
/// shadows anywhere, not only beside edges.
bool takes_slopes_for_stairs(const Caster& caster);

/// Whether a caster looks at places a cell apart and at nothing between them, crests narrower than that included.
bool steps_over_crests(const Caster& caster);

/// Whether a caster answers for a place up to half a cell from a cell's centre.
bool answers_beside_centres(const Caster& caster);

/// How far ground and ray may be apart, metres, for their order to be a matter of float rounding: 7 millionths
/// of the highest ground, 2 cm on a 4000 m mountain (docs/accuracy.md).
double float_rounding_m(const HeightField& field);

/// 1 for each cell whose ground is no further than that from the height of the shadow over it, else 0.
Grid<char> ties(const HeightField& field, const ShadowField& shadow_m);

/// 1 for each cell in which `caster` may be wrong on this terrain and light, else 0:
///
///   the truth      none
///   an exact one   cells whose ground is within float rounding of the shadow's height
///   another        cells next to a shadow edge, or no further from one in height than the shadow's height
///                  changes within a cell. Such casters move edges: they interpolate what lies between
///                  samples. By a whole cell, and no more where shadows are wider than a cell.
Grid<char> excuses(const Caster& caster, const HeightField& field, const DirectionalLight& light);

/// The same for a lamp; an exact caster has no excuse.
Grid<char> excuses(const Caster& caster, const HeightField& field, const PointLight& lamp);

/// Whether two masks are the same in every cell that is not excused; else where they differ.
testing::AssertionResult same_mask(const ShadowMask& actual, const ShadowMask& expected);
testing::AssertionResult same_mask(const ShadowMask& actual, const ShadowMask& expected,
                                   const Grid<char>& excused);

/// Whether no cell but the excused turns from lit to shadow; else where one does.
testing::AssertionResult no_new_shadow(const ShadowMask& before, const ShadowMask& after,
                                       const Grid<char>& excused);

/// Whether two grids of numbers have the same bits, any NaN being like any other.
testing::AssertionResult same_bits(const Grid<float>& actual, const Grid<float>& expected);

} // namespace duskline
