#include <duskline/casting/lamps.h>

#include <algorithm>
#include <string>
#include <utility>

namespace duskline {

namespace {

// The share of the progress that lamp i of `count` has.
Execution part_of(const Execution& execution, std::size_t i, std::size_t count)
{
    if (!execution.progress)
        return execution;
    const auto at = [i, count](double done) {
        return (static_cast<double>(i) + done) / static_cast<double>(count);
    };
    return {.threads = execution.threads,
            .progress = [at, &execution](double done) { return execution.progress(at(done)); }};
}

// Casts lamp after lamp and calls `take(i, mask)`.
template <typename Take>
void for_each_lamp(const Caster& caster, const HeightField& field, std::span<const PointLight> lamps,
                   const Execution& execution, const Take& take)
{
    require_takes_lamps(caster);
    for (const PointLight& lamp : lamps)
        require_valid(lamp);
    for (std::size_t i = 0; i < lamps.size(); ++i)
        take(i, caster.cast_lamp(field, lamps[i], part_of(execution, i, lamps.size())));
}

} // namespace

void require_takes_lamps(const Caster& caster)
{
    if (caster.cast_lamp != nullptr)
        return;
    std::string names;
    for (const Caster& other : kCasters)
        if (other.cast_lamp != nullptr)
            names += (names.empty() ? "" : ", ") + std::string(other.name);
    throw InvalidInput("the caster '" + std::string(caster.name)
                       + "' takes no point lights; these do: " + names);
}

ShadowMask cast_lamp(const Caster& caster, const HeightField& field, const PointLight& lamp,
                     const Execution& execution)
{
    require_takes_lamps(caster);
    return caster.cast_lamp(field, lamp, execution);
}

ShadowMask lit_by_any(const Caster& caster, const HeightField& field, std::span<const PointLight> lamps,
                      const Execution& execution)
{
    ShadowMask any = uniform_mask(field, Lit::no);
    for_each_lamp(caster, field, lamps, execution, [&](std::size_t, const ShadowMask& mask) {
        for (std::size_t cell = 0; cell < mask.size(); ++cell)
            if (mask.values()[cell] == Lit::yes)
                any.values()[cell] = Lit::yes;
    });
    return any;
}

ShadowField shadow_heights_of_any(const Caster& caster, const HeightField& field,
                                  std::span<const PointLight> lamps, const Execution& execution)
{
    require_takes_lamps(caster);
    ShadowField lowest = uniform_shadow_heights(field, Lit::no);
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        const ShadowField shadows =
            caster.lamp_shadow_heights(field, lamps[i], part_of(execution, i, lamps.size()));
        for (std::size_t cell = 0; cell < shadows.size(); ++cell)
            lowest.values()[cell] = std::min(lowest.values()[cell], shadows.values()[cell]); // NaN in both
    }
    return lowest;
}

Grid<std::uint16_t> count_lamps(const Caster& caster, const HeightField& field,
                                std::span<const PointLight> lamps, const Execution& execution)
{
    if (lamps.size() >= kNoLampCount)
        throw InvalidInput("at most 65534 lamps can be counted, got " + std::to_string(lamps.size()));
    Grid<std::uint16_t> counts(field.rows(), field.columns());
    const ShadowMask none = uniform_mask(field, Lit::no);
    std::ranges::transform(none.values(), counts.values().begin(),
                           [](Lit lit) { return lit == Lit::unknown ? kNoLampCount : std::uint16_t{0}; });
    for_each_lamp(caster, field, lamps, execution, [&](std::size_t, const ShadowMask& mask) {
        for (std::size_t cell = 0; cell < mask.size(); ++cell)
            if (mask.values()[cell] == Lit::yes)
                ++counts.values()[cell];
    });
    return counts;
}

std::vector<ShadowMask> cast_each_lamp(const Caster& caster, const HeightField& field,
                                       std::span<const PointLight> lamps, const Execution& execution)
{
    std::vector<ShadowMask> masks;
    for_each_lamp(caster, field, lamps, execution,
                  [&](std::size_t, ShadowMask mask) { masks.push_back(std::move(mask)); });
    return masks;
}

} // namespace duskline
