#include "gl/made_planet.h"

#include <cmath>
#include <limits>

namespace duskline::gl {

const TileHeights& MadePlanet::heights_of(const PlanetTile& tile)
{
    const auto [found, is_new] = tiles_.try_emplace(tile);
    TileHeights& heights = found->second;
    if (!is_new)
        return heights;
    for (std::size_t row = 0; row < kTileStored; ++row)
        for (std::size_t column = 0; column < kTileStored; ++column) {
            const Vector3 direction =
                sample_direction(tile, static_cast<double>(row) - 1.0, static_cast<double>(column) - 1.0);
            heights.heights_m(row, column) = static_cast<float>(ground_m(direction));
            heights.measured(row, column) = measured_ ? 1 : 0;
        }
    heights.range = {std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest()};
    for (const float height_m : heights.heights_m.values())
        heights.range = {std::min(heights.range.lowest_m, height_m),
                         std::max(heights.range.highest_m, height_m)};
    return heights;
}

std::vector<PlanetPatch> whole_level(std::uint32_t level)
{
    constexpr double never = std::numeric_limits<double>::infinity();
    std::vector<PlanetPatch> patches;
    for (std::uint32_t face = 0; face < kCubeFaces; ++face)
        for (std::uint32_t row = 0; row < 1U << level; ++row)
            for (std::uint32_t column = 0; column < 1U << level; ++column)
                patches.push_back({{face, level, row, column}, {never, never}});
    return patches;
}

namespace {

struct Selection {
    MadePlanet& planet;
    Vector3 eye_m;
    double reach;
    std::uint32_t deepest;
    std::vector<PlanetPatch> patches;

    double diagonal_of(std::uint32_t level) const
    {
        return std::sqrt(2.0) * kTileSquares * spacing_m(planet.globe(), level);
    }
    // A level's tiles reach at most one diagonal of the coarser beyond the end of the range where it is split.
    MorphRange range(std::uint32_t level) const
    {
        constexpr double never = std::numeric_limits<double>::infinity();
        if (level == 0)
            return {never, never};
        const double end_m = reach * diagonal_of(level);
        return {std::min(0.95 * end_m, (reach / 2.0 + 1.0) * diagonal_of(level)), end_m};
    }
    void select(const PlanetTile& tile)
    {
        const OrientedBox box = box_around(planet.globe(), tile, planet.heights_of(tile).range);
        if (tile.level == deepest || distance_m(eye_m, box) >= range(tile.level + 1).end_m)
            patches.push_back({tile, range(tile.level)});
        else
            for (const PlanetTile& child : children_of(tile))
                select(child);
    }
};

} // namespace

std::vector<PlanetPatch> patches_around(MadePlanet& planet, const Vector3& eye_m, double reach,
                                        std::uint32_t deepest)
{
    Selection selection = {planet, eye_m, reach, deepest, {}};
    for (std::uint32_t face = 0; face < kCubeFaces; ++face)
        selection.select({face, 0, 0, 0});
    return selection.patches;
}

CameraAxes looking(const Globe& globe, const Vector3& eye_m, double heading_deg, double pitch_deg)
{
    const LocalFrame here = local_frame(globe, normalized(eye_m));
    const auto [sin_heading, cos_heading] = sine_cosine(Angle::from_degrees(heading_deg));
    const auto [sin_pitch, cos_pitch] = sine_cosine(Angle::from_degrees(pitch_deg));
    const Vector3 ahead = here.north * cos_heading + here.east * sin_heading;
    const Vector3 right = here.east * cos_heading - here.north * sin_heading;
    const Vector3 forward = ahead * cos_pitch + here.up * sin_pitch;
    return {forward, right, here.up * cos_pitch - ahead * sin_pitch};
}

} // namespace duskline::gl
