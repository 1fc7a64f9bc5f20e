// Soft shadows by horizons across the disc of the light.
//
//        .-+-+-.
//      /_| | | | \          Each slice is looked at along its middle; the horizon there, level across the slice,
//     | ||_|_|_| ||         leaves so much of it to be seen. First groups of five: a smooth horizon needs no
//      \ | | | |_/          more. Where the horizon jumps from one group to the next, a tower's edge, or hides
//        `-+-+-'            a side of the disc and not its lower part, it is looked at slice by slice.
//
// Most cells see all of the disc or nothing of it. Those that the suns at its upper and lower edge agree about, and
// those at its sides, need no horizon.

#include <duskline/casting/greatest_magnitude.h>
#include <duskline/casting/horizon_rays.h>
#include <duskline/casting/visible_fraction.h>
#include <duskline/execution/for_rows.h>
#include <duskline/light/disc_slices.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

namespace duskline {

namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr std::size_t kRowsPerPiece = 16;
constexpr std::size_t kCellsAtOnce = 64;

// Wider discs are not as their edges are.
constexpr double kWidestByEdges_deg = 1.0;

// A sun below this is not asked for its shadows: their ends are lost in the rounding of heights.
constexpr double kLowest_deg = 0.05;

// Horizons of neighbouring groups that differ by this share of the disc's height jump.
constexpr double kJump = 0.125;

VisibleFraction everywhere(const HeightField& field, float value)
{
    VisibleFraction result(field.rows(), field.columns());
    for (std::size_t y = 0; y < field.rows(); ++y)
        std::ranges::transform(field.heights_m.row(y), result.row(y).begin(),
                               [value](float height_m) { return std::isnan(height_m) ? kUnknown : value; });
    return result;
}

VisibleFraction as_fraction(const ShadowMask& mask)
{
    VisibleFraction result(mask.rows(), mask.columns());
    std::ranges::transform(mask.values(), result.values().begin(), [](Lit lit) {
        return lit == Lit::unknown ? kUnknown : lit == Lit::yes ? 1.0f : 0.0f;
    });
    return result;
}

// ---------------------------------------------------------------------------------------------------------
// Horizons

// What all cells share: the disc, and rays towards each slice of it.
class Disc {
public:
    Disc(const HeightField& field, const DirectionalLight& light, const DiscSlices& slices,
         const Execution& execution)
        : slices_(slices), greatest_m_(greatest_magnitude_m(kernels::active_kernels(), field, execution)),
          maxima_(field, plane(field, light), greatest_m_, {.threads = execution.threads})
    {
        const auto rays = [&](const DiscSlice& slice) {
            return HorizonRays(field, maxima_, greatest_m_, slice.azimuth(), slice.lowest_tangent(),
                               slice.highest_tangent());
        };
        for (const DiscGroup& group : slices.groups) {
            all_.push_back(rays(group.all));
            for (const DiscSlice& part : group.parts)
                parts_.push_back(rays(part));
            height_ = std::max(height_, group.all.highest_tangent() - group.all.lowest_tangent());
        }
    }

    std::size_t groups() const { return all_.size(); }

    // By groups, and slices where the horizon jumps. `tangents` is room for one number a group; `hint` says where the
    // horizon stood last time.
    float seen_from(std::size_t row, std::size_t column, std::vector<double>& tangents,
                    std::int64_t& hint) const
    {
        for (std::size_t i = 0; i < all_.size(); ++i)
            tangents[i] = all_[i].tangent(row, column, hint);
        double seen = 0.0;
        for (std::size_t i = 0; i < all_.size(); ++i)
            seen += jumps_beside(tangents, i) ? seen_of_parts(i, row, column, hint)
                                              : slices_.groups[i].all.above(tangents[i]);
        return static_cast<float>(seen);
    }

    // By slices.
    float seen_slice_by_slice(std::size_t row, std::size_t column, std::int64_t& hint) const
    {
        double seen = 0.0;
        for (std::size_t i = 0; i < all_.size(); ++i)
            seen += seen_of_parts(i, row, column, hint);
        return static_cast<float>(seen);
    }

private:
    static TiltedPlane plane(const HeightField& field, const DirectionalLight& light)
    {
        DirectionalLight middle = light;
        middle.altitude = Angle::from_degrees(std::clamp(light.altitude.degrees(), 0.0, 75.0));
        return plane_along(middle, field.cell_size_m);
    }

    double seen_of_parts(std::size_t group, std::size_t row, std::size_t column, std::int64_t& hint) const
    {
        double seen = 0.0;
        for (std::size_t k = 0; k < DiscGroup::kParts; ++k) {
            const HorizonRays& rays = parts_[DiscGroup::kParts * group + k];
            seen += slices_.groups[group].parts[k].above(rays.tangent(row, column, hint));
        }
        return seen;
    }

    bool jumps_beside(const std::vector<double>& tangents, std::size_t i) const
    {
        const std::size_t count = tangents.size();
        const bool before = i > 0 || slices_.all_around;
        const bool after = i + 1 < count || slices_.all_around;
        return (before && jumps(tangents, (i + count - 1) % count, i))
               || (after && jumps(tangents, i, (i + 1) % count));
    }

    // As far as both groups reach, there is a jump from one to the other.
    bool jumps(const std::vector<double>& tangents, std::size_t i, std::size_t k) const
    {
        const DiscSlice& a = slices_.groups[i].all;
        const DiscSlice& b = slices_.groups[k].all;
        const double lowest = std::max(a.lowest_tangent(), b.lowest_tangent());
        const double highest = std::max(lowest, std::min(a.highest_tangent(), b.highest_tangent()));
        return std::abs(std::clamp(tangents[i], lowest, highest) - std::clamp(tangents[k], lowest, highest))
               > kJump * height_;
    }

