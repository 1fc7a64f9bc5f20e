// A sample's height: sources from coarse to fine, each laid over what is there by its weight; then the bands of detail.
//
//   bands    0  1  2  ...  first         level of the tile     deepest
//            |--- sources -----|~~~~~~~ made up ~~~~~~|- - - - - - |     a band's features span 4 samples of its level
//
// A source knows nothing below two of its cells, so there bands begin. How high they are is known for real ground only
// statistically: relief grows with the size of features like a power of it, the exponent (Hurst's) about 0.25 for hills
// kilometres wide and close to 1 (constant slopes) below. Where a band is high the next is higher: crests are rugged and
// hollows smooth (F. K. Musgrave, hybrid multifractals, in Texturing and Modeling, 1994).

#include <duskline/geometry/invalid_input.h>
#include <duskline/planet/made_up_detail.h>
#include <duskline/planet/planet_terrain.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace duskline {

namespace {

constexpr double kWideExponent = 0.25;
constexpr double kNarrowExponent = 0.92;
constexpr double kNarrowBelow_m = 2000.0;

// The height of a band at which its roughness, measured as that of a source is, is the source's.
constexpr double kHeightOverRoughness = 3.0;

// Of the next band, where a band is at 0, at least, and what the band adds.
constexpr double kUsualRuggedness = 0.6;
constexpr double kLeastRuggedness = 0.2;
constexpr double kRuggednessOfHeight = 1.2;

// Samples of a level that a band's feature spans (see DetailBand).
constexpr double kFeatureSamples = 4.0;

void require_valid(const PlanetTerrainOptions& options)
{
    if (!(options.detail >= 0.0 && std::isfinite(options.detail)))
        throw InvalidInput("made-up detail must be 0 or above, got " + std::to_string(options.detail));
    if (!(options.finest_spacing_m > 0.0))
        throw InvalidInput("the finest spacing of a planet's samples must be above 0 m, got "
                           + std::to_string(options.finest_spacing_m));
}

// How high features of a width are over those of another, wider one.
double share_of_relief(double width_m, double wider_m)
{
    const double bend_m = std::clamp(kNarrowBelow_m, width_m, wider_m);
    return std::pow(bend_m / wider_m, kWideExponent) * std::pow(width_m / bend_m, kNarrowExponent);
}

} // namespace

PlanetTerrain::PlanetTerrain(const Globe& globe, std::vector<PlanetSource> sources,
                             const PlanetTerrainOptions& options, const Execution& execution)
    : globe_(globe), options_(options)
{
    duskline::require_valid(globe);
    require_valid(options);
    deepest_level_ = level_of_spacing(globe, options.finest_spacing_m);
    for (std::size_t i = 0; i < sources.size(); ++i) {
        const auto share = [&](std::size_t n) {
            return static_cast<double>(n) / static_cast<double>(sources.size());
        };
        const Execution part = part_of(execution, share(i), share(i + 1));
        sources_.push_back(prepared(std::move(sources[i]), part));
    }
    const auto is_made_up = [&](std::uint32_t band) {
        return std::ranges::any_of(sources_, [&](const Source& source) { return source.bands[band] > 0.0; });
    };
    while (first_band_ <= deepest_level_ && !is_made_up(first_band_))
        ++first_band_;
    find_range();
}

PlanetTerrain::Source PlanetTerrain::prepared(PlanetSource source, const Execution& execution) const
{
    Source result = {
        SourceLevels(std::move(source), {options_.sea, options_.border_cells}, execution), {}, {}};
    const double known_m = 2.0 * result.levels.cell_m(globe_);
    for (std::uint32_t level = 0; level <= kDeepestTileLevel; ++level) {
        const double spacing = spacing_m(globe_, level);
        const double feature_m = kFeatureSamples * spacing;
        result.blocks.at(level) = result.levels.level_of_spacing(spacing, globe_);
        const bool made_up = feature_m <= known_m && level <= deepest_level_;
        result.bands.at(level) =
            made_up ? options_.detail * kHeightOverRoughness * share_of_relief(feature_m, known_m) : 0.0;
    }
    return result;
}

// Everything that makes a height, kept from sample to sample.
struct PlanetTerrain::Sampler {
    Sampler(const PlanetTerrain& of_terrain, std::uint32_t of_level) : terrain(of_terrain), level(of_level)
    {
        bands.reserve(level + 1);
        for (std::uint32_t band = 0; band <= level; ++band)
            bands.emplace_back(band, terrain.options_.seed);
    }

