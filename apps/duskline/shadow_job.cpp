#include "shadow_job.h"

#include "height_input.h"
#include "stopwatch.h"

#include <duskline/casting/lamps.h>
#include <duskline/casting/visible_fraction.h>
#include <duskline/products/lit_fraction.h>
#include <duskline/products/shadow_classes.h>
#include <duskline/raster_io/memory_need.h>

#include <algorithm>
#include <cmath>

namespace duskline::cli {
namespace {

// A callback for a part of the work that `progress` follows.
ProgressCallback part_of(const ProgressCallback& progress, double from, double to)
{
    return [progress, from, to](double done) { return !progress || progress(from + (to - from) * done); };
}

Execution with_progress(const ShadowJob& job, double from, double to)
{
    return {.threads = job.execution.threads, .progress = part_of(job.execution.progress, from, to)};
}

Terrain lowered_terrain(const ShadowJob& job, double& seconds)
{
    const Stopwatch watch(seconds);
    return read_lowered_terrain(job.file, job.curvature, with_progress(job, 0.0, 0.2));
}

// Writes rows in bands, so that the progress moves and an interruption is heard. `finish(first_row, rows)` makes
// of a band what is written.
template <typename T, typename Finish>
void write_in_bands(const ShadowJob& job, Grid<T>& values, double& seconds, const Finish& finish)
{
    const Stopwatch watch(seconds);
    const ProgressCallback progress = part_of(job.execution.progress, 0.9, 1.0);
    const std::size_t band = std::max<std::size_t>(job.writer.block_rows(), 256);
    for (std::size_t first = 0; first < values.rows(); first += band) {
        const std::size_t rows = std::min(band, values.rows() - first);
        const GridView<T> part = values.view().window(first, 0, rows, values.columns());
        finish(first, part);
        job.writer.write(first, 0, GridView<const T>(part));
        if (!progress(static_cast<double>(first + rows) / static_cast<double>(values.rows())))
            throw Cancelled();
    }
}

ShadowMask cast_mask(const ShadowJob& job, const Terrain& terrain)
{
    const Execution execution = with_progress(job, 0.2, 0.9);
    switch (job.lamps.size()) {
    case 0:
        return job.caster.cast(terrain, job.light, execution);
    case 1:
        return cast_lamp(job.caster, terrain, job.lamps.front(), execution);
    default:
        return lit_by_any(job.caster, terrain, job.lamps, execution);
    }
}

// How many lamps light each cell; a cell that none does is in shadow.
void count_whole(const ShadowJob& job, const Terrain& terrain, ShadowOutcome& outcome)
{
    Grid<std::uint8_t> counts(terrain.heights_m.rows(), terrain.heights_m.columns());
    {
        const Stopwatch watch(outcome.casting_s);
        const auto each = count_lamps(job.caster, terrain, job.lamps, with_progress(job, 0.2, 0.9));
        for (std::size_t i = 0; i < each.size(); ++i) {
            const std::uint16_t count = each.values()[i];
            outcome.count.no_data += count == kNoLampCount ? 1U : 0U;
            outcome.count.shadow += count == 0 ? 1U : 0U;
            outcome.count.lit += count != 0 && count != kNoLampCount ? 1U : 0U;
            counts.values()[i] = static_cast<std::uint8_t>(count == kNoLampCount ? 255U : count);
        }
    }
    write_in_bands(job, counts, outcome.writing_s, [](std::size_t, GridView<std::uint8_t>) {});
}

void mask_whole(const ShadowJob& job, const Terrain& terrain, ShadowOutcome& outcome)
{
    ShadowMask mask;
    {
        const Stopwatch watch(outcome.casting_s);
        mask = cast_mask(job, terrain);
        count_into(outcome.count, mask.view());
    }
    if (job.result == ShadowResult::mask)
        return write_in_bands(job, mask, outcome.writing_s,
                              [&](std::size_t, GridView<Lit> part) { encode(part, job.codes); });
    const ShadowClasses classes = shadow_classes(terrain, mask, job.light, with_progress(job, 0.9, 0.9));
    Grid<std::uint8_t> bytes(classes.rows(), classes.columns());
    std::ranges::transform(classes.values(), bytes.values().begin(),
                           [](ShadowClass c) { return static_cast<std::uint8_t>(c); });
    write_in_bands(job, bytes, outcome.writing_s, [](std::size_t, GridView<std::uint8_t>) {});
}

void heights_whole(const ShadowJob& job, const Terrain& terrain, ShadowOutcome& outcome)
{
    ShadowField shadows;
    {
        const Stopwatch watch(outcome.casting_s);
        const Execution execution = with_progress(job, 0.2, 0.9);
        shadows = job.lamps.empty() ? job.caster.shadow_heights(terrain, job.light, execution)
                                    : shadow_heights_of_any(job.caster, terrain, job.lamps, execution);
        count_into(outcome.count, terrain.heights_m.view(), shadows.view());
    }
    // The file's own heights are read once more, band by band: keeping them would take as much memory again.
    const std::size_t band = std::max<std::size_t>(job.writer.block_rows(), 256);
    Grid<float> own_m(std::min(band, shadows.rows()), shadows.columns());
    write_in_bands(job, shadows, outcome.writing_s, [&](std::size_t first, GridView<float> shadow_m) {
        const auto own = own_m.view().window(0, 0, shadow_m.rows(), shadow_m.columns());
        job.file.read(first, 0, own);
        finish_shadow_heights(job, own, terrain.heights_m.view().window(first, 0, own.rows(), own.columns()),
                              shadow_m, first, 0);
    });
}

Grid<float> shares_of(const ShadowJob& job, const Terrain& terrain)
{
    if (job.result == ShadowResult::soft)
        return visible_fraction(terrain, job.light, job.caster, with_progress(job, 0.2, 0.9));
    const ShadowMask mask = job.caster.cast(terrain, job.light, with_progress(job, 0.2, 0.3));
    return super_sampled_lit_fraction(terrain, mask, job.light, with_progress(job, 0.3, 0.9));
}

void shares_whole(const ShadowJob& job, const Terrain& terrain, ShadowOutcome& outcome)
{
    Grid<float> shares;
    {
        const Stopwatch watch(outcome.casting_s);
        shares = shares_of(job, terrain);
        count_shares_into(outcome.count, shares.view());
    }
    write_in_bands(job, shares, outcome.writing_s, [](std::size_t, GridView<float> part) {
        for (std::size_t y = 0; y < part.rows(); ++y)
            std::ranges::replace_if(
                part.row(y), [](float share) { return std::isnan(share); }, kNoHeight);
    });
}

double bytes_of_result(ShadowResult result, std::size_t lamps)
{
    const double more = lamps > 1 ? 1.0 : 0.0; // the answers for one lamp beside those for all so far
    switch (result) {
    case ShadowResult::lamp_count:
        return sizeof(float) + 4.0;
    case ShadowResult::classes:
        return sizeof(float) + 3.0;
    case ShadowResult::heights:
        return (2.0 + more) * sizeof(float);
    case ShadowResult::soft:
        return 2.0 * sizeof(float) + 4.5; // masks for four edges of the disc, and blocks of heights
    case ShadowResult::antialias:
        return 2.0 * sizeof(float) + 1.0 + 8.0 * 2.0 / 3.0; // a mask and the pyramid of the rays
    case ShadowResult::mask:
        break;
    }
    return sizeof(float) + 1.0 + more;
}

} // namespace

double bytes_per_cell(const Caster& caster, ShadowResult result, std::size_t lamps)
{
    return bytes_of_result(result, lamps) + caster.bytes_per_cell;
}

bool is_share(ShadowResult result)
{
    return result == ShadowResult::soft || result == ShadowResult::antialias;
}

bool is_real(ShadowResult result)
{
    return result == ShadowResult::heights || is_share(result);
}

void require_memory_for_whole(const HeightFile& file, const Caster& caster, ShadowResult result,
                              std::size_t lamps)
{
    require_memory(file.rows(), file.columns(), bytes_per_cell(caster, result, lamps),
                   "'" + file.facts().path + "'");
}

ShadowOutcome cast_whole(const ShadowJob& job)
{
    ShadowOutcome outcome;
    const Terrain terrain = lowered_terrain(job, outcome.reading_s);
    if (job.result == ShadowResult::heights)
        heights_whole(job, terrain, outcome);
    else if (job.result == ShadowResult::lamp_count)
        count_whole(job, terrain, outcome);
    else if (is_share(job.result))
        shares_whole(job, terrain, outcome);
    else
        mask_whole(job, terrain, outcome);
    return outcome;
}

void finish_shadow_heights(const ShadowJob& job, GridView<const float> own_m, GridView<const float> ground_m,
                           GridView<float> shadow_m, std::size_t first_row, std::size_t first_column)
{
    EarthCurvature raised = job.curvature;
    raised.coefficient = -raised.coefficient;
    Grid<float> cast_m(shadow_m.rows(), shadow_m.columns());
    for (std::size_t y = 0; y < shadow_m.rows(); ++y)
        std::ranges::copy(shadow_m.row(y), cast_m.row(y).begin());
    if (raised.coefficient != 0.0)
        CurvedEarth(raised, job.file.ground().cell_size_m, job.file.columns())
            .lower(shadow_m, first_row, first_column);

    const HeightFileFacts& facts = job.file.facts();
    const double unit = facts.metres_per_unit * facts.z_factor;
    for (std::size_t y = 0; y < shadow_m.rows(); ++y) {
        for (std::size_t x = 0; x < shadow_m.columns(); ++x) {
            const bool lit = ground_m(y, x) >= cast_m(y, x);
            const double height_m = static_cast<double>(lit ? own_m(y, x) : shadow_m(y, x)) + facts.base_m;
            shadow_m(y, x) = std::isfinite(height_m) ? static_cast<float>(height_m / unit) : kNoHeight;
        }
    }
}

void count_into(LitCount& count, GridView<const float> ground_m, GridView<const float> shadow_m)
{
    for (std::size_t y = 0; y < ground_m.rows(); ++y) {
        const auto ground = ground_m.row(y);
        const auto shadow = shadow_m.row(y);
        for (std::size_t x = 0; x < ground.size(); ++x) {
            count.no_data += std::isnan(ground[x]) ? 1U : 0U;
            count.lit += ground[x] >= shadow[x] ? 1U : 0U;
            count.shadow += ground[x] < shadow[x] ? 1U : 0U;
        }
    }
}

} // namespace duskline::cli
