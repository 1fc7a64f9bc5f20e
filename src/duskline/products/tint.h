#pragma once

#include <duskline/products/palette.h>
#include <duskline/terrain/height_field.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace duskline {

/// What matters of a terrain's heights when it is coloured.
struct HeightSpan {
    float lowest_m = 0.0f;
    float low_m = 0.0f;  ///< one cell in 200 lies below it
    float high_m = 0.0f; ///< one cell in 1000 lies above it
    float highest_m = 0.0f;
    float level_zero_share = 0.0f; ///< of the cells: exactly 0 m, and so is the neighbour to the right
};

/// Looks at about a million cells spread evenly over the terrain, or all of a smaller one; zeros when none of
/// them has data.
HeightSpan height_span(const HeightField& field);

/// The surface of the sea.
enum class SeaKind {
    none,
    surface, ///< ground at sea level exactly is water; what lies lower is land
    floor,   ///< everything below sea level is sea floor
};

struct Sea {
    SeaKind kind = SeaKind::none;
    float level_m = 0.0f;
};

/// The sea there seems to be, at 0 m: with its floor where ground goes below -450 m, lower than any dry land
/// on Earth (the shore of the Dead Sea: -430 m); a surface where at least one cell in 200 is exactly 0 and so
/// is its neighbour; none otherwise.
Sea likely_sea(const HeightSpan& span);

/// The colours of a relief: what each cell would look like lying level in full light.
struct Tint {
    Palette ground;

    /// Steep ground turns to this colour, bare rock, as far as this share: nothing at slopes up to
    /// `kSteepBegins`, all of it from `kSteepEnds` on.
    Colour rock;
    float rock_share = 0.0f;
    static constexpr float kSteepBegins = 0.45f; ///< rise over run
    static constexpr float kSteepEnds = 1.05f;

    /// For `SeaKind::surface`: water takes colours from `shallow`, at the shore, to `deep`, far out.
    Sea sea;
    Colour shallow;
    Colour deep;
};

/// A tint of one palette and nothing else.
Tint plain_tint(Palette palette);

/// A colour at a share of the way from the lowest land to the highest.
struct TintStop {
    double share;
    std::uint32_t rgb; ///< sRGB, 0xRRGGBB
};

/// A tint that fits itself to a terrain.
struct NamedTint {
    std::string_view name;        ///< as typed after --palette
    std::string_view description; ///< one line for --help and the docs
    std::span<const TintStop> stops;
    bool spares_summit_colours; ///< low mountains do not reach the colours of high ones
    std::uint32_t rock;
    float rock_share;
    std::uint32_t shallow;
    std::uint32_t deep;
};

/// Every named tint, the one for Earth first.
std::span<const NamedTint> named_tints();

/// The tint of that name. Throws InvalidInput, listing the names there are.
const NamedTint& tint_named(std::string_view name);

/// The tint laid over a terrain's heights.
///
/// Its stops spread from the lowest land to the highest: from sea level where there is a sea, from 0 where the
/// lowest ground is near it (below 15 % of the highest), else from the low end of the span. Where
/// `spares_summit_colours`, land that rises 2500 m or more reaches the last colour, a plain stays within the
/// first 45 %. Between stops colours follow smooth curves without overshoot (Fritsch and Butland, A method for
/// constructing local monotone piecewise cubic interpolants, 1984) in Oklab. The floor of a sea falls from
/// `shallow` to `deep` with the square root of its depth.
Tint fitted(const NamedTint& tint, const HeightSpan& span, const Sea& sea);

} // namespace duskline
