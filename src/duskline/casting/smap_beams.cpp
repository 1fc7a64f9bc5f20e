// How a silhouette map is built.
//
// A beam is a band of light one cell wide. It crosses every line of the grid in a section one cell wide, and what it
// meets in one section can only shadow what it meets in later ones: beams have nothing to do with each other, and a
// band of them is built while it stays in the cache.
//
//      o---o---o---o   line v - 1           The five places of a section on line v: its ends a and b, its sample,
//       \   \   \                           and where the samples of the lines before and after come to lie, moved
//      o-a===o=b---o   line v               along the light. Between them all three lines are straight, and a
//         \   \   \                         silhouette is where line v is higher than both, seen along the light.
//      o---o---o---o   line v + 1
//
// NextV is then found like this, for blocks of 1, 2, 4, ... lines (binary search) or 1, 4, 16, ... (quad search):
//
//      |  A  |  B  |   blocks whose texels know their next silhouette within the block, or that it has none
//           ^   |      each texel of B that knows of none looks at the last line of A: it is a silhouette itself, or
//           '---'      knows the next one
//
// Departs from its source (smap.h) here:
//
// - The source calls a section Black when one of the five places is a silhouette. That misses those between two places
//   of which one looks towards the light and the other away from it; they are found from where the two turn.
// - The source does not say how it decides that a silhouette cannot shadow a section: here, when straight bounds over
//   the one and under the other say so at both ends.
// - Silhouettes that the next one covers are left out in a pass of their own, and not while blocks are merged.
//
// A texel that looks at a White one takes over what that left out. So a silhouette may be left out because ground between
// is higher, and binary and quad search, which look at others, may leave out different ones. What no search leaves out
// is the highest silhouette that a ray meets before it: it alone decides (smap.cpp).

#include <duskline/casting/kernels/kernels.h>
#include <duskline/casting/smap_beams.h>
#include <duskline/execution/for_rows.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace duskline {

namespace {

using kernels::kBeamsPerBand;
using kernels::SectionTap;
using kernels::SectionTaps;
using kernels::SilhouetteBand;
using kernels::SilhouetteLine;

// What a height of a section may be wrong by, as a share of the greatest: where it lies by a millionth of a cell, and
// some ten roundings. For the difference of two heights the same twice. Tilts are only rounded.
constexpr double kHeightRounding = 0x1p-17;
constexpr double kTiltRounding = 0x1p-19;

// Steeper light than this shades nothing anyone could have measured; more would overflow the tilt.
constexpr double kSteepestDrop_m = 1.0e15;

// Places this close to a sample are ground where the next one is missing, as for the ray (a millionth of a cell), and a
// little more. Sections that end so close to their third sample are moved to it.
constexpr float kBesideSample = 1.2e-6f;

// Samples that the sections of a band take from a line.
constexpr std::size_t kSamples = kBeamsPerBand + 2;

const kernels::Kernels& kernels_of(const SilhouetteMapOptions& options)
{
    return options.isa.empty() ? kernels::active_kernels() : kernels::kernels_named(options.isa);
}

// Beams [first, first + kBeamsPerBand), and the lines [first_line, last_line) on which one of them is in the grid.
struct BandPlace {
    std::int64_t first_beam;
    std::size_t first_line;
    std::size_t last_line;
};

std::vector<BandPlace> bands_of(const SilhouetteBuild& build)
{
    const auto& lines = build.lines;
    const auto columns = static_cast<std::int64_t>(build.heights.cells) + 1;
    constexpr auto width = static_cast<std::int64_t>(kBeamsPerBand);
    const auto [least, most] = std::minmax(lines.front().shift, lines.back().shift);
    std::vector<BandPlace> bands;
    for (std::int64_t beam = -1 - most; beam < columns - 1 - least; beam += width) {
        const auto inside = [&](const SilhouetteLineFacts& line) {
            const std::int64_t column = beam + line.shift + 1;
            return column < columns && column > -width;
        };
        // Shifts only ever rise or only ever fall.
        const auto first = std::ranges::find_if(lines, inside);
        const auto last = std::find_if_not(first, lines.end(), inside);
        bands.push_back({beam, static_cast<std::size_t>(first - lines.begin()),
                         static_cast<std::size_t>(last - lines.begin())});
    }
    return bands;
}

SectionTaps taps_at(float before, float own, float after)
{
    float places[kernels::kSectionPlaces] = {0.0f, 1.0f - before, 1.0f - own, 1.0f - after, 1.0f};
    std::sort(std::begin(places) + 1, std::end(places) - 1);
    const auto tap = [](float place, float part_of_line) -> SectionTap {
        const float from_first = place + part_of_line;
        return from_first < 1.0f ? SectionTap{0, from_first} : SectionTap{1, from_first - 1.0f};
    };
    SectionTaps taps;
    for (std::size_t i = 0; i < kernels::kSectionPlaces; ++i) {
        taps.before[i] = tap(places[i], before);
        taps.own[i] = tap(places[i], own);
        taps.after[i] = tap(places[i], after);
    }
    return taps;
}

// The same for all sections of a line.
std::vector<SectionTaps> taps_of(const std::vector<SilhouetteLineFacts>& lines)
{
    std::vector<SectionTaps> taps;
    taps.reserve(lines.size());
    for (std::size_t v = 0; v < lines.size(); ++v) {
        const float own = lines[v].part;
        taps.push_back(
            taps_at(v > 0 ? lines[v - 1].part : own, own, v + 1 < lines.size() ? lines[v + 1].part : own));
    }
    return taps;
}

// What a thread needs to build a band.
class BandBuilder {
public:
    BandBuilder(const SilhouetteBuild& build, const std::vector<SectionTaps>& taps)
        : build_(build), taps_(taps), kernels_(kernels_of(build.options)), samples_(3, kSamples)
    {}

