#pragma once

#include <duskline/execution/progress.h>
#include <duskline/products/block_means.h>
#include <duskline/products/tint.h>
#include <duskline/terrain/height_field.h>

#include <array>
#include <span>
#include <vector>

namespace duskline {

/// The colours of a sea whose floor is not known (`SeaKind::surface`): bright along the shore, deep far out.
/// A drawing, not a depth: what counts is how much land lies around, within about 1 % and 5 % of the
/// picture's diagonal. Keeps references to both arguments.
class LevelWater {
public:
    LevelWater(const HeightField& field, const Tint& tint, const Execution& execution);

    bool is_water(float height_m) const
    {
        return tint_.sea.kind == SeaKind::surface && height_m == tint_.sea.level_m;
    }

    /// Whether any colour of water is to be seen at all.
    bool exists() const { return !shores_.empty(); }

    /// How much of each cell of a row shows water: near 1 or 0 along a straight shore, between where a shore
    /// turns, so that its stairs are rounded off.
    void fill_cover(std::size_t row, std::span<float> cover) const;

    /// The colour of water at each cell of a row.
    void fill_colours(std::size_t row, std::span<Colour> colours) const;

private:
    const HeightField& field_;
    const Tint& tint_;
    std::vector<BlockMeans> shores_; // of land: 1, of water: 0; near and wide
};

} // namespace duskline
