// Shadows from file to file, by a front that is carried over the terrain.
//
// The raster is cut into slabs: some hundred lines across the light, whole blocks of both files. They go, in the
// order the light meets them, through three stages that overlap:
//
//      read slab 3          cast slab 2           write slab 1
//      heights, lowered     front advances,       block by block,
//      for curvature        answers appear        compressed by GDAL
//
// The front (sweep.h, strider.h) is all that passes from one slab to the next.

#include "light_slabs.h"
#include "shadow_job.h"
#include "stopwatch.h"

#include <duskline/casting/light_frame.h>
#include <duskline/casting/strider.h>
#include <duskline/casting/sweep.h>
#include <duskline/execution/run_stages.h>
#include <duskline/raster_io/memory_need.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <type_traits>

namespace duskline::cli {
namespace {

constexpr std::size_t kSlabsInFlight = 4;

// Columns lie apart by a power of two in many rasters, which caches dislike; a little more does them good.
constexpr std::size_t kPadding = 16;

// One job; Answer is Lit or, for shadow heights, float.
template <typename Front, typename Answer>
class Stream {
public:
    explicit Stream(const ShadowJob& job)
        : job_(job), uniform_(uniform_answer(job.light)),
          frame_(uniform_ ? LightFrame{} : light_frame(job.light, job.file.ground().cell_size_m)),
          front_(lines(), cells(), frame_)
    {
        const HeightFileFacts& facts = job.file.facts();
        const bool rows = frame_.lines_are_rows;
        at_once_ = slab_lines(rows ? facts.block_rows : facts.block_columns,
                              rows ? job.writer.block_rows() : job.writer.block_columns());
        slabs_ = slabs_in_light_order(job.file, frame_, at_once_);
        if (job.curvature.coefficient != 0.0)
            curved_.emplace(job.curvature, job.file.ground().cell_size_m, job.file.columns());
    }

    ShadowOutcome run()
    {
        make_slots();
        run_stages(slabs_.size(), slots_.size(),
                   {[this](std::size_t i) { read(i); }, [this](std::size_t i) { cast(i); },
                    [this](std::size_t i) { write(i); }},
                   job_.execution);
        return outcome_;
    }

private:
    static constexpr bool kAnswersAreHeights = std::is_same_v<Answer, float>;

    // What one slab needs while it is under way.
    struct Slot {
        Grid<float> heights_m;
        Grid<Answer> answers;
        Grid<float> own_m; // heights of the file, for answers that are heights
    };

    std::size_t lines() const { return frame_.lines_are_rows ? job_.file.rows() : job_.file.columns(); }
    std::size_t cells() const { return frame_.lines_are_rows ? job_.file.columns() : job_.file.rows(); }

    void make_slots()
    {
        const std::size_t count = std::min(slabs_.size(), kSlabsInFlight);
        const std::size_t most_lines = std::min(at_once_, lines());
        const std::size_t rows = frame_.lines_are_rows ? most_lines : job_.file.rows();
        const std::size_t columns = frame_.lines_are_rows ? job_.file.columns() : most_lines + kPadding;
        require_memory(rows * count, columns,
                       sizeof(float) + (kAnswersAreHeights ? 2.0 * sizeof(float) : 1.0),
                       "'" + job_.file.facts().path + "', a slab at a time,");
        for (std::size_t i = 0; i < count; ++i)
            slots_.push_back({Grid<float>(rows, columns), Grid<Answer>(rows, columns),
                              kAnswersAreHeights ? Grid<float>(rows, columns) : Grid<float>()});
    }

    // The part of a slot's grid that a slab fills.
    template <typename T>
    GridView<T> of_slab(Grid<T>& grid, std::size_t item) const
    {
        const std::size_t count = slabs_[item].count;
        return frame_.lines_are_rows ? grid.view().window(0, 0, count, job_.file.columns())
                                     : grid.view().window(0, 0, job_.file.rows(), count);
    }