    // The sources, and by what each band of detail is to be multiplied.
    double lay_sources(const LonLat& place)
    {
        double height_m = 0.0;
        const std::uint32_t first = terrain.first_band_;
        std::fill(heights_of_bands.begin() + first, heights_of_bands.end(), 0.0);
        for (const Source& source : terrain.sources_) {
            const SourceSample sample =
                source.levels.at(place, source.blocks[level], level >= terrain.first_band_);
            if (!(sample.weight > 0.0))
                continue;
            height_m += sample.weight * (sample.height_m - height_m);
            for (std::uint32_t band = first; band <= terrain.deepest_level_; ++band)
                heights_of_bands[band] +=
                    sample.weight * (sample.roughness_m * source.bands[band] - heights_of_bands[band]);
        }
        return height_m;
    }

    // How much of its detail ground of that height may have: so little near the sea that it stays land.
    double share_of_detail(double height_m) const
    {
        if (!terrain.options_.sea)
            return 1.0;
        double all_m = 0.0;
        for (std::uint32_t band = terrain.first_band_; band <= terrain.deepest_level_; ++band)
            all_m += heights_of_bands[band];
        return all_m > 0.0 ? std::clamp(height_m / (2.0 * all_m), 0.0, 1.0) : 0.0;
    }

    float height_m(const Vector3& direction, bool& measured)
    {
        double height_m = lay_sources(lon_lat_of(terrain.globe_, direction));
        const double share = share_of_detail(height_m);
        measured = true;
        double ruggedness = 1.0;
        for (std::uint32_t band = terrain.first_band_; band <= level && share > 0.0; ++band)
            if (heights_of_bands[band] > 0.0) {
                const double rise = bands[band].at(direction);
                height_m += share * ruggedness * heights_of_bands[band] * rise;
                ruggedness = std::clamp(kUsualRuggedness + kRuggednessOfHeight * rise, kLeastRuggedness, 1.0);
                measured = false;
            }
        return static_cast<float>(terrain.options_.sea ? std::max(0.0, height_m) : height_m);
    }

    const PlanetTerrain& terrain;
    std::uint32_t level;
    std::vector<DetailBand> bands; // of all levels up to it
    std::array<double, kDeepestTileLevel + 1> heights_of_bands = {};
};

void PlanetTerrain::find_range()
{
    range_.include(0.0f);
    double detail_m = 0.0;
    for (const Source& source : sources_) {
        range_.include(source.levels.heights());
        double all = 0.0;
        for (const double band : source.bands)
            all += band;
        detail_m = std::max(detail_m, all * static_cast<double>(source.levels.greatest_roughness_m()));
    }
    const float more_m =
        kCubicOvershoot * (range_.highest_m - range_.lowest_m) + static_cast<float>(detail_m);
    range_ = {options_.sea ? 0.0f : range_.lowest_m - more_m, range_.highest_m + more_m};
}

double PlanetTerrain::relief_below_m(std::uint32_t level) const
{
    double relief_m = 0.0;
    for (const Source& source : sources_) {
        double bands = 0.0;
        for (std::uint32_t band = level + 1; band <= deepest_level_; ++band)
            bands += source.bands[band];
        relief_m =
            std::max(relief_m, static_cast<double>(source.levels.relief_below_m(source.blocks[level]))
                                   + bands * static_cast<double>(source.levels.greatest_roughness_m()));
    }
    return relief_m;
}

float PlanetTerrain::height_m(const Vector3& direction, std::uint32_t level) const
{
    bool measured = true;
    return Sampler(*this, std::min(level, deepest_level_)).height_m(direction, measured);
}

TileHeights PlanetTerrain::heights_of(const PlanetTile& tile) const
{
    TileHeights heights;
    Sampler sampler(*this, std::min(tile.level, deepest_level_));
    for (std::int32_t row = -1; row <= kTileSquares + 1; ++row)
        for (std::int32_t column = -1; column <= kTileSquares + 1; ++column) {
            bool measured = true;
            const float height_m = sampler.height_m(sample_direction(tile, row, column), measured);
            heights.heights_m(static_cast<std::size_t>(row) + 1, static_cast<std::size_t>(column) + 1) =
                height_m;
            heights.measured(static_cast<std::size_t>(row) + 1, static_cast<std::size_t>(column) + 1) =
                measured ? 1 : 0;
            if (std::clamp(row, 0, kTileSquares) == row && std::clamp(column, 0, kTileSquares) == column)
                heights.range.include(height_m);
        }
    return heights;
}

} // namespace duskline
