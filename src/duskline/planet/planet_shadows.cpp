// Every shadow notes what it was made from: the numbers of its tile's heights and of the shadows that light came from. It is up to
// date when those are still the ones there are, and they are up to date themselves. As light never goes in circles between
// tiles (LightRank), computing whatever is not, in the order of light, ends with the one state that the sun and the tiles
// determine.

#include <duskline/execution/for_rows.h>
#include <duskline/planet/planet_shadows.h>

#include <algorithm>
#include <cassert>
#include <limits>
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
    return a.leaving.beams_log2 == b.leaving.beams_log2 && a.leaving.first == b.leaving.first
           && a.leaving.rho_m == b.leaving.rho_m
           && std::equal(a.heights_m.values().begin(), a.heights_m.values().end(),
                         b.heights_m.values().begin());
}

} // namespace

// A tile to compute, with what it is made from.
struct PlanetShadows::Task {
    PlanetTile tile;
    EnteringLight entering;
    MadeFrom made_from = {};
    std::vector<PlanetTile> sources; ///< where light comes from
};

PlanetShadows::PlanetShadows(const Globe& globe, const Vector3& to_sun, Angle raised)
    : globe_(globe), raised_(raised), shown_{light_axis(to_sun, raised), {}, {}, false}, wanted_(shown_.axis)
{
    require_valid(globe);
}

void PlanetShadows::insert(const PlanetTile& tile, std::shared_ptr<const TileHeights> heights)
{
    assert(heights != nullptr);
    tiles_[tile] = {std::move(heights), ++last_number_};
    for_generations(
        [&](Generation& generation) { generation.order.emplace(light_rank(generation.axis, tile), tile); });
}

void PlanetShadows::erase(const PlanetTile& tile)
{
    if (tiles_.erase(tile) == 0)
        return;
    for_generations([&](Generation& generation) {
        generation.order.erase(light_rank(generation.axis, tile));
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
    if (coming_)
        apply(*coming_);
}

void PlanetShadows::set_sun(const Vector3& to_sun)
{
    wanted_ = light_axis(to_sun, raised_);
}

std::size_t PlanetShadows::update(std::size_t tiles, const Execution& execution)
{
    begin_wanted();
    if (!coming_)
        return work_on(shown_, tiles, false, execution);
    // Tiles that have just come get half, so that both the new ground and the new sun appear in the end.
    const std::size_t done = work_on(shown_, tiles / 2, true, execution);
    const std::size_t coming = work_on(*coming_, tiles - done, false, execution);
    if (coming_->whole)
        show_coming();
    return done + coming;
}

void PlanetShadows::settle(const Execution& execution)
{
    if (coming_ && !is_same(coming_->axis, wanted_))
        coming_.reset();
    begin_wanted();
    work_on(coming_ ? *coming_ : shown_, std::numeric_limits<std::size_t>::max(), false, execution);
    if (coming_)
        show_coming();
}

bool PlanetShadows::settled() const
{
    return !coming_ && is_same(shown_.axis, wanted_) && shown_.whole;
}

std::shared_ptr<const TileShadow> PlanetShadows::shadow_of(const PlanetTile& tile) const
{
    const auto found = shown_.results.find(tile);
    return found == shown_.results.end() ? nullptr : found->second.shadow;
}

void PlanetShadows::begin_wanted()
{
    if (!coming_ && !is_same(shown_.axis, wanted_))
        coming_ = begun_for(wanted_);
}

void PlanetShadows::show_coming()
{
    shown_ = std::move(*coming_);
    coming_.reset();
}

PlanetShadows::Generation PlanetShadows::begun_for(const LightAxis& axis) const
{
    Generation generation = {axis, {}, {}, false};
    for (const auto& [tile, ground] : tiles_)
        generation.order.emplace(light_rank(axis, tile), tile);
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
        if (!light_enters(generation.axis, tile, edge))
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
                shadows[i] = cast_on_tile(globe_, generation.axis, tasks[i].tile,
                                          *tiles_.at(tasks[i].tile).heights, tasks[i].entering);
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
