// F. Strugar, Continuous distance-dependent level of detail for rendering heightmaps, Journal of Graphics, GPU, and Game
// Tools 14, 2009, on a cube of six quadtrees. Departures: ends of levels follow from bounds on the boxes, so that cracks
// cannot be; tiles that are missing shorten levels instead of being replaced one by one; and the globe hides what is
// beyond its horizon (stretched to a sphere of radius 1, where the test is one of angles):
//
//                    * top of the tile at radius t      hidden if the angle between eye and tile exceeds
//         eye      /                                        acos(r / |eye|) + acos(r / t)
//          *     /                                      r: the lowest ground
//            \ /___ touches the lowest ground

#include <duskline/geometry/invalid_input.h>
#include <duskline/planet/planet_quadtree.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>

namespace duskline {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A level begins to turn no sooner than at this share of its end, and takes at least an eighth of its way for it.
constexpr double kMorphBegins = 0.7;
constexpr double kLeastGrowth = 1.15;

// Squares of meshes with fewer corners, in the picture.
constexpr double kSkippingPixels = 2.0;

// Of a tile's box over its side, before any is loaded.
constexpr double kUsualDiagonal = 1.5;

bool may_touch(const OrientedBox& a, const OrientedBox& b)
{
    const Vector3 apart = b.centre_m - a.centre_m;
    const auto overlap_along = [&](const Vector3& axis) {
        return std::abs(dot(apart, axis)) <= reach_m(a, axis) + reach_m(b, axis);
    };
    return std::ranges::all_of(a.axes, overlap_along) && std::ranges::all_of(b.axes, overlap_along);
}

double acos_of(double cosine)
{
    return std::acos(std::clamp(cosine, -1.0, 1.0));
}

// The globe as something to hide behind.
class Horizon {
public:
    Horizon(const PlanetTerrain& terrain, const Vector3& eye_m)
    {
        const Globe& globe = terrain.globe();
        const double lowest_m = std::min(0.0, static_cast<double>(terrain.heights().lowest_m));
        lowest_ = 1.0 + lowest_m / std::min(globe.equatorial_radius_m, globe.polar_radius_m);
        const Vector3 eye = {eye_m.x / globe.equatorial_radius_m, eye_m.y / globe.equatorial_radius_m,
                             eye_m.z / globe.polar_radius_m};
        towards_eye_ = normalized(eye);
        below_all_ = !(length(eye) > lowest_);
        from_eye_ = below_all_ ? 0.0 : acos_of(lowest_ / length(eye));
    }

    bool hides(const LoadedTile& tile) const
    {
        if (below_all_)
            return false;
        const double angle = acos_of(dot(towards_eye_, tile.stretched_middle)) - tile.stretched_radius;
        return angle > from_eye_ + acos_of(lowest_ / tile.highest);
    }

private:
    double lowest_;
    Vector3 towards_eye_;
    bool below_all_;
    double from_eye_;
};

} // namespace

// One frame's.
struct PlanetQuadtree::View {
    Vector3 eye_m;
    PlanetFrustum frustum;
    Horizon horizon;
    std::vector<double> ends_m;
    bool whole_circle = false; // what is out of view counts, too
    std::vector<Request> requests = {};
    std::vector<double> missing_from_m = {}; // of each level: the nearest tile that is not there

    bool may_see(const LoadedTile& tile) const
    {
        return !horizon.hides(tile) && (whole_circle || frustum.may_see(tile.box));
    }
};

PlanetQuadtree::PlanetQuadtree(const PlanetTerrain& terrain, const PlanetQuadtreeOptions& options,
                               const Execution& execution)
    : terrain_(terrain), options_(options), cache_(terrain, options.most_tiles, execution)
{
    if (!(options.square_pixels > 0.0 && std::isfinite(options.square_pixels)))
        throw InvalidInput("squares of a planet's mesh must be larger than 0 pixels, got "
                           + std::to_string(options.square_pixels));
    ranges_.assign(terrain.deepest_level() + 1, {});
}

