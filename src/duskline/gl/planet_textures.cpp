#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/planet_textures.h>

#include <algorithm>
#include <cassert>
#include <string>

namespace duskline::gl {

namespace {

constexpr std::size_t kCorners = kTileSquares + 1;

// Between the first height and the second a disc is seen in part.
Grid<std::array<float, 2>> both_heights_m(const TileShadow& shadow)
{
    Grid<std::array<float, 2>> both(kCorners, kCorners);
    const auto dark_m = shadow.dark_m.values();
    const auto heights_m = shadow.heights_m.values();
    for (std::size_t i = 0; i < both.size(); ++i)
        both.values()[i] = {dark_m[i], heights_m[i]};
    return both;
}

} // namespace

PlanetTextures::PlanetTextures(HeightsOf heights_of, std::size_t layers)
    : heights_of_(std::move(heights_of)), heights_(TextureFormat::r32f, kTileStored, kTileStored, layers),
      measured_(TextureFormat::r8, kTileStored, kTileStored, layers)
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

void PlanetTextures::hold_shadows(std::span<const PlanetTile> tiles, const TileShadowsOf& shadows_of,
                                  bool of_disc)
{
    if (of_disc != of_disc_) {
        of_disc_ = of_disc;
        shadows_ = {};
        for (auto& [tile, slot] : slots_)
            slot.layer.shadows = {};
    }
    for (const PlanetTile& tile : tiles)
        hold_shadow(slots_.at(tile).layer, shadows_of(tile));
}

// What is there already stays in its place: of two suns that are shown the second is soon the first.
void PlanetTextures::hold_shadow(Layer& layer, const ShownShadow& shown)
{
    const bool exchanged = (shown.first && layer.shadows[1] == shown.first)
                           || (shown.second && layer.shadows[0] == shown.second);
    const std::size_t first = exchanged ? 1 : 0;
    put_shadow(layer, first, shown.first);
    if (shown.second || !shown.first)
        put_shadow(layer, 1 - first, shown.second);
    const auto share = shown.second ? static_cast<float>(shown.share) : 0.0f;
    layer.share_of_second = exchanged ? 1.0f - share : share;
}

void PlanetTextures::put_shadow(Layer& layer, std::size_t slot,
                                const std::shared_ptr<const TileShadow>& shadow)
{
    if (layer.shadows.at(slot) == shadow)
        return;
    layer.shadows.at(slot) = shadow;
    if (!shadow)
        return;
    std::optional<TextureArray>& array = shadows_.at(slot);
    if (!array)
        array.emplace(of_disc_ ? TextureFormat::rg32f : TextureFormat::r32f, kCorners, kCorners, layers());
    const auto index = static_cast<std::size_t>(layer.index);
    if (of_disc_)
        array->upload(both_heights_m(*shadow).view(), index);
    else
        array->upload(shadow->heights_m.view(), index);
}

} // namespace duskline::gl
