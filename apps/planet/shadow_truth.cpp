#include "shadow_truth.h"

#include <duskline/execution/for_rows.h>
#include <duskline/planet/planet_ray.h>
#include <duskline/planet/planet_sight.h>

#include <algorithm>

namespace duskline::planet_app {
namespace {

constexpr std::size_t kBesideEdge = 2; // pixels

double height_at(const TileHeights& heights, const TilePlace& place)
{
    const auto first = [](double at) {
        return std::clamp(static_cast<std::int32_t>(at), 0, kTileSquares - 1);
    };
    const std::int32_t row = first(place.row);
    const std::int32_t column = first(place.column);
    const auto along = [&](std::int32_t in_row) {
        const double share = place.column - column;
        return (1.0 - share) * static_cast<double>(heights.height_m(in_row, column))
               + share * static_cast<double>(heights.height_m(in_row, column + 1));
    };
    const double share = place.row - row;
    return (1.0 - share) * along(row) + share * along(row + 1);
}

} // namespace

ShadowErrors& ShadowErrors::operator+=(const ShadowErrors& other)
{
    pixels += other.pixels;
    dark += other.dark;
    wrong += other.wrong;
    wrong_apart += other.wrong_apart;
    return *this;
}

LightOver sunlight(const Vector3& to_sun)
{
    return [to_sun](const PlanetLevel& ground) -> Reaches {
        return [rays = PlanetRays(ground, to_sun)](const Vector3& direction, double height_m) {
            return rays.is_lit(direction, height_m);
        };
    };
}

LightOver lamplight(const SceneLamp& lamp)
{
    return [at_m = lamp.position_m](const PlanetLevel& ground) -> Reaches {
        return [at_m, globe = ground.globe, sight = PlanetSight(ground)](const Vector3& direction,
                                                                         double height_m) {
            return sight.sees(point_m(globe, direction, height_m), at_m);
        };
    };
}

PictureTruth::PictureTruth(const PlanetTerrain& terrain, const LightOver& light, const Vector3& eye_m,
                           const std::vector<PlanetPatch>& patches, const ProbedPicture& probed,
                           std::size_t step, const Execution& execution)
    : terrain_(terrain), eye_m_(eye_m), probed_(probed), step_(step),
      answers_(probed.rows(), probed.columns(), Answer::unknown)
{
    for (const PlanetPatch& patch : patches) {
        drawn_.insert(patch.tile);
        const std::uint32_t level = patch.tile.level;
        if (!rays_.contains(level))
            rays_.emplace(level, light({terrain.globe(), level, terrain.heights(),
                                        [this](const PlanetTile& tile) -> const TileHeights& {
                                            return heights_of(tile);
                                        }}));
    }
    for_rows((probed.rows() + step - 1) / step, 1, execution, [&](std::size_t first, std::size_t last) {
        for (std::size_t row = first * step_; row < last * step_; row += step_)
            for (std::size_t column = 0; column < probed_.columns(); column += step_)
                if (has_ground(row, column))
                    is_lit(row, column);
    });
}

// Made outside the lock: two threads may make the same tile, and one of the two is kept.
const TileHeights& PictureTruth::heights_of(const PlanetTile& tile)
{
    {
        const std::lock_guard<std::mutex> lock(ground_mutex_);
        const auto there = ground_.find(tile);
        if (there != ground_.end())
            return *there->second;
    }
    auto made = std::make_unique<const TileHeights>(terrain_.heights_of(tile));
    const std::lock_guard<std::mutex> lock(ground_mutex_);
    return *ground_.try_emplace(tile, std::move(made)).first->second;
}

// Of the tile that is drawn in that direction. Between tiles rounding may find neither: then the coarsest serves.
std::uint32_t PictureTruth::level_drawn(const Vector3& direction) const
{
    for (auto level = rays_.rbegin(); level != rays_.rend(); ++level)
        if (drawn_.contains(place_in_tile(direction, level->first).tile))
            return level->first;
    return rays_.begin()->first;
}

bool PictureTruth::has_ground(std::size_t row, std::size_t column) const
{
    return probed_(row, column)[3] != kNoGround;
}

bool PictureTruth::is_lit(std::size_t row, std::size_t column)
{
    Answer& answer = answers_(row, column);
    if (answer == Answer::unknown)
        answer = found(row, column) ? Answer::lit : Answer::dark;
    return answer == Answer::lit;
}

bool PictureTruth::found(std::size_t row, std::size_t column)
{
    const std::array<float, 4>& pixel = probed_(row, column);
    if (pixel[3] < 0.0f) // faces away
        return false;
    const Vector3 direction =
        normalized(eye_m_
                   + Vector3{static_cast<double>(pixel[0]), static_cast<double>(pixel[1]),
                             static_cast<double>(pixel[2])});
    const std::uint32_t level = level_drawn(direction);
    const TilePlace place = place_in_tile(direction, level);
    return rays_.at(level)(direction, height_at(heights_of(place.tile), place));
}

bool PictureTruth::is_beside_edge(std::size_t row, std::size_t column)
{
    const bool lit = is_lit(row, column);
    const std::size_t last_row = std::min(row + kBesideEdge, probed_.rows() - 1);
    const std::size_t last_column = std::min(column + kBesideEdge, probed_.columns() - 1);
    for (std::size_t r = row - std::min(row, kBesideEdge); r <= last_row; ++r)
        for (std::size_t c = column - std::min(column, kBesideEdge); c <= last_column; ++c)
            if (has_ground(r, c) && is_lit(r, c) != lit)
                return true;
    return false;
}

ShadowErrors PictureTruth::errors_of(const ProbedPicture& shaded)
{
    ShadowErrors errors;
    for (std::size_t row = 0; row < probed_.rows(); row += step_)
        for (std::size_t column = 0; column < probed_.columns(); column += step_) {
            if (!has_ground(row, column))
                continue;
            ++errors.pixels;
            errors.dark += is_lit(row, column) ? 0U : 1U;
            if ((shaded(row, column)[3] >= 0.5f) == is_lit(row, column))
                continue;
            ++errors.wrong;
            errors.wrong_apart += is_beside_edge(row, column) ? 0U : 1U;
        }
    return errors;
}

} // namespace duskline::planet_app
