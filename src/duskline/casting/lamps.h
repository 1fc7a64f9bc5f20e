#pragma once

#include <duskline/casting/casters.h>

#include <cstdint>
#include <span>
#include <vector>

namespace duskline {

// Several lamps over one terrain. All functions answer for a terrain of any size and any number of lamps, none
// included; throw InvalidInput for a caster that takes no lamps, naming those that do, and for a lamp out of range;
// and Cancelled. Cost: a cast for every lamp, one after the other, and memory for two answers at a time.

/// Throws InvalidInput for a caster that takes no lamps, naming those that do.
void require_takes_lamps(const Caster& caster);

/// The mask of one lamp, by that caster.
ShadowMask cast_lamp(const Caster& caster, const HeightField& field, const PointLight& lamp,
                     const Execution& execution = {});

/// Lit where at least one of the lamps shines: the shadows that are left where all of them are.
ShadowMask lit_by_any(const Caster& caster, const HeightField& field, std::span<const PointLight> lamps,
                      const Execution& execution = {});

/// The height that a point over a cell needs to be lit by at least one: the lowest of the shadow heights.
ShadowField shadow_heights_of_any(const Caster& caster, const HeightField& field,
                                  std::span<const PointLight> lamps, const Execution& execution = {});

/// What `count_lamps` says of a cell without data.
inline constexpr std::uint16_t kNoLampCount = 65535;

/// How many of the lamps, at most 65534, light each cell. Throws InvalidInput for more lamps.
Grid<std::uint16_t> count_lamps(const Caster& caster, const HeightField& field,
                                std::span<const PointLight> lamps, const Execution& execution = {});

/// The mask of every lamp, in their order.
std::vector<ShadowMask> cast_each_lamp(const Caster& caster, const HeightField& field,
                                       std::span<const PointLight> lamps, const Execution& execution = {});

} // namespace duskline
