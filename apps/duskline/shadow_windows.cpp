// The shadows of a raster that does not fit in memory, by any caster: window by window, in the order the light meets
// them, each with as much of the ground before it as can throw a shadow into it.
//
//      light ->   | done | ground before it | window | to come |
//                        '-------- cast ------------'
//                                           '-written'
//
// What can: the shadow of a slab's highest ground falls with the light, and no longer matters where it is under the
// lowest ground of the window. So every ray finds all it could have met, and the answers are those of the whole.
// Ground is compared in pieces of some hundred cells, with those that light comes over: on a round earth the sides
// of a large raster lie kilometres lower than its middle.
//
// A first pass over the file notes the lowest and highest ground of each piece of each slab. Memory: a window with the ground
// before it, heights and answers.

#include "light_slabs.h"
#include "shadow_job.h"
#include "stopwatch.h"

#include <duskline/casting/light_frame.h>
#include <duskline/products/shadow_classes.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace duskline::cli {
namespace {

// Shares of the progress.
constexpr double kSurveyed = 0.2;

// Heights are floats, and so are rounded when they are lowered for curvature.
constexpr double kRounding_m = 0.01;

// One slab more than the answers say, for what casters keep beside them.
constexpr double kBesides = 1.25;

constexpr std::size_t kCellsInPiece = 512;

struct Extremes {
    float lowest_m = std::numeric_limits<float>::infinity();
    float highest_m = -std::numeric_limits<float>::infinity();

    void note(float height_m)
    {
        if (height_m < lowest_m)
            lowest_m = height_m;
        if (height_m > highest_m)
            highest_m = height_m;
    }
};

struct SurveyedSlab {
    Slab slab;
    std::size_t first_line = 0;   // from the light
    std::vector<Extremes> pieces; // along its lines

    std::size_t end_line() const { return first_line + slab.count; }
};

// Slabs [first, last) are written, and cast with the lines before them from one on.
struct Window {
    std::size_t first_needed_line = 0;
    std::size_t first = 0;
    std::size_t last = 0;
};

[[noreturn]] void refuse_lines(const HeightFile& file, bool lines_are_rows, std::size_t lines,
                               double needed_bytes, double memory_bytes)
{
    constexpr double gibibyte = 1024.0 * 1024.0 * 1024.0;
    throw UnsupportedOnThisMachine(fmt::format(
        "'{}' ({} rows x {} columns) needs {} {} in memory at a time, with those that shade them, {:.3g} "
        "GiB; {:.3g} "
        "GiB may be used; take --caster sweep, which needs a few hundred whatever the shadows, or a part "
        "(gdal_translate -srcwin)",
        file.facts().path, file.rows(), file.columns(), lines, lines_are_rows ? "rows" : "columns",
        needed_bytes / gibibyte, memory_bytes / gibibyte));
}

class WindowedCast {
public:
    explicit WindowedCast(const ShadowJob& job)
        : job_(job),
          frame_(uniform_answer(job.light) ? LightFrame{}
                                           : light_frame(job.light, job.file.ground().cell_size_m)),
          lines_(frame_.lines_are_rows ? job.file.rows() : job.file.columns()),
          cells_(frame_.lines_are_rows ? job.file.columns() : job.file.rows())
    {
        if (job.curvature.coefficient != 0.0)
            curved_.emplace(job.curvature, job.file.ground().cell_size_m, job.file.columns());
        const double a_line =
            static_cast<double>(cells_) * bytes_per_cell(job.caster, job.result, 0) * kBesides;
        most_lines_ = static_cast<double>(job.memory_bytes) / a_line;
    }