    const DiscSlices& slices_;
    double greatest_m_; // magnitude of any height
    TiltedMaxima maxima_;
    std::vector<HorizonRays> all_;
    std::vector<HorizonRays> parts_;
    double height_ = 0.0;
};

// ---------------------------------------------------------------------------------------------------------
// Which cells need them

// The masks of some suns at the edge of the disc.
using EdgeMasks = std::vector<ShadowMask>;

EdgeMasks edge_masks(const HeightField& field, const DirectionalLight& light, const DiscSlices& slices,
                     const Caster& caster, const Execution& execution)
{
    const double radius_deg = light.angular_diameter.degrees() / 2.0;
    const auto edge = [&](Angle azimuth, double altitude_deg) {
        DirectionalLight sun = light;
        sun.azimuth = azimuth;
        // All the same at night as on an evening when shadows have no end.
        sun.altitude = Angle::from_degrees(altitude_deg < kLowest_deg ? 0.0 : std::min(altitude_deg, 90.0));
        return sun;
    };
    const double altitude_deg = light.altitude.degrees();
    const DirectionalLight left = edge(slices.groups.front().parts.front().azimuth(), altitude_deg);
    const DirectionalLight right = edge(slices.groups.back().parts.back().azimuth(), altitude_deg);
    EdgeMasks masks;
    masks.push_back(
        caster.cast(field, edge(light.azimuth, altitude_deg + radius_deg), part_of(execution, 0.0, 0.4)));
    masks.push_back(
        caster.cast(field, edge(light.azimuth, altitude_deg - radius_deg), part_of(execution, 0.4, 0.8)));
    masks.push_back(cast_by_sweep(field, left, part_of(execution, 0.8, 0.9)));
    masks.push_back(cast_by_sweep(field, right, part_of(execution, 0.9, 1.0)));
    return masks;
}

// A cell that sees a part of the disc.
struct OpenCell {
    std::size_t column;
    bool sideways; // its horizon is steep: hides a side of the disc, not its lower part
};

// Whether the edges agree about `count` cells: nearly always.
bool edges_agree(const EdgeMasks& masks, std::size_t row, std::size_t first, std::size_t count)
{
    const auto same = [&](std::size_t a, std::size_t b) {
        return std::memcmp(&masks[a](row, first), &masks[b](row, first), count) == 0;
    };
    return same(0, 1) && same(2, 3);
}

// One row of answers where all edges agree; the cells where they do not go to `open`.
void answer_row(const EdgeMasks& masks, std::size_t row, float full_light, std::span<float> out,
                std::vector<OpenCell>& open)
{
    const auto high = masks[0].row(row);
    const auto low = masks[1].row(row);
    const auto left = masks[2].row(row);
    const auto right = masks[3].row(row);
    open.clear();
    for (std::size_t x = 0; x < out.size(); ++x)
        out[x] = high[x] == Lit::unknown ? kUnknown : high[x] == Lit::yes ? full_light : 0.0f;
    for (std::size_t first = 0; first < out.size(); first += kCellsAtOnce) {
        const std::size_t last = std::min(first + kCellsAtOnce, out.size());
        if (edges_agree(masks, row, first, last - first))
            continue;
        for (std::size_t x = first; x < last; ++x)
            if (high[x] != low[x] || left[x] != right[x])
                open.push_back({x, high[x] == low[x]});
    }
}

void open_row(std::span<const float> heights_m, std::span<float> out, std::vector<OpenCell>& open)
{
    open.clear();
    for (std::size_t x = 0; x < out.size(); ++x) {
        out[x] = kUnknown;
        if (!std::isnan(heights_m[x]))
            open.push_back({x, true});
    }
}

VisibleFraction seen_by_horizons(const HeightField& field, const DirectionalLight& light,
                                 const DiscSlices& slices, const EdgeMasks& masks, const Execution& execution)
{
    const Disc disc(field, light, slices, execution);
    const auto full_light = static_cast<float>(slices.above_horizontal);
    VisibleFraction result(field.rows(), field.columns());
    for_rows(field.rows(), kRowsPerPiece, execution, [&](std::size_t first, std::size_t last) {
        std::vector<OpenCell> open;
        std::vector<double> tangents(disc.groups());
        for (std::size_t row = first; row < last; ++row) {
            const auto out = result.row(row);
            if (masks.empty())
                open_row(field.heights_m.row(row), out, open);
            else
                answer_row(masks, row, full_light, out, open);
            std::int64_t hint = 0; // by row, so that no bit depends on how rows are shared out
            for (const OpenCell& cell : open)
                out[cell.column] = cell.sideways ? disc.seen_slice_by_slice(row, cell.column, hint)
                                                 : disc.seen_from(row, cell.column, tangents, hint);
        }
    });
    return result;
}

} // namespace

VisibleFraction visible_fraction(const HeightField& field, const DirectionalLight& light,
                                 const Caster& caster, const Execution& execution)
{
    require_valid(field);
    require_valid(light);
    if (light.angular_diameter.degrees() == 0.0)
        return as_fraction(caster.cast(field, light, execution));
    const DiscSlices slices = disc_slices(light);
    if (slices.groups.empty() || field.heights_m.empty())
        return everywhere(field, 0.0f);
    EdgeMasks masks;
    if (light.angular_diameter.degrees() <= kWidestByEdges_deg)
        masks = edge_masks(field, light, slices, caster, part_of(execution, 0.0, 0.5));
    return seen_by_horizons(field, light, slices, masks, part_of(execution, masks.empty() ? 0.0 : 0.5, 1.0));
}

} // namespace duskline