    void build(const BandPlace& place, Grid<SilhouetteTexel>& texels)
    {
        place_ = place;
        make_room(place.last_line - place.first_line);
        mark();
        search();
        write(texels);
    }

private:
    void make_room(std::size_t lines)
    {
        if (lines * kBeamsPerBand > texels_.size()) {
            texels_ = Grid<std::int32_t>(lines, kBeamsPerBand);
            bounds_m_ = Grid<float>(4, lines * kBeamsPerBand);
        }
        band_ = {.first_line = place_.first_line,
                 .lines = lines,
                 .better = build_.options.better_next_v,
                 .texels = texels_.data(),
                 .highest_first = bounds_m_.row(0).data(),
                 .highest_last = bounds_m_.row(1).data(),
                 .lowest_first = bounds_m_.row(2).data(),
                 .lowest_last = bounds_m_.row(3).data()};
    }

    // Colours and bounds, line after line; the samples of three lines in turn.
    void mark()
    {
        read_samples(static_cast<std::int64_t>(place_.first_line) - 1);
        read_samples(static_cast<std::int64_t>(place_.first_line));
        for (std::size_t v = place_.first_line; v < place_.last_line; ++v) {
            read_samples(static_cast<std::int64_t>(v) + 1);
            kernels_.mark_silhouettes(line_at(v));
        }
    }

    std::span<float> samples_of(std::int64_t v) { return samples_.row(static_cast<std::size_t>(v + 3) % 3); }

    bool has_line(std::int64_t v) const
    {
        return v >= 0 && v < static_cast<std::int64_t>(build_.lines.size());
    }

    void read_samples(std::int64_t v)
    {
        const std::span<float> out = samples_of(v);
        std::ranges::fill(out, std::numeric_limits<float>::quiet_NaN());
        if (!has_line(v))
            return;
        const auto line = static_cast<std::size_t>(v);
        const std::int64_t first = place_.first_beam + build_.lines[line].shift;
        const std::int64_t from = std::max<std::int64_t>(first, 0);
        const std::int64_t to = std::min<std::int64_t>(first + static_cast<std::int64_t>(kSamples),
                                                       static_cast<std::int64_t>(build_.heights.cells));
        if (from >= to)
            return;
        const float* const samples = &build_.heights.at(line, static_cast<std::size_t>(from));
        float* const inside = out.data() + (from - first);
        if (build_.heights.cell_step == 1)
            std::copy_n(samples, to - from, inside);
        else
            for (std::int64_t i = 0; i < to - from; ++i)
                inside[i] = samples[i * build_.heights.cell_step];
    }

