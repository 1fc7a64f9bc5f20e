#include <duskline/execution/for_rows.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace duskline {

namespace {

void require(bool right, const char* what, double value, const char* wanted)
{
    if (!right)
        throw InvalidInput(std::string(what) + " must be " + wanted + ", got " + std::to_string(value));
}

void require_finite(const char* what, double value)
{
    require(std::isfinite(value), what, value, "a finite number of metres");
}

void require_length(const char* what, double value)
{
    require(value > 0.0 && std::isfinite(value), what, value, "above 0 metres and finite");
}

void require_slope(Angle slope)
{
    require(slope.degrees() >= 0.0 && slope.degrees() < 90.0, "slope", slope.degrees(),
            "from 0 to below 90 degrees");
}

void require_direction(const char* what, Angle direction)
{
    require(std::isfinite(direction.degrees()), what, direction.degrees(), "a finite number of degrees");
}

// Metres east and north of the grid's centre.
struct Place {
    double x;
    double y;
};

// Distance from the first to the middle of `count` cells, in cells.
double middle(std::size_t count)
{
    return (static_cast<double>(count) - 1.0) / 2.0;
}

// The terrain whose height at a Place is `height_m(place)`.
template <typename Height>
Terrain sampled(const SampleGrid& grid, const Execution& execution, const Height& height_m)
{
    Terrain terrain{Grid<float>(grid.rows, grid.columns), grid.cell_size_m};
    require_valid(terrain);
    for_rows(grid.rows, 32, execution, [&](std::size_t first, std::size_t last) {
        for (std::size_t row = first; row < last; ++row) {
            const double y = (middle(grid.rows) - static_cast<double>(row)) * grid.cell_size_m.y;
            const auto out = terrain.heights_m.row(row);
            for (std::size_t column = 0; column < out.size(); ++column) {
                const double x = (static_cast<double>(column) - middle(grid.columns)) * grid.cell_size_m.x;
                out[column] = static_cast<float>(height_m(Place{x, y}));
            }
        }
    });
    return terrain;
}

template <typename Height>
Terrain sampled(const SampleGrid& grid, const Height& height_m)
{
    return sampled(grid, Execution{.threads = 1}, height_m);
}

double squared_distance(Place place)
{
    return place.x * place.x + place.y * place.y;
}

// How far a place lies in a compass direction.
double along(Place place, SineCosine direction)
{
    return place.x * direction.sine + place.y * direction.cosine;
}

// How far a place lies to the right of a line through the centre in that direction.
double right_of(Place place, SineCosine direction)
{
    return place.x * direction.cosine - place.y * direction.sine;
}

} // namespace

Terrain make_plane(const PlaneOptions& options)
{
    require_finite("height", options.height_m);
    require_slope(options.slope);
    require_direction("aspect", options.aspect);
    const SineCosine downhill = sine_cosine(options.aspect);
    const double fall = tangent(options.slope);
    return sampled(options.grid,
                   [&](Place place) { return options.height_m - fall * along(place, downhill); });
}

Terrain make_wall(const WallOptions& options)
{
    require_finite("ground", options.ground_m);
    require_finite("height", options.height_m);
    require_finite("offset", options.offset_m);
    require_direction("course", options.course);
    require_length("thickness", options.thickness_m);
    require(options.length_m > 0.0, "length", options.length_m, "above 0 metres");
    const SineCosine course = sine_cosine(options.course);
    return sampled(options.grid, [&](Place place) {
        const bool inside = std::abs(right_of(place, course) - options.offset_m) <= options.thickness_m / 2.0
                            && std::abs(along(place, course)) <= options.length_m / 2.0;
        return options.ground_m + (inside ? options.height_m : 0.0);
    });
}

Terrain make_step(const StepOptions& options)
{
    require_finite("ground", options.ground_m);
    require_finite("height", options.height_m);
    require_finite("offset", options.offset_m);
    require_direction("facing", options.facing);
    const SineCosine facing = sine_cosine(options.facing);
    return sampled(options.grid, [&](Place place) {
        return options.ground_m + (along(place, facing) <= options.offset_m ? options.height_m : 0.0);
    });
}

Terrain make_cone(const ConeOptions& options)
{
    require_finite("ground", options.ground_m);
    require_length("height", options.height_m);
    require_slope(options.slope);
    require(options.slope.degrees() > 0.0, "slope", options.slope.degrees(), "above 0 degrees");
    const double fall = tangent(options.slope);
    return sampled(options.grid, [&](Place place) {
        const double side_m = options.height_m - fall * std::sqrt(squared_distance(place));
        return options.ground_m + std::max(side_m, 0.0);
    });
}

Terrain make_dome(const DomeOptions& options)
{
    require_finite("ground", options.ground_m);
    require_length("radius", options.radius_m);
    return sampled(options.grid, [&](Place place) {
        const double squared_m = options.radius_m * options.radius_m - squared_distance(place);
        return options.ground_m + std::sqrt(std::max(squared_m, 0.0));
    });
}

Terrain make_pit(const PitOptions& options)
{
    require_finite("ground", options.ground_m);
    require_length("radius", options.radius_m);
    require(options.depth_m > 0.0 && options.depth_m <= options.radius_m, "depth", options.depth_m,
            "above 0 metres and at most the radius");
    const double centre_m = options.radius_m - options.depth_m; // of the sphere, above the ground
    return sampled(options.grid, [&](Place place) {
        const double squared_m = options.radius_m * options.radius_m - squared_distance(place);
        return options.ground_m + std::min(centre_m - std::sqrt(std::max(squared_m, 0.0)), 0.0);
    });
}