    ShadowOutcome run()
    {
        const std::size_t output_block =
            frame_.lines_are_rows ? job_.writer.block_rows() : job_.writer.block_columns();
        std::size_t line = 0;
        for (const Slab& slab : slabs_in_light_order(job_.file, frame_, slab_lines(1, output_block))) {
            slabs_.push_back({slab, line, std::vector<Extremes>(pieces())});
            line += slab.count;
        }
        survey();
        const std::vector<Window> windows = cut_into_windows();
        for (const Window& window : windows)
            cast(window);
        return outcome_;
    }

private:
    [[noreturn]] void refuse(std::size_t lines) const
    {
        const auto memory_bytes = static_cast<double>(job_.memory_bytes);
        refuse_lines(job_.file, frame_.lines_are_rows, lines,
                     static_cast<double>(lines) / most_lines_ * memory_bytes, memory_bytes);
    }

    // The part of the grid between two lines from the light.
    struct Part {
        std::size_t first_row;
        std::size_t first_column;
        std::size_t rows;
        std::size_t columns;
    };
    Part part_of_lines(std::size_t first_line, std::size_t end_line) const
    {
        const std::size_t first = frame_.first_line_is_index_0 ? first_line : lines_ - end_line;
        const std::size_t count = end_line - first_line;
        return frame_.lines_are_rows ? Part{first, 0, count, cells_} : Part{0, first, cells_, count};
    }

    // A window of a grid that holds `whole`.
    template <typename T>
    static GridView<T> view_of(Grid<T>& grid, const Part& whole, const Part& part)
    {
        return grid.view().window(part.first_row - whole.first_row, part.first_column - whole.first_column,
                                  part.rows, part.columns);
    }

    // Reads a part in bands of rows, whole blocks of the file, and calls `with(first_row, band)` for each.
    template <typename With>
    void read_in_bands(const Part& part, const With& with)
    {
        const std::size_t block = job_.file.facts().block_rows;
        const std::size_t at_once = (kLeastLines + block - 1) / block * block;
        for (std::size_t row = part.first_row; row < part.first_row + part.rows;) {
            const std::size_t end = std::min(row / at_once * at_once + at_once, part.first_row + part.rows);
            with(row, end - row);
            row = end;
        }
    }

    void read(std::size_t first_row, std::size_t first_column, GridView<float> heights_m)
    {
        const Stopwatch watch(outcome_.reading_s);
        job_.file.read(first_row, first_column, heights_m);
        if (curved_)
            curved_->lower(heights_m, first_row, first_column);
    }

    void go_on(double done) const
    {
        if (job_.execution.progress && !job_.execution.progress(done))
            throw Cancelled();
    }

    double share_of(std::size_t line) const
    {
        return kSurveyed + (1.0 - kSurveyed) * static_cast<double>(line) / static_cast<double>(lines_);
    }

    template <typename Work>
    auto timed(const Work& work)
    {
        const Stopwatch watch(outcome_.casting_s);
        return work();
    }

    void survey()
    {
        const Part all{0, 0, job_.file.rows(), job_.file.columns()};
        Grid<float> heights_m;
        read_in_bands(all, [&](std::size_t first_row, std::size_t rows) {
            if (heights_m.rows() != rows)
                heights_m = Grid<float>(rows, all.columns);
            read(first_row, 0, heights_m.view());
            for (SurveyedSlab& slab : slabs_)
                note_extremes(slab, first_row, heights_m);
            go_on(kSurveyed * static_cast<double>(first_row + rows) / static_cast<double>(all.rows));
        });
    }

    // Of the slab's cells in a band of rows.
    void note_extremes(SurveyedSlab& slab, std::size_t first_row, const Grid<float>& band_m) const
    {
        const Part part = part_of_lines(slab.first_line, slab.end_line());
        const std::size_t from = std::max(first_row, part.first_row);
        const std::size_t to = std::min(first_row + band_m.rows(), part.first_row + part.rows);
        for (std::size_t row = from; row < to; ++row)
            for (std::size_t column = part.first_column; column < part.first_column + part.columns; ++column)
                slab.pieces[(frame_.lines_are_rows ? column : row) / kCellsInPiece].note(
                    band_m(row - first_row, column));
    }

    std::size_t pieces() const { return (cells_ + kCellsInPiece - 1) / kCellsInPiece; }

