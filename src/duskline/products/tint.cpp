#include <duskline/products/tint.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace duskline {

namespace {

constexpr std::array kNaturalStops = {
    TintStop{0.00, 0x526B4E}, TintStop{0.08, 0x607755}, TintStop{0.20, 0x7E8964}, TintStop{0.36, 0xA09A79},
    TintStop{0.52, 0xA39077}, TintStop{0.68, 0x897C72}, TintStop{0.81, 0x898582}, TintStop{0.90, 0xA6A4A2},
    TintStop{0.96, 0xCDCDCD}, TintStop{1.00, 0xDFE0E0},
};
constexpr std::array kAtlasStops = {
    TintStop{0.00, 0xA3BF9D}, TintStop{0.10, 0xB9CCA2}, TintStop{0.25, 0xD8D7AB}, TintStop{0.45, 0xE2CEA2},
    TintStop{0.65, 0xD0B08B}, TintStop{0.82, 0xC4AB98}, TintStop{1.00, 0xF0EEEB},
};
constexpr std::array kAlpineStops = {
    TintStop{0.00, 0x8FA9A0}, TintStop{0.20, 0xA9BBA5}, TintStop{0.45, 0xCBCDB0},
    TintStop{0.70, 0xE3D9BE}, TintStop{1.00, 0xF2ECDD},
};
constexpr std::array kDesertStops = {
    TintStop{0.00, 0xC5B490}, TintStop{0.30, 0xC19F77}, TintStop{0.60, 0xA57A60},
    TintStop{0.85, 0x8D6E60}, TintStop{1.00, 0xC6B7A9},
};
constexpr std::array kMoonStops = {TintStop{0.00, 0x7F7C79}, TintStop{0.50, 0x8B8885},
                                   TintStop{1.00, 0x9B9895}};
constexpr std::array kMarsStops = {TintStop{0.00, 0x86583F}, TintStop{0.50, 0xAB7853},
                                   TintStop{1.00, 0xCBA07A}};
constexpr std::array kPlasterStops = {TintStop{0.00, 0xC8C6C2}};

constexpr std::array kNamedTints = {
    NamedTint{"natural", "forest, grass, rock and snow, as from the air", kNaturalStops, true, 0x857D76, 0.6f,
              0x6496A6, 0x2A4C66},
    NamedTint{"atlas", "light hypsometric colours of a printed atlas", kAtlasStops, true, 0xC4B4A0, 0.3f,
              0xB4D3DC, 0x7FAFC8},
    NamedTint{"alpine", "grey-green valleys to cream summits, after Imhof", kAlpineStops, false, 0xB9B6AE,
              0.5f, 0xA3C1C6, 0x6C95A6},
    NamedTint{"desert", "sand, red rock and pale summits", kDesertStops, false, 0x94705C, 0.5f, 0x7FB0B0,
              0x34606F},
    NamedTint{"moon", "grey dust, a little brighter on high ground", kMoonStops, false, 0xA8A5A1, 0.5f,
              0x8F8C88, 0x8F8C88},
    NamedTint{"mars", "rust to butterscotch", kMarsStops, false, 0x7A5240, 0.3f, 0x8A5A40, 0x8A5A40},
    NamedTint{"plaster", "one warm grey: light and shadow alone", kPlasterStops, false, 0xC8C6C2, 0.0f,
              0xBFC3C6, 0xA9B0B6},
};

constexpr int kGroundEntries = 96;
constexpr int kSeaFloorEntries = 32;

// One of the three axes of Oklab over the stops of a tint, with its slopes there.
class Curve {
public:
    Curve(std::span<const TintStop> stops, double Oklab::*axis)
    {
        for (const TintStop& stop : stops) {
            shares_.push_back(stop.share);
            values_.push_back(oklab_from(colour_from_hex(stop.rgb)).*axis);
        }
        slopes_.assign(stops.size(), 0.0);
        for (std::size_t i = 0; i < stops.size(); ++i)
            slopes_[i] = slope_at_stop(i);
    }

    double at(double share) const
    {
        const auto above = std::upper_bound(shares_.begin(), shares_.end(), share);
        if (above == shares_.begin())
            return values_.front();
        if (above == shares_.end())
            return values_.back();
        const auto i = static_cast<std::size_t>(above - shares_.begin()) - 1;
        const double width = shares_[i + 1] - shares_[i];
        const double t = (share - shares_[i]) / width;
        const double u = 1.0 - t;
        // The cubic of Hermite.
        return values_[i] * u * u * (1.0 + 2.0 * t) + values_[i + 1] * t * t * (1.0 + 2.0 * u)
               + width * t * u * (slopes_[i] * u - slopes_[i + 1] * t);
    }

private:
    double chord(std::size_t i) const
    {
        return (values_[i + 1] - values_[i]) / (shares_[i + 1] - shares_[i]);
    }

    // The harmonic mean of the slopes on both sides, 0 at a turning point.
    double slope_at_stop(std::size_t i) const
    {
        if (values_.size() < 2)
            return 0.0;
        if (i == 0)
            return chord(0);
        if (i + 1 == values_.size())
            return chord(i - 1);
        const double before = chord(i - 1);
        const double after = chord(i);
        return before * after > 0.0 ? 2.0 * before * after / (before + after) : 0.0;
    }