    Slot& slot(std::size_t item) { return slots_[item % slots_.size()]; }
    std::size_t first_row(std::size_t item) const { return frame_.lines_are_rows ? slabs_[item].first : 0; }
    std::size_t first_column(std::size_t item) const
    {
        return frame_.lines_are_rows ? 0 : slabs_[item].first;
    }

    void read(std::size_t item)
    {
        const Stopwatch watch(outcome_.reading_s);
        const GridView<float> heights_m = of_slab(slot(item).heights_m, item);
        job_.file.read(first_row(item), first_column(item), heights_m);
        if constexpr (kAnswersAreHeights) {
            const GridView<float> own_m = of_slab(slot(item).own_m, item);
            for (std::size_t y = 0; y < own_m.rows(); ++y)
                std::ranges::copy(heights_m.row(y), own_m.row(y).begin());
        }
        if (curved_)
            curved_->lower(heights_m, first_row(item), first_column(item));
    }

    void cast(std::size_t item)
    {
        const Stopwatch watch(outcome_.casting_s);
        const GridView<const float> heights_m = of_slab(slot(item).heights_m, item);
        const GridView<Answer> answers = of_slab(slot(item).answers, item);
        if (uniform_)
            answer_all(heights_m, answers);
        else
            front_.advance(in_light_order(heights_m, frame_), in_light_order(answers, frame_),
                           {.threads = job_.execution.threads});
    }

    void answer_all(GridView<const float> heights_m, GridView<Answer> answers) const
    {
        const HeightField field{heights_m, job_.file.ground().cell_size_m};
        const auto copy = [&](const Grid<Answer>& uniform) {
            for (std::size_t y = 0; y < answers.rows(); ++y)
                std::ranges::copy(uniform.row(y), answers.row(y).begin());
        };
        if constexpr (!kAnswersAreHeights)
            copy(uniform_mask(field, *uniform_));
        else
            copy(uniform_shadow_heights(field, *uniform_));
    }

    void write(std::size_t item)
    {
        const Stopwatch watch(outcome_.writing_s);
        const GridView<Answer> answers = of_slab(slot(item).answers, item);
        if constexpr (!kAnswersAreHeights) {
            count_into(outcome_.count, answers);
            encode(answers, job_.codes);
        } else {
            const GridView<const float> ground_m = of_slab(slot(item).heights_m, item);
            count_into(outcome_.count, ground_m, answers);
            finish_shadow_heights(job_, of_slab(slot(item).own_m, item), ground_m, answers, first_row(item),
                                  first_column(item));
        }
        job_.writer.write(first_row(item), first_column(item), GridView<const Answer>(answers));
    }

    const ShadowJob& job_;
    std::optional<Lit> uniform_;
    LightFrame frame_;
    Front front_;
    std::size_t at_once_ = 1;
    std::vector<Slab> slabs_; // in the order of the light
    std::optional<CurvedEarth> curved_;
    std::vector<Slot> slots_;
    ShadowOutcome outcome_;
};

template <typename Front>
ShadowOutcome run_stream(const ShadowJob& job)
{
    return job.result == ShadowResult::heights ? Stream<Front, float>(job).run()
                                               : Stream<Front, Lit>(job).run();
}

// The casters that have a front to be fed line by line.
struct FedCaster {
    std::string_view name;
    ShadowOutcome (*run)(const ShadowJob&);
};

constexpr std::array kFedCasters = {FedCaster{"sweep", run_stream<SweepFront>},
                                    FedCaster{"strider", run_stream<StriderFront>}};

const FedCaster* fed_caster(const Caster& caster)
{
    const auto* const found = std::ranges::find(kFedCasters, caster.name, &FedCaster::name);
    return found == kFedCasters.end() ? nullptr : found;
}

} // namespace

bool can_stream(const Caster& caster, ShadowResult result)
{
    return fed_caster(caster) != nullptr && (result == ShadowResult::mask || result == ShadowResult::heights);
}

ShadowOutcome cast_in_stream(const ShadowJob& job)
{
    return fed_caster(job.caster)->run(job);
}

} // namespace duskline::cli