    // The line nearest the light that can shade ground as low as that, piece by piece, on [own_line, end_line), and
    // one more, which it is joined to.
    std::size_t first_that_shades(std::size_t own_line, std::size_t end_line,
                                  const std::vector<float>& lowest_m) const
    {
        for (const SurveyedSlab& slab : slabs_)
            if (slab.first_line >= own_line || can_shade(slab, own_line, end_line, lowest_m))
                return std::min(slab.first_line, own_line) - (slab.first_line > 0 ? 1 : 0);
        return own_line;
    }

    bool can_shade(const SurveyedSlab& slab, std::size_t own_line, std::size_t end_line,
                   const std::vector<float>& lowest_m) const
    {
        // Casters that look at the samples around a place look up to a line past it.
        const double fall_m = frame_.drop_m * static_cast<double>(own_line - slab.end_line());
        const double moved = std::abs(frame_.lateral) * static_cast<double>(end_line - slab.first_line) + 2.0;
        const std::size_t beside = static_cast<std::size_t>(moved) / kCellsInPiece + 1;
        for (std::size_t piece = 0; piece < lowest_m.size(); ++piece) {
            const bool from_lower =
                frame_.lateral >= 0.0; // light moves to one side only, but for interpolation
            const std::size_t lower = piece - std::min<std::size_t>(piece, from_lower ? beside : 1);
            const std::size_t upper = std::min(piece + (from_lower ? 1 : beside), lowest_m.size() - 1);
            for (std::size_t shading = lower; shading <= upper; ++shading)
                if (static_cast<double>(slab.pieces[shading].highest_m) + kRounding_m
                    >= static_cast<double>(lowest_m[piece]) + fall_m)
                    return true;
        }
        return false;
    }

    std::vector<Window> cut_into_windows() const
    {
        std::vector<Window> windows;
        for (std::size_t first = 0; first < slabs_.size();) {
            Window window{0, first, first};
            const std::size_t own_line = slabs_[first].first_line;
            std::vector<float> lowest_m(pieces(), std::numeric_limits<float>::infinity());
            for (std::size_t last = first; last < slabs_.size(); ++last) {
                const std::size_t end_line = slabs_[last].end_line();
                for (std::size_t piece = 0; piece < pieces(); ++piece)
                    lowest_m[piece] = std::min(lowest_m[piece], slabs_[last].pieces[piece].lowest_m);
                const std::size_t needed = first_that_shades(own_line, end_line, lowest_m);
                const std::size_t lines = end_line - needed;
                if (static_cast<double>(lines) > most_lines_) {
                    if (last == first)
                        refuse(lines);
                    break;
                }
                window.first_needed_line = needed;
                window.last = last + 1;
            }
            windows.push_back(window);
            first = window.last;
        }
        return windows;
    }

    void cast(const Window& window)
    {
        // Horn's slope, which tells the classes apart, looks at all eight neighbours.
        const std::size_t beside = job_.result == ShadowResult::classes ? 1 : 0;
        const std::size_t own_line = slabs_[window.first].first_line;
        const std::size_t end_line = slabs_[window.last - 1].end_line();
        const std::size_t first_line =
            std::min(window.first_needed_line, own_line - std::min(own_line, beside));
        const std::size_t last_line = std::min(end_line + beside, lines_);
        const Part whole = part_of_lines(first_line, last_line);
        Grid<float> heights_m(whole.rows, whole.columns);
        read_in_bands(whole, [&](std::size_t first_row, std::size_t rows) {
            read(first_row, whole.first_column,
                 heights_m.view().window(first_row - whole.first_row, 0, rows, whole.columns));
            go_on(share_of(own_line));
        });
        const HeightField field{heights_m.view(), job_.file.ground().cell_size_m};
        const Execution execution{.threads = job_.execution.threads, .progress = [&](double done) {
                                      const double from = share_of(own_line);
                                      const double to = share_of(end_line);
                                      return !job_.execution.progress
                                             || job_.execution.progress(from + (to - from) * 0.8 * done);
                                  }};
        if (job_.result == ShadowResult::heights)
            return write_heights(window, whole, heights_m, timed([&] {
                                     return job_.caster.shadow_heights(field, job_.light, execution);
                                 }));
        ShadowMask mask = timed([&] { return job_.caster.cast(field, job_.light, execution); });
        if (job_.result == ShadowResult::mask)
            return write_mask(window, whole, mask);
        ShadowClasses classes = timed(
            [&] { return shadow_classes(field, mask, job_.light, {.threads = job_.execution.threads}); });
        write_classes(window, whole, mask, classes);
    }