const TileHeights& PlanetQuadtree::heights_of(const PlanetTile& tile) const
{
    const LoadedTile* loaded = cache_.find(tile);
    assert(loaded != nullptr);
    return *loaded->heights;
}

std::shared_ptr<const TileHeights> PlanetQuadtree::shared_heights_of(const PlanetTile& tile) const
{
    const LoadedTile* loaded = cache_.find(tile);
    assert(loaded != nullptr);
    return loaded->heights;
}

double PlanetQuadtree::diagonal_m(std::uint32_t level) const
{
    return std::max(cache_.longest_diagonal_m(level),
                    kUsualDiagonal * kTileSquares * spacing_m(terrain_.globe(), level));
}

// By what is to be seen of the squares of the next coarser level; and so that a level's tiles do not begin to turn where
// they may meet finer ones.
std::vector<double> PlanetQuadtree::wanted_ends_m(double pixels_per_radian) const
{
    const std::uint32_t deepest = terrain_.deepest_level();
    std::vector<double> ends_m(deepest + 1, kInfinity);
    double finer_m = 0.0;
    for (std::uint32_t level = deepest; level > 0; --level) {
        const double wanted_m =
            spacing_m(terrain_.globe(), level - 1) * pixels_per_radian / options_.square_pixels;
        const double meets_finer_m = level < deepest ? finer_m + diagonal_m(level) : 0.0;
        finer_m = ends_m[level] = std::max(wanted_m, kLeastGrowth * meets_finer_m);
    }
    return ends_m;
}

void PlanetQuadtree::pull_in(const std::vector<double>& missing_from_m, std::vector<double>& ends_m) const
{
    for (std::uint32_t level = 1; level < ends_m.size(); ++level) {
        ends_m[level] = std::min(ends_m[level], missing_from_m[level]);
        if (level > 1)
            ends_m[level] = std::min(ends_m[level], ends_m[level - 1] / kLeastGrowth - diagonal_m(level - 1));
        ends_m[level] = std::max(ends_m[level], 0.0);
    }
}

bool PlanetQuadtree::has_children(const PlanetTile& tile) const
{
    return std::ranges::all_of(children_of(tile),
                               [&](const PlanetTile& child) { return cache_.find(child) != nullptr; });
}

void PlanetQuadtree::find_missing(const PlanetTile& tile, View& view)
{
    const LoadedTile& loaded = cache_.use(tile);
    if (!view.may_see(loaded) || tile.level == terrain_.deepest_level())
        return;
    const double distance = distance_m(view.eye_m, loaded.box);
    if (!(distance < view.ends_m[tile.level + 1]))
        return;
    if (!has_children(tile)) {
        view.requests.push_back({tile, distance});
        view.missing_from_m[tile.level + 1] = std::min(view.missing_from_m[tile.level + 1], distance);
        return;
    }
    for (const PlanetTile& child : children_of(tile))
        find_missing(child, view);
}

// Until nothing is missing, or no more may be loaded, or fits. How many tiles have been.
std::size_t PlanetQuadtree::load(View& view, std::size_t most_loads, const Execution& execution)
{
    std::size_t loads = 0;
    for (;;) {
        view.requests.clear();
        view.missing_from_m.assign(view.ends_m.size(), kInfinity);
        for (std::uint32_t face = 0; face < kCubeFaces; ++face)
            find_missing({face, 0, 0, 0}, view);
        if (view.requests.empty() || loads >= most_loads)
            return loads;
        std::ranges::sort(view.requests, {}, [](const Request& request) {
            return std::tuple(request.parent.level, request.distance_m, request.parent);
        });
        std::vector<PlanetTile> parents;
        for (const Request& request : view.requests)
            if (loads + 4 * parents.size() < most_loads)
                parents.push_back(request.parent);
        const std::size_t loaded = cache_.load_children(parents, execution);
        if (loaded == 0)
            return loads;
        loads += loaded;
    }
}

