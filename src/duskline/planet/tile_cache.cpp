#include <duskline/execution/for_rows.h>
#include <duskline/geometry/cross_product.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/planet/tile_cache.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace duskline {

namespace {

constexpr std::size_t kLeastTiles = 64;

// Of the part of a parent that its child lies on, its samples on the border included.
HeightRange range_under_child(const TileHeights& parent, const PlanetTile& child)
{
    constexpr std::int32_t half = kTileSquares / 2;
    const std::int32_t first_row = child.row % 2 == 0 ? 0 : half;
    const std::int32_t first_column = child.column % 2 == 0 ? 0 : half;
    HeightRange range;
    for (std::int32_t row = first_row; row <= first_row + half; ++row)
        for (std::int32_t column = first_column; column <= first_column + half; ++column)
            range.include(parent.height_m(row, column));
    return range;
}

// With the ellipsoid stretched to a sphere of radius 1.
Vector3 stretched(const Globe& globe, const Vector3& v)
{
    return {v.x / globe.equatorial_radius_m, v.y / globe.equatorial_radius_m, v.z / globe.polar_radius_m};
}

// Straight lines stay straight when stretched, so it still reaches farthest at its corners.
double greatest_stretched_angle(const Globe& globe, const PlanetTile& tile, const Vector3& middle)
{
    double sine = 0.0;
    for (const double row : {0.0, static_cast<double>(kTileSquares)})
        for (const double column : {0.0, static_cast<double>(kTileSquares)})
            sine = std::max(
                sine,
                length(cross(middle, normalized(stretched(globe, sample_direction(tile, row, column))))));
    return std::asin(std::min(1.0, sine));
}

} // namespace

TileCache::TileCache(const PlanetTerrain& terrain, std::size_t most_tiles, const Execution& execution)
    : terrain_(terrain), most_tiles_(most_tiles)
{
    if (most_tiles < kLeastTiles)
        throw InvalidInput("a planet needs room for at least " + std::to_string(kLeastTiles) + " tiles, got "
                           + std::to_string(most_tiles));
    std::array<std::unique_ptr<LoadedTile>, kCubeFaces> faces;
    for_rows(faces.size(), 1, execution, [&](std::size_t first, std::size_t last) {
        for (std::size_t face = first; face < last; ++face)
            faces.at(face) = loaded({static_cast<std::uint32_t>(face), 0, 0, 0});
    });
    for (std::uint32_t face = 0; face < kCubeFaces; ++face)
        add({face, 0, 0, 0}, std::move(faces.at(face)));
}

void TileCache::begin_frame()
{
    ++frame_;
    changes_.clear();
}

const LoadedTile* TileCache::find(const PlanetTile& tile) const
{
    const auto found = tiles_.find(tile);
    return found != tiles_.end() ? found->second.get() : nullptr;
}

const LoadedTile& TileCache::use(const PlanetTile& tile)
{
    LoadedTile& found = *tiles_.at(tile);
    found.last_used = frame_;
    return found;
}

std::unique_ptr<LoadedTile> TileCache::loaded(const PlanetTile& tile) const
{
    const Globe& globe = terrain_.globe();
    auto result = std::make_unique<LoadedTile>();
    result->heights = std::make_shared<const TileHeights>(terrain_.heights_of(tile));
    HeightRange range = result->heights->range;
    if (tile.level > 0)
        range.include(range_under_child(*find(parent_of(tile))->heights, tile));
    const auto margin_m = static_cast<float>(terrain_.relief_below_m(tile.level));
    range = {range.lowest_m - margin_m, range.highest_m + margin_m};
    result->box = box_around(globe, tile, range);
    result->stretched_middle = normalized(stretched(globe, centre_direction(tile)));
    result->stretched_radius = greatest_stretched_angle(globe, tile, result->stretched_middle);
    const double least_base_m = std::min(globe.equatorial_radius_m, globe.polar_radius_m);
    result->highest = 1.0 + std::max(0.0, static_cast<double>(range.highest_m)) / least_base_m;
    result->last_used = frame_;
    return result;
}

void TileCache::add(const PlanetTile& tile, std::unique_ptr<LoadedTile> loaded)
{
    double& longest_m = longest_diagonal_m_.at(tile.level);
    longest_m = std::max(longest_m, diagonal_m(loaded->box));
    tiles_[tile] = std::move(loaded);
    changes_.push_back({tile, true});
}

// Children are never used without their parents, so of two equally old tiles the deeper one goes first.
bool TileCache::make_room(std::size_t tiles)
{
    if (tiles_.size() + tiles <= most_tiles_)
        return true;
    std::vector<std::pair<std::uint64_t, PlanetTile>> oldest;
    for (const auto& [tile, loaded] : tiles_)
        if (loaded->last_used < frame_ && tile.level > 0)
            oldest.emplace_back(loaded->last_used, tile);
    const std::size_t too_many = tiles_.size() + tiles - most_tiles_;
    if (oldest.size() < too_many)
        return false;
    // A few more, so that this is seldom done.
    const std::size_t going = std::min(oldest.size(), too_many + most_tiles_ / 16);
    const auto older = [](const auto& a, const auto& b) {
        return a.first != b.first ? a.first < b.first
                                  : std::pair(b.second.level, b.second) < std::pair(a.second.level, a.second);
    };
    std::ranges::partial_sort(oldest, oldest.begin() + static_cast<std::ptrdiff_t>(going), older);
    for (std::size_t i = 0; i < going; ++i) {
        tiles_.erase(oldest[i].second);
        changes_.push_back({oldest[i].second, false});
    }
    return true;
}

std::size_t TileCache::load_children(std::span<const PlanetTile> parents, const Execution& execution)
{
    std::vector<PlanetTile> wanted;
    for (const PlanetTile& parent : parents) {
        const auto children = children_of(parent);
        if (!make_room(wanted.size() + children.size()))
            break;
        for (const PlanetTile& child : children)
            if (find(child) == nullptr)
                wanted.push_back(child);
    }
    std::vector<std::unique_ptr<LoadedTile>> tiles(wanted.size());
    for_rows(wanted.size(), 1, execution, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            tiles[i] = loaded(wanted[i]);
    });
    for (std::size_t i = 0; i < wanted.size(); ++i)
        add(wanted[i], std::move(tiles[i]));
    return wanted.size();
}

std::size_t TileCache::bytes() const
{
    std::size_t bytes = 0;
    for (const auto& [tile, loaded] : tiles_)
        bytes += loaded->heights->bytes();
    return bytes;
}

} // namespace duskline