Terrain make_gaussian_hill(const GaussianHillOptions& options)
{
    require_finite("ground", options.ground_m);
    require_finite("height", options.height_m);
    require_length("sigma", options.sigma_m);
    const double scale = -0.5 / (options.sigma_m * options.sigma_m);
    return sampled(options.grid, [&](Place place) {
        return options.ground_m + options.height_m * std::exp(scale * squared_distance(place));
    });
}

Terrain make_valley(const ValleyOptions& options)
{
    require_finite("bottom", options.bottom_m);
    require_direction("course", options.course);
    require_slope(options.slope);
    require(options.depth_m > 0.0, "depth", options.depth_m, "above 0 metres");
    const SineCosine course = sine_cosine(options.course);
    const double rise = tangent(options.slope);
    return sampled(options.grid, [&](Place place) {
        return options.bottom_m + std::min(std::abs(right_of(place, course)) * rise, options.depth_m);
    });
}

namespace {

// 64 random bits from `key` (Steele, Lea and Flood, SplitMix, 2014).
std::uint64_t scrambled(std::uint64_t key)
{
    key += 0x9e3779b97f4a7c15U;
    key = (key ^ (key >> 30U)) * 0xbf58476d1ce4e5b9U;
    key = (key ^ (key >> 27U)) * 0x94d049bb133111ebU;
    return key ^ (key >> 31U);
}

// The random slope at a node of the noise lattice, each part in [-1, 1].
Place lattice_slope(std::int64_t column, std::int64_t row, std::uint64_t seed)
{
    const std::uint64_t bits = scrambled(seed + static_cast<std::uint64_t>(column) * 0x8cb92ba72f3d8dd7U
                                         + static_cast<std::uint64_t>(row) * 0xd6e8feb86659fd93U);
    constexpr double unit = 1.0 / 2147483648.0;
    return {static_cast<double>(bits >> 32U) * unit - 1.0,
            static_cast<double>(bits & 0xffffffffU) * unit - 1.0};
}

// Noise: smooth, 0 at every node of the lattice of whole numbers and on average, about -1 to 1.
double gradient_noise(Place place, std::uint64_t seed)
{
    const double left = std::floor(place.x);
    const double lower = std::floor(place.y);
    const double x = place.x - left;
    const double y = place.y - lower;
    const auto i = static_cast<std::int64_t>(left);
    const auto j = static_cast<std::int64_t>(lower);
    // The plane of a node (right, upper) at this place.
    const auto plane = [&](std::int64_t right, std::int64_t upper) {
        const Place slope = lattice_slope(i + right, j + upper, seed);
        return slope.x * (x - static_cast<double>(right)) + slope.y * (y - static_cast<double>(upper));
    };
    // Planes are blended by quintics, whose second derivative is 0 at the nodes.
    const double across = x * x * x * (x * (x * 6.0 - 15.0) + 10.0);
    const double up = y * y * y * (y * (y * 6.0 - 15.0) + 10.0);
    const double below = plane(0, 0) + across * (plane(1, 0) - plane(0, 0));
    const double above = plane(0, 1) + across * (plane(1, 1) - plane(0, 1));
    return below + up * (above - below);
}

// One layer of the mountains.
struct Octave {
    std::uint64_t seed;
    double share; // of the height
};

// Mountains as a share of their height, 0 or above: noise is folded where it changes sign, which makes
// ridges, and the next octave counts the more the higher the ground.
double relief(Place place, const std::vector<Octave>& octaves)
{
    double sum = 0.0;
    double weight = 1.0;
    for (const Octave& octave : octaves) {
        const double ridge = std::max(1.0 - 1.5 * std::abs(gradient_noise(place, octave.seed)), 0.0);
        const double part = ridge * ridge * weight;
        sum += octave.share * part;
        weight = std::min(2.0 * part, 1.0);
        // Half the size, turned by the 3-4-5 triangle and moved, so that no direction and no place of the
        // lattice stands out.
        place = {1.6 * place.x - 1.2 * place.y + 0.37, 1.2 * place.x + 1.6 * place.y - 0.61};
    }
    return sum;
}

} // namespace

Terrain make_mountains(const MountainsOptions& options, const Execution& execution)
{
    require_finite("lowest", options.lowest_m);
    require_finite("height", options.height_m);
    require_length("feature", options.feature_m);
    require(options.roughness >= 0.0 && options.roughness <= 1.0, "roughness", options.roughness,
            "from 0 to 1");
    const double shortest_m = 2.0 * std::min(options.grid.cell_size_m.x, options.grid.cell_size_m.y);
    std::vector<Octave> octaves;
    double total = 0.0;
    double share = 1.0;
    for (double length_m = options.feature_m; octaves.empty() || length_m >= shortest_m; length_m /= 2.0) {
        octaves.push_back({scrambled(options.seed + octaves.size()), share});
        total += share;
        share *= options.roughness;
    }
    for (Octave& octave : octaves)
        octave.share /= total;
    return sampled(options.grid, execution, [&](Place place) {
        const Place start{place.x / options.feature_m + 0.5, place.y / options.feature_m + 0.5};
        return options.lowest_m + options.height_m * relief(start, octaves);
    });
}

} // namespace duskline