void PlanetQuadtree::set_ranges(const std::vector<double>& ends_m)
{
    ranges_.assign(ends_m.size(), {kInfinity, kInfinity});
    for (std::uint32_t level = 1; level < ends_m.size(); ++level) {
        const double finer_m = level + 1 < ends_m.size() ? ends_m[level + 1] : 0.0;
        const double meets_finer_m = finer_m > 0.0 ? finer_m + diagonal_m(level) : 0.0;
        ranges_[level] = {std::max(meets_finer_m, kMorphBegins * ends_m[level]), ends_m[level]};
    }
}

bool PlanetQuadtree::is_split(const PlanetTile& tile, double distance_m) const
{
    return tile.level < terrain_.deepest_level() && distance_m < ranges_[tile.level + 1].end_m;
}

void PlanetQuadtree::select(const PlanetTile& tile, const View& view)
{
    const LoadedTile& loaded = *cache_.find(tile);
    if (!view.may_see(loaded))
        return;
    if (!is_split(tile, distance_m(view.eye_m, loaded.box))) {
        patches_.push_back(patch_of(tile, distance_m(view.eye_m, loaded.box), 0.0));
        return;
    }
    for (const PlanetTile& child : children_of(tile))
        select(child, view);
}

PlanetPatch PlanetQuadtree::patch_of(const PlanetTile& tile, double distance_m, double coarsest_m) const
{
    const double square_m = spacing_m(terrain_.globe(), tile.level);
    const double enough_m = std::max(coarsest_m, drawn_radians_ * distance_m);
    std::uint32_t step = 1;
    while (step < kLargestPatchStep && 2.0 * step * square_m <= enough_m)
        step *= 2;
    return {tile, ranges_[tile.level], step};
}

void PlanetQuadtree::update(const PlanetCamera& camera, std::size_t width, std::size_t height,
                            std::size_t most_loads, const Execution& execution)
{
    if (width == 0 || height == 0)
        throw InvalidInput("a picture of a planet needs at least one pixel, got " + std::to_string(width)
                           + " x " + std::to_string(height));
    const double aspect = static_cast<double>(width) / static_cast<double>(height);
    const double per_radian =
        pixels_per_radian({{}, {}, {}, camera.vertical_view}, static_cast<double>(height));
    eye_m_ = camera.eye_m;
    drawn_radians_ = std::min(options_.square_pixels, kSkippingPixels) / per_radian;
    View view = {camera.eye_m, PlanetFrustum(terrain_.globe(), camera, aspect),
                 Horizon(terrain_, camera.eye_m), wanted_ends_m(per_radian)};
    if (updated_) // the first frame has begun with the tiles of level 0
        cache_.begin_frame();
    updated_ = true;
    const std::size_t loads = load(view, most_loads, execution);
    // Missing although more might have been loaded: what there is room for is there.
    settled_ = view.requests.empty() || loads < most_loads;
    pull_in(view.missing_from_m, view.ends_m);
    set_ranges(view.ends_m);
    patches_.clear();
    for (std::uint32_t face = 0; face < kCubeFaces; ++face)
        select({face, 0, 0, 0}, view);
    if (options_.look_around && settled_ && loads < most_loads) {
        view.whole_circle = true;
        load(view, most_loads - loads, execution);
    }
}

void PlanetQuadtree::add_casters(const PlanetTile& tile, const OrientedBox& light_box, double coarsest_m,
                                 std::vector<PlanetPatch>& casters) const
{
    const LoadedTile& loaded = *cache_.find(tile);
    if (!may_touch(loaded.box, light_box))
        return;
    const double distance = distance_m(eye_m_, loaded.box);
    if (!is_split(tile, distance) || !has_children(tile)) {
        casters.push_back(patch_of(tile, distance, coarsest_m));
        return;
    }
    for (const PlanetTile& child : children_of(tile))
        add_casters(child, light_box, coarsest_m, casters);
}

std::vector<PlanetPatch> PlanetQuadtree::casters(const OrientedBox& light_box, double coarsest_m) const
{
    std::vector<PlanetPatch> casters;
    for (std::uint32_t face = 0; face < kCubeFaces; ++face)
        add_casters({face, 0, 0, 0}, light_box, coarsest_m, casters);
    return casters;
}

} // namespace duskline