    // Calls `write(part)` for every slab of a window that is its own.
    template <typename Write>
    void for_own(const Window& window, const Write& write)
    {
        const Stopwatch watch(outcome_.writing_s);
        for (std::size_t i = window.first; i < window.last; ++i) {
            write(part_of_lines(slabs_[i].first_line, slabs_[i].end_line()));
            go_on(share_of(slabs_[i].end_line()));
        }
    }

    void write_mask(const Window& window, const Part& whole, ShadowMask& mask)
    {
        for_own(window, [&](const Part& part) {
            const GridView<Lit> own = view_of(mask, whole, part);
            count_into(outcome_.count, own);
            encode(own, job_.codes);
            job_.writer.write(part.first_row, part.first_column, GridView<const Lit>(own));
        });
    }

    void write_classes(const Window& window, const Part& whole, ShadowMask& mask, ShadowClasses& classes)
    {
        for_own(window, [&](const Part& part) {
            count_into(outcome_.count, view_of(mask, whole, part));
            const GridView<ShadowClass> own = view_of(classes, whole, part);
            Grid<std::uint8_t> bytes(own.rows(), own.columns());
            for (std::size_t y = 0; y < own.rows(); ++y)
                std::ranges::transform(own.row(y), bytes.row(y).begin(),
                                       [](ShadowClass c) { return static_cast<std::uint8_t>(c); });
            job_.writer.write(part.first_row, part.first_column, GridView<const std::uint8_t>(bytes.view()));
        });
    }

    void write_heights(const Window& window, const Part& whole, Grid<float>& ground_m, ShadowField shadows)
    {
        for_own(window, [&](const Part& part) {
            const GridView<const float> ground = view_of(ground_m, whole, part);
            const GridView<float> own = view_of(shadows, whole, part);
            count_into(outcome_.count, ground, own);
            Grid<float> file_m(part.rows, part.columns); // the file's own heights, not lowered
            job_.file.read(part.first_row, part.first_column, file_m.view());
            finish_shadow_heights(job_, file_m.view(), ground, own, part.first_row, part.first_column);
            job_.writer.write(part.first_row, part.first_column, GridView<const float>(own));
        });
    }

    const ShadowJob& job_;
    LightFrame frame_;
    std::size_t lines_;
    std::size_t cells_;
    double most_lines_ = 0.0; // in memory at a time
    std::optional<CurvedEarth> curved_;
    std::vector<SurveyedSlab> slabs_; // in the order of the light
    ShadowOutcome outcome_;
};

} // namespace

void require_memory_for_windows(const HeightFile& file, const DirectionalLight& light, const Caster& caster,
                                ShadowResult result, double memory_bytes)
{
    const bool rows = uniform_answer(light) || light_frame(light, file.ground().cell_size_m).lines_are_rows;
    const std::size_t lines = std::min(kLeastLines, rows ? file.rows() : file.columns());
    const double needed_bytes = static_cast<double>(lines)
                                * static_cast<double>(rows ? file.columns() : file.rows())
                                * bytes_per_cell(caster, result, 0) * kBesides;
    if (needed_bytes > memory_bytes)
        refuse_lines(file, rows, lines, needed_bytes, memory_bytes);
}

ShadowOutcome cast_in_windows(const ShadowJob& job)
{
    return WindowedCast(job).run();
}

} // namespace duskline::cli
