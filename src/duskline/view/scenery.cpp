#include <duskline/terrain/ground_height.h>
#include <duskline/terrain/normals.h>
#include <duskline/view/scenery.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>

namespace duskline {

namespace {

constexpr std::size_t kGrovesASide = 16;
constexpr std::size_t kTreesAGrove = 24;
constexpr std::size_t kTowersASide = 5;
constexpr int kTowerSites = 8; // looked at, of which the lowest is taken

const double kSteepestRise = tangent(Angle::from_degrees(35.0));
constexpr double kTreeLine = 0.55; // of the relief

// Numbers that are the same with every standard library.
class Dice {
public:
    /// At least `low`, below `high`.
    double between(double low, double high)
    {
        constexpr double unit = 1.0 / 9007199254740992.0; // 2^-53
        return low + (high - low) * static_cast<double>(bits_() >> 11U) * unit;
    }

private:
    std::mt19937_64 bits_{2008};
};

struct Sizes {
    double side_m;   ///< the shorter one
    double relief_m; ///< or what stands for it where the ground is level
    double lowest_m;
    double tower_m;
    double tree_m;
};

Sizes sizes_of(const HeightField& field)
{
    const HeightRange range = height_range(field);
    const bool has_data = range.lowest_m <= range.highest_m;
    Sizes sizes{};
    sizes.side_m = std::min(static_cast<double>(field.rows()) * field.cell_size_m.y,
                            static_cast<double>(field.columns()) * field.cell_size_m.x);
    sizes.lowest_m = has_data ? static_cast<double>(range.lowest_m) : 0.0;
    const double relief_m = has_data ? static_cast<double>(range.highest_m) - sizes.lowest_m : 0.0;
    sizes.relief_m = std::max(relief_m, 0.02 * sizes.side_m);
    sizes.tower_m = std::min(0.5 * sizes.relief_m, 0.06 * sizes.side_m);
    sizes.tree_m = 0.2 * sizes.tower_m;
    return sizes;
}

struct Site {
    std::uint32_t row;
    std::uint32_t column;
    double height_m;
};

// The cell at a place, if something may stand there.
std::optional<Site> site_at(const HeightField& field, double row, double column)
{
    const auto clamped = [](double at, std::size_t count) {
        return static_cast<std::uint32_t>(std::clamp(std::round(at), 0.0, static_cast<double>(count - 1)));
    };
    const Site site{clamped(row, field.rows()), clamped(column, field.columns()), 0.0};
    const Slope slope = slope_at(field, site.row, site.column);
    const double rise = std::hypot(slope.dz_dx, slope.dz_dy);
    if (!(rise > 0.0 && rise <= kSteepestRise)) // no data neither
        return std::nullopt;
    return Site{site.row, site.column, static_cast<double>(field.heights_m(site.row, site.column))};
}

StandingObject standing_at(const Site& site, double height_m, double width_m, Dice& dice)
{
    return {site.row, site.column, height_m, width_m, Angle::from_degrees(dice.between(0.0, 360.0))};
}

// Squares of equal size, in cells, and what is put into each.
template <typename Put>
void for_each_square(const HeightField& field, std::size_t a_side, const Put& put)
{
    const double rows = static_cast<double>(field.rows()) / static_cast<double>(a_side);
    const double columns = static_cast<double>(field.columns()) / static_cast<double>(a_side);
    for (std::size_t y = 0; y < a_side; ++y)
        for (std::size_t x = 0; x < a_side; ++x)
            put((static_cast<double>(y) + 0.5) * rows, (static_cast<double>(x) + 0.5) * columns, rows,
                columns);
}

std::vector<StandingObject> groves(const HeightField& field, const Sizes& sizes, Dice& dice)
{
    std::vector<StandingObject> trees;
    for_each_square(field, kGrovesASide, [&](double row, double column, double rows, double columns) {
        row += dice.between(-0.4, 0.4) * rows;
        column += dice.between(-0.4, 0.4) * columns;
        for (std::size_t i = 0; i < kTreesAGrove; ++i) {
            const double away = 0.4 * std::sqrt(dice.between(0.0, 1.0));
            const double around = dice.between(0.0, 2.0 * std::numbers::pi);
            const double height_m = sizes.tree_m * dice.between(0.6, 1.2);
            const auto site = site_at(field, row + away * std::sin(around) * rows,
                                      column + away * std::cos(around) * columns);
            if (site && site->height_m <= sizes.lowest_m + kTreeLine * sizes.relief_m)
                trees.push_back(standing_at(*site, height_m, 0.45 * height_m, dice));
        }
    });
    return trees;
}

std::vector<StandingObject> towers_on_low_ground(const HeightField& field, const Sizes& sizes, Dice& dice)
{
    std::vector<StandingObject> towers;
    for_each_square(field, kTowersASide, [&](double row, double column, double rows, double columns) {
        std::optional<Site> lowest;
        for (int i = 0; i < kTowerSites; ++i) {
            const double down = dice.between(-0.4, 0.4);
            const double right = dice.between(-0.4, 0.4);
            const auto site = site_at(field, row + down * rows, column + right * columns);
            if (site && (!lowest || site->height_m < lowest->height_m))
                lowest = site;
        }
        if (lowest)
            towers.push_back(standing_at(*lowest, sizes.tower_m, 0.2 * sizes.tower_m, dice));
    });
    return towers;
}

CirclingAircraft circling_above(const HeightField& field, const Sizes& sizes)
{
    CirclingAircraft aircraft;
    aircraft.middle.row = (static_cast<double>(field.rows()) - 1.0) / 2.0;
    aircraft.middle.column = (static_cast<double>(field.columns()) - 1.0) / 2.0;
    aircraft.radius_m = 0.3 * sizes.side_m;
    aircraft.span_m = 1.5 * sizes.tower_m;
    double highest_m = sizes.lowest_m;
    for (int i = 0; i < 256; ++i) {
        const GridPoint at = place_of(aircraft, field.cell_size_m, aircraft.period_s * i / 256.0);
        highest_m = std::max(highest_m, ground_height_m(field, at.row, at.column).value_or(highest_m));
    }
    aircraft.middle.height_m = highest_m + 0.15 * sizes.relief_m;
    return aircraft;
}

double around_the_circle(const CirclingAircraft& aircraft, double seconds)
{
    return 2.0 * std::numbers::pi * (seconds / aircraft.period_s);
}

} // namespace

Scenery usual_scenery(const HeightField& field)
{
    require_valid(field);
    if (field.heights_m.empty())
        return {};
    const Sizes sizes = sizes_of(field);
    Dice dice;
    Scenery scenery;
    scenery.trees = groves(field, sizes, dice);
    scenery.towers = towers_on_low_ground(field, sizes, dice);
    scenery.aircraft = circling_above(field, sizes);
    scenery.clouds = CloudLayer{.height_m = sizes.lowest_m + 0.5 * sizes.relief_m,
                                .feature_m = 0.12 * sizes.side_m,
                                .drift_m_per_s = 0.004 * sizes.side_m};
    return scenery;
}

GridPoint place_of(const CirclingAircraft& aircraft, CellSize cell_size_m, double seconds)
{
    const double around = around_the_circle(aircraft, seconds);
    return {aircraft.middle.row - aircraft.radius_m * std::sin(around) / cell_size_m.y,
            aircraft.middle.column + aircraft.radius_m * std::cos(around) / cell_size_m.x,
            aircraft.middle.height_m};
}

Angle heading_of(const CirclingAircraft& aircraft, double seconds)
{
    return wrapped_to_circle(Angle::from_radians(-around_the_circle(aircraft, seconds)));
}

HeightRange height_range(const Scenery& scenery, HeightRange ground)
{
    HeightRange range = ground;
    for (const auto* standing : {&scenery.trees, &scenery.towers})
        for (const StandingObject& object : *standing)
            range.include(ground.highest_m + static_cast<float>(object.height_m));
    if (scenery.aircraft)
        range.include(static_cast<float>(scenery.aircraft->middle.height_m + scenery.aircraft->span_m));
    if (scenery.clouds)
        range.include(static_cast<float>(scenery.clouds->height_m));
    return range;
}

} // namespace duskline
