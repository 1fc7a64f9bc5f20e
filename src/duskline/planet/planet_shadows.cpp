// Every shadow notes what it was made from: the numbers of its tile's heights and of the shadows that light came from. It is up to
// date when those are still the ones there are, and they are up to date themselves. As light never goes in circles between
// tiles (LightRank), computing whatever is not, in the order of light, ends with the one state that the sun and the tiles
// determine.

#include <duskline/execution/for_rows.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/planet/planet_shadows.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <string>
#include <unordered_set>
#include <utility>

namespace duskline {

namespace {

// Of one object, whose light is always raised alike.
bool is_same(const LightAxis& a, const LightAxis& b)
{
    return a.to_sun.x == b.to_sun.x && a.to_sun.y == b.to_sun.y && a.to_sun.z == b.to_sun.z;
}

bool is_same(const TileShadow& a, const TileShadow& b)
{
    const auto are_same = [](const Grid<float>& x, const Grid<float>& y) {
        return std::ranges::equal(x.values(), y.values());
    };
    return a.leaving == b.leaving && are_same(a.heights_m, b.heights_m) && are_same(a.dark_m, b.dark_m);
}

// Between suns that are farther apart shadow heights are not straight.
bool are_far_apart(const LightAxis& a, const LightAxis& b)
{
    const Angle far = SunMotion::kFarthestAhead + SunMotion::kFarthestAhead;
    return dot(a.to_sun, b.to_sun) < sine_cosine(far).cosine;
}

} // namespace

// A tile to compute, with what it is made from.
struct PlanetShadows::Task {
    PlanetTile tile;
    EnteringLight entering;
    MadeFrom made_from = {};
    std::vector<PlanetTile> sources; ///< where light comes from
};

PlanetShadows::PlanetShadows(const Globe& globe, const Vector3& to_sun, Angle raised, Angle radius)
    : globe_(globe), raised_(raised), radius_(radius), shown_{light_for(to_sun), {}, {}, false},
      wanted_(shown_.light), motion_(wanted_.axis.to_sun)
{
    require_valid(globe);
}

PlanetShadows::PlanetShadows(const Globe& globe, const Vector3& to_sun, Angle raised)
    : PlanetShadows(globe, to_sun, raised, {})
{}

PlanetShadows PlanetShadows::of_disc(const Globe& globe, const Vector3& to_sun, Angle radius)
{
    if (!(radius > Angle()))
        throw InvalidInput("the sun's disc must have a radius above 0 degrees, got "
                           + std::to_string(radius.degrees()));
    return PlanetShadows(globe, to_sun, {}, radius);
}

PlanetShadows::Light PlanetShadows::light_for(const Vector3& to_sun) const
{
    if (radius_ == Angle())
        return {light_axis(to_sun, raised_), std::nullopt};
    return {light_axis(to_sun, -radius_), light_axis(to_sun, radius_)};
}

void PlanetShadows::insert(const PlanetTile& tile, std::shared_ptr<const TileHeights> heights)
{
    assert(heights != nullptr);
    tiles_[tile] = {std::move(heights), ++last_number_};
    for_generations([&](Generation& generation) {
        generation.order.emplace(light_rank(generation.light.axis, tile), tile);
    });
}

void PlanetShadows::erase(const PlanetTile& tile)
{
    if (tiles_.erase(tile) == 0)
        return;
    for_generations([&](Generation& generation) {
        generation.order.erase(light_rank(generation.light.axis, tile));
        generation.results.erase(tile);
    });
}

// Of which none is whole then.
template <typename Change>
void PlanetShadows::for_generations(const Change& change)
{
    const auto apply = [&](Generation& generation) {
        change(generation);
        generation.whole = false;
    };
    apply(shown_);
    for (std::optional<Generation>* other : {&next_, &coming_})
        if (*other)
            apply(**other);
}

void PlanetShadows::set_sun(const Vector3& to_sun)
{
    wanted_ = light_for(to_sun);
    motion_.follow(wanted_.axis.to_sun);
    ++frames_;
}

Vector3 PlanetShadows::shown_sun() const
{
    const Vector3& from = shown_.light.axis.to_sun;
    return next_ ? normalized(from + (next_->light.axis.to_sun - from) * share()) : from;
}

std::size_t PlanetShadows::update(std::size_t tiles, const Execution& execution)
{
    begin_coming(tiles);
    std::size_t done = 0;
    if (coming_ && !coming_->whole) {
        // Tiles that have just come get half, so that both the new ground and the new sun appear in the end.
        done = work_on_shown(tiles / 2, true, execution);
        done += work_on(*coming_, tiles - done, false, execution);
        if (coming_->whole)
            frames_taken_ = std::max<std::size_t>(frames_, 1);
    } else {
        done = work_on_shown(tiles, false, execution);
    }
    show_coming(tiles);
    return done;
}

void PlanetShadows::settle(const Execution& execution)
{
    const auto is_of_wanted = [&](const std::optional<Generation>& generation) {
        return generation && is_same(generation->light.axis, wanted_.axis);
    };
    if (is_same(shown_.light.axis, wanted_.axis)) {
        coming_.reset();
    } else if (!is_of_wanted(coming_)) {
        coming_.reset();
        coming_ = is_of_wanted(next_) ? std::move(next_) : begun_for(wanted_);
        next_.reset();
    }
    work_on(coming_ ? *coming_ : shown_, std::numeric_limits<std::size_t>::max(), false, execution);
    if (coming_)
        shown_ = std::move(*coming_);
    coming_.reset();
    next_.reset();
}

bool PlanetShadows::settled() const
{
    return !next_ && !coming_ && is_same(shown_.light.axis, wanted_.axis) && shown_.whole;
}

ShownShadow PlanetShadows::shown(const PlanetTile& tile) const
{
    const std::shared_ptr<const TileShadow> first = shadow_of(tile);
    if (!next_)
        return {first, nullptr, 0.0};
    const auto found = next_->results.find(tile);
    if (found == next_->results.end())
        return {first, nullptr, 0.0};
    return first ? ShownShadow{first, found->second.shadow, share()}
                 : ShownShadow{found->second.shadow, nullptr, 0.0};
}

std::shared_ptr<const TileShadow> PlanetShadows::shadow_of(const PlanetTile& tile) const
{
    const auto found = shown_.results.find(tile);
    return found == shown_.results.end() ? nullptr : found->second.shadow;
}

// Where the sun that was set is on the way from `shown_` to `next_`: at the nearest place of it.
double PlanetShadows::share() const
{
    const Vector3& from = shown_.light.axis.to_sun;
    const Vector3 way = next_->light.axis.to_sun - from;
    return std::clamp(dot(wanted_.axis.to_sun - from, way) / dot(way, way), 0.0, 1.0);
}

// How many frames the next sun will take, some few more than the last one.
std::size_t PlanetShadows::frames_a_sun(std::size_t tiles) const
{
    return 1 + (frames_taken_ > 0 ? frames_taken_ : tiles_.size() / std::max<std::size_t>(tiles, 1));
}

// It is shown when the sun is where `next_` is, in as many frames as it takes, and left behind as many frames later.
void PlanetShadows::begin_coming(std::size_t tiles)
{
    const bool stands = motion_.stands();
    if (coming_ && stands && !is_same(coming_->light.axis, wanted_.axis))
        coming_.reset();
    if (stands && is_same(shown_.light.axis, wanted_.axis))
        next_.reset();
    if (coming_)
        return;
    const Light ahead = motion_.is_steady()
                            ? light_for(motion_.ahead(2.0 * static_cast<double>(frames_a_sun(tiles))))
                            : wanted_;
    if (is_same((next_ ? *next_ : shown_).light.axis, ahead.axis))
        return;
    coming_ = begun_for(ahead);
    frames_ = 0;
}

void PlanetShadows::show_coming(std::size_t tiles)
{
    if (!coming_ || !coming_->whole)
        return;
    const bool is_on_its_way = motion_.is_steady() && next_ && share() < 1.0;
    if (is_on_its_way && frames_ < 2 * frames_a_sun(tiles))
        return;
    if (next_)
        shown_ = std::move(*next_);
    next_ = std::move(coming_);
    coming_.reset();
    if (!is_same(next_->light.axis, wanted_.axis) && !are_far_apart(shown_.light.axis, next_->light.axis))
        return;
    shown_ = std::move(*next_);
    next_.reset();
}

PlanetShadows::Generation PlanetShadows::begun_for(const Light& light) const
{
    Generation generation = {light, {}, {}, false};
    for (const auto& [tile, ground] : tiles_)
        generation.order.emplace(light_rank(light.axis, tile), tile);
    return generation;
}

std::optional<PlanetTile> PlanetShadows::nearest_ancestor(const PlanetTile& tile) const
{
    for (std::uint32_t level = tile.level; level-- > 0;)
        if (const PlanetTile ancestor = ancestor_of(tile, level); tiles_.contains(ancestor))
            return ancestor;
    return std::nullopt;
}

PlanetShadows::Task PlanetShadows::task_for(const Generation& generation, const PlanetTile& tile) const
{
    Task task = {tile, {}, {tiles_.at(tile).number}, {}};
    const auto take = [&](const PlanetTile& source, const TileShadow*& shadow, Number& number) {
        task.sources.push_back(source);
        if (const auto found = generation.results.find(source); found != generation.results.end()) {
            shadow = found->second.shadow.get();
            number = found->second.number;
        }
    };
    for (const TileEdge edge : kTileEdges) {
        const auto i = static_cast<std::size_t>(edge);
        if (!light_enters(generation.light.axis, tile, edge))
            continue;
        const PlanetTile neighbour = neighbour_of(tile, edge).tile;
        if (tiles_.contains(neighbour))
            take(neighbour, task.entering.neighbours.at(i), task.made_from.at(i + 1));
    }
    if (const std::optional<PlanetTile> ancestor = nearest_ancestor(tile)) {
        task.entering.ancestor_tile = *ancestor;
        take(*ancestor, task.entering.ancestor, task.made_from.at(5));
    }
    return task;
}

// In the order of light. `missing_only`: tiles without any shadow yet, beside neighbours that may be out of date.
std::vector<PlanetShadows::Task> PlanetShadows::ready_tasks(const Generation& generation, std::size_t most,
                                                            bool missing_only) const
{
    std::vector<Task> ready;
    std::unordered_set<PlanetTile> out_of_date;
    for (const auto& [rank, tile] : generation.order) {
        if (ready.size() >= most)
            break;
        const auto found = generation.results.find(tile);
        if (missing_only && found != generation.results.end())
            continue;
        Task task = task_for(generation, tile);
        const bool blocked =
            std::any_of(task.sources.begin(), task.sources.end(),
                        [&](const PlanetTile& source) { return out_of_date.contains(source); });
        if (!blocked && found != generation.results.end() && found->second.made_from == task.made_from)
            continue;
        out_of_date.insert(tile);
        if (!blocked)
            ready.push_back(std::move(task));
    }
    return ready;
}

void PlanetShadows::finish(Generation& generation, const Task& task, TileShadow shadow)
{
    Result& result = generation.results[task.tile];
    result.made_from = task.made_from;
    // What is the same as before need not be computed further on.
    if (result.shadow != nullptr && is_same(*result.shadow, shadow))
        return;
    result.shadow = std::make_shared<const TileShadow>(std::move(shadow));
    result.number = ++last_number_;
}

TileShadow PlanetShadows::cast(const Generation& generation, const Task& task) const
{
    const Light& light = generation.light;
    const TileHeights& heights = *tiles_.at(task.tile).heights;
    if (light.upper)
        return cast_on_tile(globe_, DiscAxes{light.axis, *light.upper}, task.tile, heights, task.entering);
    return cast_on_tile(globe_, light.axis, task.tile, heights, task.entering);
}

std::size_t PlanetShadows::work_on_shown(std::size_t most, bool missing_only, const Execution& execution)
{
    const std::size_t done = work_on(shown_, next_ ? most / 2 : most, missing_only, execution);
    return next_ ? done + work_on(*next_, most - done, missing_only, execution) : done;
}

std::size_t PlanetShadows::work_on(Generation& generation, std::size_t most, bool missing_only,
                                   const Execution& execution)
{
    std::size_t done = 0;
    const auto all = static_cast<double>(generation.order.size());
    while (done < most && !generation.whole) {
        const std::vector<Task> tasks = ready_tasks(generation, most - done, missing_only);
        if (tasks.empty())
            break;
        std::vector<TileShadow> shadows(tasks.size());
        for_rows(tasks.size(), 1, {.threads = execution.threads}, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                shadows[i] = cast(generation, tasks[i]);
        });
        for (std::size_t i = 0; i < tasks.size(); ++i)
            finish(generation, tasks[i], std::move(shadows[i]));
        done += tasks.size();
        if (execution.progress && !execution.progress(std::min(static_cast<double>(done) / all, 1.0)))
            throw Cancelled();
    }
    if (!missing_only)
        generation.whole = generation.whole || ready_tasks(generation, 1, false).empty();
    return done;
}

} // namespace duskline