    std::vector<double> shares_;
    std::vector<double> values_;
    std::vector<double> slopes_;
};

// From lowest land to the height of the last stop's colour.
struct LandSpan {
    double base_m;
    double top_m;
    double reach; // the share of the stops that is used
};

LandSpan land_span(const NamedTint& tint, const HeightSpan& span, const Sea& sea)
{
    const bool near_zero = span.low_m > 0.0f && span.low_m < 0.15f * span.high_m;
    const double base_m = sea.kind != SeaKind::none ? sea.level_m : near_zero ? 0.0 : span.low_m;
    const double top_m = std::max<double>(span.high_m, base_m + 1.0);
    const double reach =
        tint.spares_summit_colours ? 0.45 + 0.55 * std::min(1.0, (top_m - base_m) / 2500.0) : 1.0;
    return {base_m, top_m, reach};
}

void add_land(std::vector<Palette::Entry>& entries, const NamedTint& tint, const LandSpan& land)
{
    const Curve lightness(tint.stops, &Oklab::lightness);
    const Curve a(tint.stops, &Oklab::a);
    const Curve b(tint.stops, &Oklab::b);
    for (int i = 0; i <= kGroundEntries; ++i) {
        const double t = static_cast<double>(i) / kGroundEntries;
        const double share = t * land.reach;
        entries.push_back({std::lerp(land.base_m, land.top_m, t),
                           colour_from(Oklab{lightness.at(share), a.at(share), b.at(share)})});
    }
}

void add_sea_floor(std::vector<Palette::Entry>& entries, const NamedTint& tint, double deepest_m,
                   double level_m)
{
    const Oklab shallow = oklab_from(colour_from_hex(tint.shallow));
    const Oklab deep = oklab_from(colour_from_hex(tint.deep));
    for (int i = 0; i <= kSeaFloorEntries; ++i) {
        // Entries lie closest where colours change fastest.
        const double t = 1.0 - static_cast<double>(i) / kSeaFloorEntries;
        entries.push_back(
            {std::lerp(level_m, deepest_m, t * t),
             colour_from(Oklab{std::lerp(shallow.lightness, deep.lightness, t),
                               std::lerp(shallow.a, deep.a, t), std::lerp(shallow.b, deep.b, t)})});
    }
}

// Every n-th row and column, so that about a million cells are looked at.
std::size_t sampling_step(const HeightField& field)
{
    const double cells = static_cast<double>(field.rows()) * static_cast<double>(field.columns());
    return std::max<std::size_t>(1, static_cast<std::size_t>(std::sqrt(cells / 1e6)));
}

} // namespace

HeightSpan height_span(const HeightField& field)
{
    std::vector<float> heights;
    std::size_t level_zero = 0;
    const std::size_t step = sampling_step(field);
    for (std::size_t y = 0; y < field.rows(); y += step) {
        const auto row = field.heights_m.row(y);
        for (std::size_t x = 0; x < row.size(); x += step) {
            if (std::isnan(row[x]))
                continue;
            heights.push_back(row[x]);
            level_zero += row[x] == 0.0f && row[std::min(x + 1, row.size() - 1)] == 0.0f ? 1U : 0U;
        }
    }
    if (heights.empty())
        return {};
    const auto at = [&](double share) {
        const auto place =
            heights.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(heights.size() - 1));
        std::nth_element(heights.begin(), place, heights.end());
        return *place;
    };
    return {at(0.0), at(0.005), at(0.999), at(1.0),
            static_cast<float>(level_zero) / static_cast<float>(heights.size())};
}

Sea likely_sea(const HeightSpan& span)
{
    if (span.lowest_m < -450.0f)
        return {SeaKind::floor, 0.0f};
    if (span.level_zero_share >= 0.005f)
        return {SeaKind::surface, 0.0f};
    return {};
}

Tint plain_tint(Palette palette)
{
    Tint tint;
    tint.ground = std::move(palette);
    return tint;
}

std::span<const NamedTint> named_tints()
{
    return kNamedTints;
}

const NamedTint& tint_named(std::string_view name)
{
    std::string names;
    for (const NamedTint& tint : kNamedTints) {
        if (tint.name == name)
            return tint;
        names += (names.empty() ? "" : ", ") + std::string(tint.name);
    }
    throw InvalidInput("no palette is called '" + std::string(name) + "'; there are " + names);
}

Tint fitted(const NamedTint& tint, const HeightSpan& span, const Sea& sea)
{
    std::vector<Palette::Entry> entries;
    if (sea.kind == SeaKind::floor)
        add_sea_floor(entries, tint, std::min<double>(span.lowest_m, sea.level_m - 1.0), sea.level_m);
    add_land(entries, tint, land_span(tint, span, sea));

    Tint result;
    result.ground = Palette(std::move(entries));
    result.rock = colour_from_hex(tint.rock);
    result.rock_share = tint.rock_share;
    result.sea = sea;
    result.shallow = colour_from_hex(tint.shallow);
    result.deep = colour_from_hex(tint.deep);
    return result;
}

} // namespace duskline
