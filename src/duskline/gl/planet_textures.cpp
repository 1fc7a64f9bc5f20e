#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/planet_textures.h>

#include <algorithm>
#include <cassert>
#include <string>

namespace duskline::gl {

namespace {

constexpr std::size_t kCorners = kTileSquares + 1;

} // namespace

PlanetTextures::PlanetTextures(HeightsOf heights_of, std::size_t layers)
    : heights_of_(std::move(heights_of)), heights_(TextureFormat::r32f, kTileStored, kTileStored, layers),
      measured_(TextureFormat::r8, kTileStored, kTileStored, layers),
      shadow_heights_(TextureFormat::r32f, kCorners, kCorners, layers)
{}

void PlanetTextures::make_room(std::size_t tiles)
{
    if (tiles <= heights_.layers())
        return;
    if (tiles > most_layers())
        throw InvalidInput("a picture needs " + std::to_string(tiles)
                           + " tiles of the planet, this machine holds " + std::to_string(most_layers())
                           + ": allow a larger pixel error");
    const std::size_t layers = std::min(most_layers(), tiles + tiles / 2);
    *this = PlanetTextures(std::move(heights_of_), layers);
}

std::int32_t PlanetTextures::free_layer()
{
    if (slots_.size() < heights_.layers()) {
        std::vector<bool> taken(heights_.layers(), false);
        for (const auto& [tile, slot] : slots_)
            taken[static_cast<std::size_t>(slot.layer.index)] = true;
        return static_cast<std::int32_t>(std::ranges::find(taken, false) - taken.begin());
    }
    const auto oldest =
        std::ranges::min_element(slots_, {}, [](const auto& entry) { return entry.second.last_frame; });
    assert(oldest->second.last_frame < frame_);
    const std::int32_t index = oldest->second.layer.index;
    slots_.erase(oldest);
    return index;
}

void PlanetTextures::load(const PlanetTile& tile)
{
    const TileHeights& ground = heights_of_(tile);
    Slot slot;
    slot.layer.index = free_layer();
    slot.layer.reference_m = 0.5f * (ground.range.lowest_m + ground.range.highest_m);
    slot.last_frame = frame_;
    const auto layer = static_cast<std::size_t>(slot.layer.index);
    heights_.upload(ground.heights_m.view(), layer);
    measured_.upload(ground.measured.view(), layer);
    slots_.emplace(tile, slot);
}

void PlanetTextures::hold(std::span<const PlanetTile> tiles)
{
    make_room(tiles.size());
    ++frame_;
    // Those that are there first, so that none of them is given away.
    for (const PlanetTile& tile : tiles)
        if (const auto found = slots_.find(tile); found != slots_.end())
            found->second.last_frame = frame_;
    for (const PlanetTile& tile : tiles)
        if (!slots_.contains(tile))
            load(tile);
}

void PlanetTextures::hold_shadows(std::span<const PlanetTile> tiles, const ShadowHeightsOf& shadow_heights_of)
{
    for (const PlanetTile& tile : tiles) {
        Layer& layer = slots_.at(tile).layer;
        std::shared_ptr<const Grid<float>> heights_m = shadow_heights_of(tile);
        if (heights_m == layer.shadow_heights_m)
            continue;
        if (heights_m)
            shadow_heights_.upload(heights_m->view(), static_cast<std::size_t>(layer.index));
        layer.shadow_heights_m = std::move(heights_m);
    }
}

} // namespace duskline::gl
