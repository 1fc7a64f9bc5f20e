#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace duskline::kernels {

/// Where the beams of a light stand over one line of cells: beam k is over u = k + sideways * (whole +
/// fraction), so cell j and beam j - sideways * whole are neighbours, `fraction` of a cell apart.
struct BeamShift {
    std::ptrdiff_t whole = 0; ///< never falls from line to line
    float fraction = 0.0f;    ///< in [0, 1); nothing closer to a cell than a millionth of it
};

/// The shift at line v, for `lateral` in [-1, 1] cells per line.
BeamShift beam_shift(double lateral, std::size_t v);

/// Lines between two lowerings of the front, see SweepLines::front.
constexpr std::size_t kLinesPerTilt = 32;

/// Lines of cells, in light order, for one strip of neighbouring beams.
struct StripLines {
    const float* heights = nullptr; ///< cell `first_cell` of the first line; cells of a line lie side by side
    std::ptrdiff_t line_step = 0;   ///< values from line to line, any sign
    std::size_t first_cell = 0;     ///< of those in memory: all under the strip, and two more on either side
    std::size_t cells = 0;          ///< of a whole line

    std::size_t first_line = 0; ///< lines from the light to the first one here
    std::size_t lines = 0;
    const BeamShift* shifts = nullptr; ///< of each of these lines
    std::ptrdiff_t sideways = 1;       ///< 1 when light moves towards higher cells, else -1

    std::ptrdiff_t first_beam = 0; ///< the strip's beams: [first_beam, last_beam)
    std::ptrdiff_t last_beam = 0;
};

/// Heights of the front at one comb of beams, a cell apart: last_beam - first_beam + 2 of them, the strip's beams
/// and one neighbour on either side. Two copies; with every line the other becomes the newer.
struct CombFront {
    float* newer = nullptr;
    float* other = nullptr;
};

/// What a sweep (sweep.cpp) carries over the lines of a strip. Heights of the front are those of the shadow at the
/// last line divisible by kLinesPerTilt.
struct SweepLines {
    StripLines strip;
    float drop_m = 0.0f; ///< LightFrame::drop_m

    CombFront beams; ///< where `shifts` say
    CombFront
        halfway; ///< half a cell further; null when light runs along cells and beams pass over them only
};

/// A cell whose line the bracket could not settle.
struct OpenCell {
    static constexpr std::int32_t kUnanswered = 1; ///< neither above the bracket nor under it
    static constexpr std::int32_t kUnplaced = 2;   ///< its line may rise over a part of the front
    static constexpr std::int32_t kRises = 4;      ///< so may the column line from the line before

    std::uint32_t index;
    std::uint32_t flags;
};

/// One line of cells before the brackets of an exact front (exact.cpp). Index i is a cell, and the unit of the
/// front that holds it. Heights of the front are tilted: true ones plus tilt_m.
struct BracketLine {
    const float* cell = nullptr;
    const float* ahead = nullptr;       ///< the next cell in the direction the light moves sideways
    const float* behind = nullptr;      ///< and in the other
    const float* cell_before = nullptr; ///< of the line before; null where column lines do not matter
    const float* behind_before = nullptr;
    const float* next_cell = nullptr; ///< of the next line, to be fetched meanwhile

    const float* near = nullptr;  ///< front at the beam ahead of the cell, by `fraction` of a cell
    const float* far = nullptr;   ///< front at the beam behind it
    float* next_near = nullptr;   ///< where `near` goes, raised by this line
    float* above = nullptr;       ///< how far the front may rise over the chord between the two beams
    float* below = nullptr;       ///< and fall below it
    std::int32_t* base = nullptr; ///< the line that replaced everything before it

    std::uint8_t* lit = nullptr; ///< answers, not to be relied on where kUnanswered
    OpenCell* open = nullptr;    ///< filled; one for each cell at most

    float fraction = 0.0f;
    float slope = 0.0f; ///< cells sideways per line
    float drop_m = 0.0f;
    float tilt_m = 0.0f;
    float slack_m = 0.0f;    ///< more than rounding can be wrong by
    std::int32_t number = 0; ///< of the line
};

/// Which side of a transpose goes row after row: the one whose rows are far apart in memory, so that each of its
/// cache lines is finished before it is left.
enum class RowsFirst { read, written };

/// What rounding can be wrong by in the front of a lamp, as a share of the sizes of all numbers that meet: places of
/// beams to a millionth of a cell, and some forty roundings.
constexpr float kLampRounding = 5e-6f;

/// One line of cells before the brackets of a lamp's exact front (exact_lamp.cpp). Index i is a beam, and the unit
/// from it to the next one. Heights are over a plane through the lamp, those of the front divided by lines from it.
struct LampLine {
    const float* over = nullptr; ///< of cell 0; NaN for 64 cells either side of the grid
    double first_place = 0.0;    ///< of beam 0, in cells
    double step = 0.0;           ///< cells from beam to beam, 0 to below 1
    float beams_per_cell = 0.0f;
    float per_line = 0.0f; ///< 1 / lines from the lamp
    std::int32_t number = 0;

    // Filled; room for 32 more than there are beams.
    float* at = nullptr;            ///< this line at the beam
    float* part = nullptr;          ///< of a cell that the beam stands behind the sample before it
    std::int32_t* before = nullptr; ///< that sample
    float* next = nullptr;          ///< height of the one after
    float* size = nullptr;          ///< magnitudes of the two together
    float* front_before = nullptr;  ///< front without this line

    // Carried from line to line.
    float* front = nullptr;       ///< front at the beam
    float* above = nullptr;       ///< how far it may rise over the chord between two beams
    float* below = nullptr;       ///< and fall below it
    std::int32_t* base = nullptr; ///< the line that replaced everything before it