    SilhouetteLine line_at(std::size_t v)
    {
        const auto number = static_cast<std::int64_t>(v);
        const SilhouetteLineFacts& facts = build_.lines[v];
        SilhouetteLine line;
        line.before = samples_of(number - 1).data();
        line.own = samples_of(number).data();
        line.after = samples_of(number + 1).data();
        line.taps = &taps_[v];
        line.part = facts.part;
        line.rise_m = build_.margins.rise_m;
        line.fall_m = build_.margins.fall_m;
        line.tilt_m = facts.tilt_m;
        line.rounding_m = facts.rounding_m;
        line.first_sample_counts = facts.part < kBesideSample;
        line.out = band_;
        const std::size_t values = (v - place_.first_line) * kBeamsPerBand;
        line.out.texels += values;
        for (float** bound :
             {&line.out.highest_first, &line.out.highest_last, &line.out.lowest_first, &line.out.lowest_last})
            *bound += values;
        return line;
    }

    void search()
    {
        if (build_.options.search == NextVSearch::parallel_quad)
            return kernels_.search_next_silhouettes(band_);
        const std::size_t blocks = build_.options.search == NextVSearch::binary ? 2 : 4;
        for (std::size_t distance = 1; distance < place_.last_line; distance *= blocks)
            merge_blocks(distance, blocks);
        if (band_.better)
            skip_covered();
    }

    // One pass of the binary or quad search: FindNextV of the paper for every texel. The farthest from the light first:
    // what is looked up is not yet changed.
    void merge_blocks(std::size_t distance, std::size_t blocks)
    {
        for (std::size_t v = place_.last_line; v-- > place_.first_line;)
            if (v / distance % blocks != 0)
                for (std::size_t beam = 0; beam < kBeamsPerBand; ++beam)
                    find_next(v, beam, distance, blocks);
    }

    void find_next(std::size_t v, std::size_t beam, std::size_t distance, std::size_t blocks)
    {
        std::int32_t& texel = texel_at(v - band_.first_line, beam);
        const std::size_t block = v / distance * distance;
        const std::size_t blocks_before = v / distance % blocks;
        for (std::size_t k = 0; k < blocks_before && texel >> 1 == 0; ++k) {
            if (block - k * distance <= band_.first_line)
                return;
            const std::size_t look_up = block - k * distance - 1 - band_.first_line;
            const std::int32_t found = texel_at(look_up, beam);
            std::int32_t next = (found & 1) != 0 ? static_cast<std::int32_t>(look_up) + 1 : found >> 1;
            if (band_.better)
                next = past_those_that_cannot_shadow(v - band_.first_line, next, beam);
            texel |= next << 1;
        }
    }

    std::int32_t past_those_that_cannot_shadow(std::size_t line, std::int32_t next, std::size_t beam)
    {
        while (next > 0 && cannot_shadow(static_cast<std::size_t>(next) - 1, line, beam))
            next = texel_at(static_cast<std::size_t>(next) - 1, beam) >> 1;
        return next;
    }

    // Texels read here are of lines nearer the light, and not yet changed.
    void skip_covered()
    {
        for (std::size_t line = band_.lines; line-- > 0;)
            for (std::size_t beam = 0; beam < kBeamsPerBand; ++beam) {
                std::int32_t& texel = texel_at(line, beam);
                texel = (texel & 1) | past_covered(texel >> 1, beam) << 1;
            }
    }

    std::int32_t past_covered(std::int32_t next, std::size_t beam)
    {
        while (next > 0) {
            const std::size_t line = static_cast<std::size_t>(next) - 1;
            const std::int32_t after = texel_at(line, beam) >> 1;
            if (after == 0 || !cannot_shadow(line, static_cast<std::size_t>(after) - 1, beam))
                break;
            next = after;
        }
        return next;
    }

    bool cannot_shadow(std::size_t line, std::size_t other, std::size_t beam) const
    {
        const std::size_t i = line * kBeamsPerBand + beam;
        const std::size_t k = other * kBeamsPerBand + beam;
        return band_.highest_first[i] <= band_.lowest_first[k]
               && band_.highest_last[i] <= band_.lowest_last[k];
    }

    std::int32_t& texel_at(std::size_t line, std::size_t beam)
    {
        return band_.texels[line * kBeamsPerBand + beam];
    }

    // Lines are counted from the first of the band here, and from the light there.
    void write(Grid<SilhouetteTexel>& texels)
    {
        const auto columns = static_cast<std::int64_t>(texels.columns());
        const auto before = static_cast<std::int32_t>(place_.first_line) << 1;
        for (std::size_t v = place_.first_line; v < place_.last_line; ++v) {
            const std::int64_t first = place_.first_beam + build_.lines[v].shift + 1;
            const std::int64_t from = std::max<std::int64_t>(first, 0);
            const std::int64_t to =
                std::min<std::int64_t>(first + static_cast<std::int64_t>(kBeamsPerBand), columns);
            const std::span<SilhouetteTexel> out = texels.row(v);
            for (std::int64_t x = from; x < to; ++x) {
                const std::int32_t texel =
                    texel_at(v - place_.first_line, static_cast<std::size_t>(x - first));
                out[static_cast<std::size_t>(x)].bits = texel > 1 ? texel + before : texel;
            }
        }
    }

    const SilhouetteBuild& build_;
    const std::vector<SectionTaps>& taps_;
    const kernels::Kernels& kernels_;
    BandPlace place_{};
    SilhouetteBand band_;
    Grid<float> samples_;
    Grid<std::int32_t> texels_;
    Grid<float> bounds_m_;
};

} // namespace

SilhouetteMargins silhouette_margins(double drop_m, float greatest_m)
{
    const double drop = std::min(drop_m, kSteepestDrop_m);
    const double rounding_m = 2.0 * (kHeightRounding * greatest_m + kTiltRounding * drop);
    return {static_cast<float>(rounding_m + drop), static_cast<float>(rounding_m - drop)};
}

std::vector<SilhouetteLineFacts> silhouette_lines(const LightFrame& frame, std::size_t lines,
                                                  float greatest_m)
{
    const double drop_m = std::min(frame.drop_m, kSteepestDrop_m);
    std::vector<SilhouetteLineFacts> facts(lines);
    for (std::size_t v = 0; v < lines; ++v) {
        const double moved = frame.lateral * static_cast<double>(v);
        const double whole = std::floor(moved);
        const auto part = static_cast<float>(moved - whole);
        const bool next = part > 1.0f - kBesideSample;
        const double tilt_m = drop_m * static_cast<double>(v);
        facts[v] = {.shift = static_cast<std::int32_t>(whole) + (next ? 1 : 0),
                    .part = next ? 0.0f : part,
                    .tilt_m = static_cast<float>(tilt_m),
                    .rounding_m = static_cast<float>(kHeightRounding * greatest_m + kTiltRounding * tilt_m)};
    }
    return facts;
}

Grid<SilhouetteTexel> silhouette_texels(const SilhouetteBuild& build, const Execution& execution)
{
    Grid<SilhouetteTexel> texels(build.heights.lines, build.heights.cells + 1);
    const std::vector<BandPlace> bands = bands_of(build);
    const std::vector<SectionTaps> taps = taps_of(build.lines);
    // A thread goes through some bands with the same memory.
    const std::size_t piece = std::clamp<std::size_t>(bands.size() / (8 * thread_count(execution)), 1, 8);
    for_rows(bands.size(), piece, execution, [&](std::size_t first, std::size_t last) {
        BandBuilder builder(build, taps);
        for (std::size_t i = first; i < last; ++i)
            builder.build(bands[i], texels);
    });
    return texels;
}

} // namespace duskline