    std::uint8_t* answer = nullptr; ///< for the sample in the unit, not to be relied on where kUnanswered
    OpenCell* open = nullptr;       ///< filled; one for each unit at most
};

/// Cells of a line and of the one before, all on one side of the lamp. Index i is a cell.
struct LampCells {
    const float* over = nullptr; ///< heights over the lamp's plane
    const float* over_before = nullptr;
    std::ptrdiff_t outwards = 1; ///< 1 when cells count away from the lamp, else -1
    float first_away = 0.0f;     ///< from the lamp to cell 0
    float per_line = 0.0f;       ///< 1 / lines from the lamp
    float per_line_before = 0.0f;
    std::uint32_t* rising = nullptr; ///< filled; one for each cell at most
};

/// Beams of a silhouette map that are built together (smap_beams.cpp).
constexpr int kBeamsPerBandLog2 = 6;
constexpr std::size_t kBeamsPerBand = std::size_t{1} << kBeamsPerBandLog2;

/// Places of a section at which its line is compared with the lines before and after.
constexpr std::size_t kSectionPlaces = 5;

/// Where a place of a section lies on a line: a share of the way from a sample, 0 or 1, to the next.
struct SectionTap {
    std::int32_t sample = 0;
    float share = 0.0f;
};

/// All places of the sections of a line, on the line before, on it and on the line after.
struct SectionTaps {
    SectionTap before[kSectionPlaces];
    SectionTap own[kSectionPlaces];
    SectionTap after[kSectionPlaces];
};

/// A band of neighbouring beams, line after line of kBeamsPerBand values. Heights are tilted.
struct SilhouetteBand {
    std::size_t first_line = 0; ///< lines from the light to the first one here
    std::size_t lines = 0;
    bool better = true; ///< leave out silhouettes that cannot shadow, and those covered by the next

    /// Black in bit 0, and above it the next line of the band with a silhouette, plus 1; 0 for none.
    std::int32_t* texels = nullptr;
    float* highest_first = nullptr; ///< a straight bound over the ground of a section, at its two ends
    float* highest_last = nullptr;
    float* lowest_first = nullptr; ///< and one under it; NaN where some ground is missing
    float* lowest_last = nullptr;
};

/// One line of a band, whose colours and bounds are wanted. Index i is a beam, and the first of the three samples that
/// its section takes from a line.
struct SilhouetteLine {
    const float* before =
        nullptr; ///< samples of the line nearer the light; kBeamsPerBand + 2, NaN outside the grid
    const float* own = nullptr;
    const float* after = nullptr;
    const SectionTaps* taps = nullptr;
    float part = 0.0f;       ///< where sections begin, of the way from their first sample to the second
    float rise_m = 0.0f;     ///< how much lower the line before looks along the light, rounding included
    float fall_m = 0.0f;     ///< and the line after
    float tilt_m = 0.0f;     ///< added to heights
    float rounding_m = 0.0f; ///< what tilted heights may be wrong by
    bool first_sample_counts = false; ///< whether it is ground of the section even beside a hole
    SilhouetteBand out;               ///< the band from this line on
};

/// The SIMD code of one processor level. All levels give the same bytes.
struct Kernels {
    std::string_view isa; ///< "scalar", "ssse3", "sse4", "avx2", "avx512"

    /// Carries the front over the lines and answers every cell of the strip in `lit` (0 shadow, 1 lit, 255 no
    /// data), laid out as `heights` are.
    void (*sweep_mask)(const SweepLines&, std::uint8_t* lit, std::ptrdiff_t lit_line_step);

    /// The same with shadow heights for answers: minus infinity where nothing shades, NaN for no data.
    void (*sweep_shadow_heights)(const SweepLines&, float* shadow_m, std::ptrdiff_t shadow_line_step);

    /// Settles what it can of a line and returns how many open cells it found.
    std::size_t (*bracket_line)(const BracketLine&, std::size_t cells);

    /// over[i] = heights[i] less a number given in two parts.
    void (*heights_over)(const float* heights, std::size_t count, float high, float low, float* over);

    /// Settles what it can of a line and returns how many open units it found.
    std::size_t (*bracket_lamp_line)(const LampLine&, std::size_t units);

    /// Lists the cells whose line across, from the line before, may rise over both lines; returns how many.
    std::size_t (*rising_lines_across)(const LampCells&, std::size_t cells);

    /// Colours the sections of a line and bounds their ground; NextV is left at none.
    void (*mark_silhouettes)(const SilhouetteLine&);

    /// NextV of all texels of a band whose colours are known, by the parallel quad search.
    void (*search_next_silhouettes)(const SilhouetteBand&);

    /// The greatest magnitude among the values that are not NaN; 0 when there is none.
    float (*highest_magnitude)(const float* values, std::size_t count);

    /// to[x * to_stride + y] = from[y * from_stride + x] for y < rows, x < columns.
    void (*transpose_floats)(const float* from, std::ptrdiff_t from_stride, std::size_t rows,
                             std::size_t columns, float* to, std::ptrdiff_t to_stride, RowsFirst);
    void (*transpose_bytes)(const std::uint8_t* from, std::ptrdiff_t from_stride, std::size_t rows,
                            std::size_t columns, std::uint8_t* to, std::ptrdiff_t to_stride, RowsFirst);
};

/// Every level this build contains and this processor can run, best first; "scalar" is always the last.
std::span<const Kernels> runnable_kernels();

/// The one of that name. Throws InvalidInput, listing the names there are.
const Kernels& kernels_named(std::string_view isa);

/// The best of them, or the one named by the environment variable DUSKLINE_KERNELS (read once). Throws
/// InvalidInput when that names none of them.
const Kernels& active_kernels();

} // namespace duskline::kernels
