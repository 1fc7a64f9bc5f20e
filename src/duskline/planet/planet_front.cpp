// Light keeps its distance rho from the axis and its turn about it, so along a beam (the half-plane of one turn) the shadow
// reaches as high as the farthest ground it has met, and a front is one number a beam:
//
//      row 3   o----o-x--o--x-o---x      o  samples
//                    /    |    |         x  beams, straight on a face of the cube, half a cell apart or nearer; all
//      row 2   o----x-o--x--o--x-o          come from the one point where the light's axis meets the plane of the face
//                  /    |   |            ^  away from the sun: rows in this order, or columns for beams that run
//      row 1   o---x--o-x---ox---o       |  more along rows
//
//   at every row       answer its samples: the front between the two beams beside them, as a height
//   then, at a beam    front = max(front, distance from the axis of the ground between the two samples beside it),
//                      and the same where it crosses from one column to the next on its way to the next row
//
// Rows and columns are treated alike: "lines", along which x counts the cells. A beam belongs to rows or to columns by its
// direction on the face, for all its way over it. Samples on edges over which light enters are the neighbour's and are copied;
// a sample on another edge may have only one beam beside it, and has a beam of its own.
//
// Of a disc three numbers a beam: the farthest ground from the axes of its lower and of its upper edge, and how far from the
// upper edge's axis the ground is that is farthest from the lower edge's. Both axes have the same half-planes.
//
// After Timonen and Westerholm, Scalable Height Field Self-Shadowing, 2010 (a height carried along the light) as in
// casting/sweep; here it is carried about the axis of a globe.

#include <duskline/planet/light_section.h>
#include <duskline/planet/planet_front.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace duskline {

namespace {

constexpr std::int32_t kLast = kTileSquares; // line and cell
constexpr std::size_t kSamples = kTileSquares + 1;
constexpr double kNotPassed = -1.0;

// Cells by which a beam may miss a tile and still count as on its edge.
constexpr double kEdgeSlack = 1e-6;

// Steps by which a beam may be beside the range that a tile's corners have, so that one along an edge is among its beams.
constexpr double kRangeSlack = 1e-4;

bool is_of_u(TileEdge edge)
{
    return edge == TileEdge::lowest_u || edge == TileEdge::highest_u;
}

bool is_highest(TileEdge edge)
{
    return edge == TileEdge::highest_u || edge == TileEdge::highest_v;
}

// The row and column of sample i along an edge, counted along u or v.
struct SampleIndex {
    std::size_t row;
    std::size_t column;
};

SampleIndex sample_on(TileEdge edge, std::size_t i)
{
    const std::size_t across = is_highest(edge) ? kTileSquares : 0;
    return is_of_u(edge) ? SampleIndex{i, across} : SampleIndex{across, i};
}

// How much the sun is on the far side (greater x) of the line x = const on a face; exact negatives for both faces of an edge.
double towards_greater_x(const FaceVector& sun, double x)
{
    return sun.x - x * sun.ahead;
}

// A tile seen by lines: rows, or columns with u and v exchanged.
struct LineFrame {
    LinesAlong lines;
    const LightAxis& axis;
    FaceVector sun;
    double first_x; // of cell 0
    double first_y; // of line 0
    double step;    // from cell to cell and line to line

    LineFrame(const LightAxis& light, const PlanetTile& tile, LinesAlong lines_along)
        : lines(lines_along), axis(light), sun(on_face(light.to_sun, tile.face, lines_along))
    {
        const FacePlace first = sample_place(tile, 0, 0);
        first_x = lines == LinesAlong::u ? first.u : first.v;
        first_y = lines == LinesAlong::u ? first.v : first.u;
        step = 2.0 / static_cast<double>(std::uint64_t{kTileSquares} << tile.level);
    }

    double x_of(double cell) const { return first_x + cell * step; }
    double y_of(double line) const { return first_y + line * step; }
    // Light moves over cells and lines in the direction of the negative of these.
    double sun_across_cells(double cell) const { return towards_greater_x(sun, x_of(cell)); }
    double sun_across_lines(double line) const { return sun.y - y_of(line) * sun.ahead; }

    TileEdge edge_of_lines(bool highest) const
    {
        if (lines == LinesAlong::u)
            return highest ? TileEdge::highest_v : TileEdge::lowest_v;
        return highest ? TileEdge::highest_u : TileEdge::lowest_u;
    }
    TileEdge edge_of_cells(bool highest) const
    {
        if (lines == LinesAlong::u)
            return highest ? TileEdge::highest_u : TileEdge::lowest_u;
        return highest ? TileEdge::highest_v : TileEdge::lowest_v;
    }
    FacePlace place(double line, double cell) const
    {
        return lines == LinesAlong::u ? FacePlace{x_of(cell), y_of(line)} : FacePlace{y_of(line), x_of(cell)};
    }
};

// The samples of a tile by lines.
class LineSurface {
public:
    LineSurface(const Globe& globe, const PlanetTile& tile, const TileHeights& heights,
                const LineFrame& frame)
        : inverse_depth_(kSamples, kSamples), base_m_(kSamples, kSamples), norm_(kSamples, kSamples)
    {
        const CubeFaceAxes axes = axes_of_face(tile.face);
        const double flat = 1.0 / (globe.equatorial_radius_m * globe.equatorial_radius_m);
        const double polar = 1.0 / (globe.polar_radius_m * globe.polar_radius_m) - flat;
        for (std::int32_t line = 0; line <= kLast; ++line)
            for (std::int32_t cell = 0; cell <= kLast; ++cell) {
                const bool rows = frame.lines == LinesAlong::u;
                const FacePlace place = frame.place(line, cell);
                const double z = axes.axis.z + axes.right.z * place.u + axes.up.z * place.v;
                const double squared = 1.0 + place.u * place.u + place.v * place.v;
                const double norm = std::sqrt(squared);
                const double base_m = norm / std::sqrt(squared * flat + z * z * polar);
                const double height_m =
                    static_cast<double>(heights.height_m(rows ? line : cell, rows ? cell : line));
                const auto l = static_cast<std::size_t>(line);
                const auto c = static_cast<std::size_t>(cell);
                norm_(l, c) = norm;
                base_m_(l, c) = base_m;
                inverse_depth_(l, c) = norm / (base_m + height_m);
            }
    }

    // The ground at a place on a line: 1 / depth, which is straight between samples (see planet_ray.cpp).
    double on_line(std::size_t line, double cell) const
    {
        const auto left = std::min(static_cast<std::size_t>(cell), kSamples - 2);
        const double share = cell - static_cast<double>(left);
        const double* const at = inverse_depth_.row(line).data() + left;
        return at[0] + share * (at[1] - at[0]);
    }
    // And on a line along the cells' other way.
    double across_lines(double line, std::size_t cell) const
    {
        const auto below = std::min(static_cast<std::size_t>(line), kSamples - 2);
        const double share = line - static_cast<double>(below);
        return (1.0 - share) * inverse_depth_(below, cell) + share * inverse_depth_(below + 1, cell);
    }
    // The shadow height of a sample where light as far from the axis as `roof` times (1, x, y) passes.
    float shadow_height_m(std::size_t line, std::size_t cell, double roof) const
    {
        if (roof < 0.0) // opposite the sun's middle, and its edge is beyond
            return kDeepNight_m;
        const double height_m = norm_(line, cell) * roof - base_m_(line, cell);
        return std::min(static_cast<float>(height_m), kDeepNight_m);
    }

private:
    Grid<double> inverse_depth_;
    Grid<double> base_m_;
    Grid<double> norm_;
};

// What a beam has met, as far from an axis as it is. At depth 1 the beam's own distance from it is a straight function of the line.
struct Reach {
    double part0 = 0.0;
    double part_per_line = 0.0;
    double rho_m = kNotPassed;

    double part_at(double line) const { return part0 + line * part_per_line; }
    double roof_at(double line) const { return rho_m / part_at(line); }
};

// What a beam, or one between two, has over a sample: light passes at a place (1, x, y) times it.
struct Roofs {
    double lower = 0.0;
    double upper = 0.0;
    double upper_of_same = 0.0;
};

// A beam over a tile; its cell is a straight function of the line.
struct Beam {
    double cell0;
    double cells_per_line;
    Reach lower;         // of the one axis, or that of the disc's lower edge
    Reach upper;         // of that of its upper edge
    Reach upper_of_same; // and of the ground that `lower` is of
    double turn;
    Vector3 outward;
    bool of_disc;       // else there is no upper edge
    bool lends = false; // only stands beside beams of this pass and belongs to another

    Beam(const LineFrame& frame, const LightAxis* upper_axis, const PlanetTile& tile,
         const Vector3& outward_of_beam, double turn_of_beam)
        : turn(turn_of_beam), outward(outward_of_beam), of_disc(upper_axis != nullptr)
    {
        const BeamLine way(frame.sun, on_face(outward, tile.face, frame.lines));
        const double x0 = way.x_at(frame.first_y);
        cell0 = (x0 - frame.first_x) / frame.step;
        cells_per_line = way.dx / way.dy;
        const FaceVector& sun = frame.sun;
        const auto reach_from = [&](const LightAxis& axis) {
            return Reach{axis.from_raised_axis(sun.ahead + sun.x * x0 + sun.y * frame.first_y,
                                               way.axis_part(x0, frame.first_y)),
                         axis.from_raised_axis(sun.x * cells_per_line + sun.y,
                                               way.outward.x * cells_per_line + way.outward.y)
                             * frame.step};
        };
        lower = reach_from(frame.axis);
        if (of_disc)
            upper = upper_of_same = reach_from(*upper_axis);
    }

    double cell_at(double line) const { return cell0 + line * cells_per_line; }

    // Ground on a line, by the inverse of its depth.
    void meet(double line, double inverse_depth)
    {
        const double rho_m = lower.part_at(line) / inverse_depth;
        if (of_disc) {
            const double upper_rho_m = upper.part_at(line) / inverse_depth;
            if (rho_m > lower.rho_m)
                upper_of_same.rho_m = upper_rho_m;
            upper.rho_m = std::max(upper.rho_m, upper_rho_m);
        }
        lower.rho_m = std::max(lower.rho_m, rho_m);
    }

    Roofs roofs_at(double line) const
    {
        if (!of_disc)
            return {lower.roof_at(line)};
        return {lower.roof_at(line), upper.roof_at(line), upper_of_same.roof_at(line)};
    }
};

// Beams of a tile by their numbers, in steps of 2^-log2 turns.
struct BeamRange {
    std::uint32_t log2;
    std::int64_t first;
    std::int64_t count;
    bool full_turn;

    double turn(std::int64_t i) const
    {
        return std::ldexp(static_cast<double>(first + i), -static_cast<int>(log2));
    }
};

// One tile: its beams, the pass over its lines, and the answers on the way.
class TileCast {
public:
    TileCast(const Globe& globe, const LightAxis& axis, const LightAxis* upper, const PlanetTile& tile,
             const TileHeights& heights, const EnteringLight& entering)
        : globe_(globe), axis_(axis), upper_(upper), tile_(tile), heights_(heights), entering_(entering)
    {
        for (const TileEdge edge : kTileEdges)
            enters_.at(static_cast<std::size_t>(edge)) = light_enters(axis, tile, edge);
    }

    TileShadow run()
    {
        beams_ = beams_of_tile();
        const std::vector<double> none(static_cast<std::size_t>(beams_.count), kNotPassed);
        shadow_.leaving = {beams_.log2, beams_.first, none};
        if (upper_ != nullptr) {
            shadow_.leaving.upper_m = shadow_.leaving.upper_of_same_m = none;
            shadow_.dark_m = Grid<float>(kSamples, kSamples);
        }
        fill_for_no_beam();
        for (const LinesAlong lines : {LinesAlong::u, LinesAlong::v}) {
            const LineFrame frame(axis_, tile_, lines);
            if (!has_beams_across(frame))
                continue;
            const LineSurface surface(globe_, tile_, heights_, frame);
            for (const int direction : {1, -1})
                sweep(frame, surface, direction);
        }
        // A corner is rather a neighbour's than the ancestor's.
        for (const bool with_neighbour : {false, true})
            for (const TileEdge edge : kTileEdges)
                if (enters(edge) && with_neighbour == (neighbour_across(edge) != nullptr))
                    copy_edge(edge);
        return std::move(shadow_);
    }

private:
    const TileShadow* neighbour_across(TileEdge edge) const
    {
        return entering_.neighbours.at(static_cast<std::size_t>(edge));
    }
    bool enters(TileEdge edge) const { return enters_.at(static_cast<std::size_t>(edge)); }

    // Only where the axis meets the tile no beam passes.
    void fill_for_no_beam()
    {
        const bool day = dot(centre_direction(tile_), axis_.to_sun) > 0.0;
        const auto nothing_m = static_cast<float>(-globe_.equatorial_radius_m);
        for (Grid<float>* const heights_m : {&shadow_.heights_m, &shadow_.dark_m})
            std::fill(heights_m->values().begin(), heights_m->values().end(), day ? nothing_m : kDeepNight_m);
    }

    // Whether light over some of the tile crosses more lines than cells. A corner then does, or the axis is in the tile.
    bool has_beams_across(const LineFrame& frame) const
    {
        if (beams_.full_turn)
            return true;
        for (const double line : {0.0, static_cast<double>(kLast)})
            for (const double cell : {0.0, static_cast<double>(kLast)})
                if (is_across_lines(frame, line, cell))
                    return true;
        return false;
    }

    // Rows have the diagonals.
    static bool is_across_lines(const LineFrame& frame, double line, double cell)
    {
        const double lines = std::abs(frame.sun_across_lines(line));
        const double cells = std::abs(frame.sun_across_cells(cell));
        return frame.lines == LinesAlong::u ? lines >= cells : lines > cells;
    }

    // --- the beams

    BeamRange beams_of_tile() const
    {
        const LineFrame frame(axis_, tile_, LinesAlong::u);
        const std::uint32_t log2 = beams_log2(frame);
        const double beams = std::ldexp(1.0, static_cast<int>(log2));
        if (axis_is_in(frame))
            return {log2, 0, static_cast<std::int64_t>(beams), true};
        const double middle = turn_of(axis_, centre_direction(tile_));
        double low = 0.0;
        double high = 0.0;
        for (const std::int32_t row : {0, kLast})
            for (const std::int32_t column : {0, kLast}) {
                const double turn = turn_of(axis_, sample_direction(tile_, row, column)) - middle;
                low = std::min(low, turn - std::round(turn));
                high = std::max(high, turn - std::round(turn));
            }
        const auto first = static_cast<std::int64_t>(std::ceil((middle + low) * beams - kRangeSlack));
        const auto last = static_cast<std::int64_t>(std::floor((middle + high) * beams + kRangeSlack));
        return {log2, first, std::max<std::int64_t>(last - first + 1, 0), false};
    }

    // Enough that two neighbours are at most half a cell apart, along rows where they cross rows, else along columns. They
    // are farthest apart at a corner: from there to the axis the distance falls.
    std::uint32_t beams_log2(const LineFrame& frame) const
    {
        double cells_per_turn = 1.0;
        for (const double line : {0.0, static_cast<double>(kLast)})
            for (const double cell : {0.0, static_cast<double>(kLast)}) {
                const double a = frame.sun_across_cells(cell);
                const double b = frame.sun_across_lines(line);
                const double c = frame.y_of(line) * frame.sun.x - frame.x_of(cell) * frame.sun.y;
                const double most = std::max(std::abs(a), std::abs(b));
                if (most > 0.0)
                    cells_per_turn = std::max(cells_per_turn, 2.0 * std::numbers::pi * (a * a + b * b + c * c)
                                                                  / (most * frame.step));
            }
        return static_cast<std::uint32_t>(std::ceil(std::log2(2.0 * cells_per_turn)));
    }

    static bool axis_is_in(const LineFrame& frame)
    {
        const auto changes_sign = [](double low, double high, double slack) {
            return (low >= -slack && high <= slack) || (low <= slack && high >= -slack);
        };
        const double slack = kEdgeSlack * frame.step * std::abs(frame.sun.ahead);
        return frame.sun.ahead != 0.0
               && changes_sign(frame.sun_across_cells(0), frame.sun_across_cells(kLast), slack)
               && changes_sign(frame.sun_across_lines(0), frame.sun_across_lines(kLast), slack);
    }

    // Beams that cross lines in a direction, by their cells on every line, with one more on either side.
    std::vector<Beam> beams_across(const LineFrame& frame, int direction) const
    {
        // Over a whole turn the beams wanted may go on over its end.
        const std::int64_t end = beams_.full_turn ? 2 * beams_.count : beams_.count;
        const auto wanted = [&](std::int64_t i) {
            const FaceVector outward = on_face(outward_at(axis_, beams_.turn(i)), tile_.face, frame.lines);
            const BeamLine way(frame.sun, outward);
            const double lines = way.dy * direction;
            const double cells = std::abs(way.dx);
            return lines > 0.0 && (frame.lines == LinesAlong::u ? lines >= cells : lines > cells);
        };
        std::int64_t first = 0;
        if (beams_.full_turn)
            while (first < end && wanted(first))
                ++first;
        while (first < end && !wanted(first))
            ++first;
        std::int64_t last = first;
        while (last < end && wanted(last))
            ++last;
        std::vector<Beam> beams;
        if (first == last)
            return beams;
        for (std::int64_t i = first - 1; i <= last; ++i) {
            beams.emplace_back(frame, upper_, tile_, outward_at(axis_, beams_.turn(i)), beams_.turn(i));
            beams.back().lends = i < first || i == last;
        }
        // In the order of their cells, on a line where they are apart: they come from the sun, or meet opposite it.
        const double apart = (frame.sun.ahead > 0.0) == (direction > 0) ? kLast : 0.0;
        if (beams.front().cell_at(apart) > beams.back().cell_at(apart))
            std::reverse(beams.begin(), beams.end());
        return beams;
    }

    // --- the pass

    // Over all lines that light crosses in one direction.
    void sweep(const LineFrame& frame, const LineSurface& surface, int direction)
    {
        std::vector<Beam> beams = beams_across(frame, direction);
        if (beams.empty())
            return;
        std::vector<double> cells(beams.size());
        for (std::int32_t i = 0; i <= kLast; ++i) {
            const std::int32_t line = direction > 0 ? i : kLast - i;
            if (!(frame.sun_across_lines(line) * direction < 0.0))
                continue;
            std::transform(beams.begin(), beams.end(), cells.begin(),
                           [&](const Beam& beam) { return beam.cell_at(line); });
            const auto first = std::lower_bound(cells.begin(), cells.end(), -kEdgeSlack) - cells.begin();
            const auto last =
                std::upper_bound(cells.begin(), cells.end(), kLast + kEdgeSlack) - cells.begin();
            const std::span<Beam> over = {beams.data() + first, beams.data() + last};
            const std::span<const double> at = {cells.data() + first, cells.data() + last};
            for (Beam& beam : over)
                come_to(frame, surface, beam, line, direction);
            answer(frame, surface, over, at, line, direction);
            for (std::size_t k = 0; k < over.size(); ++k)
                cross(surface, over[k], line, at[k]);
        }
        keep_leaving(beams);
    }

    // What a beam meets before a line: what it brings with it, and the ground between two samples of neighbouring lines.
    void come_to(const LineFrame& frame, const LineSurface& surface, Beam& beam, std::int32_t line,
                 int direction) const
    {
        if (beam.lower.rho_m < 0.0)
            enter(frame, beam, line, direction);
        if (line == (direction > 0 ? 0 : kLast))
            return;
        const double cell = beam.cell_at(line);
        const double before = beam.cell_at(line - direction);
        const double far = std::max(cell, before);
        if (far < 0.0)
            return;
        const auto between = static_cast<std::int32_t>(far);
        if (between < std::min(cell, before) || between > kLast)
            return;
        const double at = (between - beam.cell0) / beam.cells_per_line;
        const double ahead = (line - at) * direction; // at a sample of the line it is ground of the line
        if (ahead > kEdgeSlack && ahead <= 1.0 && at >= 0.0 && at <= kLast && beam.lower.part_at(at) > 0.0)
            beam.meet(at, surface.across_lines(at, static_cast<std::size_t>(between)));
    }

    static void cross(const LineSurface& surface, Beam& beam, std::int32_t line, double cell)
    {
        const double ground = surface.on_line(static_cast<std::size_t>(line),
                                              std::clamp(cell, 0.0, static_cast<double>(kLast)));
        beam.meet(line, ground);
    }

    void keep_leaving(const std::vector<Beam>& beams)
    {
        const double scale = std::ldexp(1.0, static_cast<int>(beams_.log2));
        for (const Beam& beam : beams) {
            if (beam.lends)
                continue;
            const std::int64_t number = std::llround(beam.turn * scale) - beams_.first;
            const auto i = static_cast<std::size_t>(number % beams_.count);
            shadow_.leaving.rho_m[i] = beam.lower.rho_m;
            if (upper_ == nullptr)
                continue;
            shadow_.leaving.upper_m[i] = beam.upper.rho_m;
            shadow_.leaving.upper_of_same_m[i] = beam.upper_of_same.rho_m;
        }
    }

    // --- answers

    void answer(const LineFrame& frame, const LineSurface& surface, std::span<const Beam> beams,
                std::span<const double> cells, std::int32_t line, int direction)
    {
        if ((line == 0 && enters(frame.edge_of_lines(false)))
            || (line == kLast && enters(frame.edge_of_lines(true))))
            return;
        const std::int32_t first = enters(frame.edge_of_cells(false)) ? 1 : 0;
        const std::int32_t last = enters(frame.edge_of_cells(true)) ? kLast - 1 : kLast;
        const auto l = static_cast<std::size_t>(line);
        std::size_t right = 0;
        for (std::int32_t cell = first; cell <= last; ++cell) {
            if (!is_across_lines(frame, line, cell))
                continue;
            const auto c = static_cast<std::size_t>(cell);
            while (right < cells.size() && cells[right] <= cell)
                ++right;
            const bool between = right > 0 && right < cells.size();
            const Roofs roofs = between ? roofs_between(beams, cells, right, line, cell)
                                        : own_beam(frame, surface, line, cell, direction).roofs_at(line);
            const bool rows = frame.lines == LinesAlong::u;
            put(surface, roofs, l, c, rows ? SampleIndex{l, c} : SampleIndex{c, l});
        }
    }

    // Of a disc the first height is that of the upper edge where the ground is in full shadow, else what the same ground that
    // hides the lower edge does to the upper one: between two heights made by different ground there is no half-shadow.
    void put(const LineSurface& surface, const Roofs& roofs, std::size_t line, std::size_t cell,
             SampleIndex sample)
    {
        shadow_.heights_m(sample.row, sample.column) = surface.shadow_height_m(line, cell, roofs.lower);
        if (upper_ == nullptr)
            return;
        const float upper_m = surface.shadow_height_m(line, cell, roofs.upper);
        const float ground_m = heights_.height_m(static_cast<std::int32_t>(sample.row),
                                                 static_cast<std::int32_t>(sample.column));
        shadow_.dark_m(sample.row, sample.column) =
            upper_m > ground_m ? upper_m
                               : std::min(upper_m, surface.shadow_height_m(line, cell, roofs.upper_of_same));
    }

    static Roofs roofs_between(std::span<const Beam> beams, std::span<const double> cells, std::size_t right,
                               std::int32_t line, std::int32_t cell)
    {
        const Roofs low = beams[right - 1].roofs_at(line);
        const Roofs high = beams[right].roofs_at(line);
        const double share = (cell - cells[right - 1]) / (cells[right] - cells[right - 1]);
        return {low.lower + share * (high.lower - low.lower), low.upper + share * (high.upper - low.upper),
                low.upper_of_same + share * (high.upper_of_same - low.upper_of_same)};
    }

    // A beam through the sample itself, from where it enters the tile.
    Beam own_beam(const LineFrame& frame, const LineSurface& surface, std::int32_t line, std::int32_t cell,
                  int direction) const
    {
        const FacePlace place = frame.place(line, cell);
        const Vector3 sample = direction_of(tile_.face, place);
        const double turn = turn_of(axis_, sample);
        Beam beam(frame, upper_, tile_, outward_at(axis_, turn), turn);
        const auto is_over = [&](std::int32_t at) {
            const double c = beam.cell_at(at);
            return at >= 0 && at <= kLast && frame.sun_across_lines(at) * direction < 0.0 && c >= -kEdgeSlack
                   && c <= kLast + kEdgeSlack;
        };
        std::int32_t first = line;
        while (is_over(first - direction))
            first -= direction;
        for (std::int32_t at = first; at != line; at += direction) {
            come_to(frame, surface, beam, at, direction);
            cross(surface, beam, at, beam.cell_at(at));
        }
        come_to(frame, surface, beam, line, direction);
        return beam;
    }

    // --- light that enters

    // A beam has then what it has met before `line`, the first that it crosses.
    void enter(const LineFrame& frame, Beam& beam, std::int32_t line, int direction) const
    {
        if (line == (direction > 0 ? 0 : kLast)) {
            enter_over(frame.edge_of_lines(direction < 0), beam,
                       frame.place(line, std::clamp(beam.cell_at(line), 0.0, 1.0 * kLast)));
            return;
        }
        // Between this line and the one before, or the axis if that is nearer.
        double before = line - direction;
        if (!(frame.sun_across_lines(before) * direction < 0.0))
            before = (frame.sun.y / frame.sun.ahead - frame.first_y) / frame.step;
        const double cell_before = beam.cell_at(before);
        if (cell_before >= -kEdgeSlack && cell_before <= kLast + kEdgeSlack) {
            begin_with(beam, 0.0, 0.0, 0.0); // in the tile, under the sun
            return;
        }
        const bool highest = cell_before > kLast;
        const double edge_cell = highest ? kLast : 0.0;
        const double edge_line = std::clamp((edge_cell - beam.cell0) / beam.cells_per_line, 0.0, 1.0 * kLast);
        enter_over(frame.edge_of_cells(highest), beam, frame.place(edge_line, edge_cell));
    }

    void begin_with(Beam& beam, double lower_m, double upper_m, double upper_of_same_m) const
    {
        beam.lower.rho_m = lower_m;
        if (upper_ == nullptr)
            return;
        beam.upper.rho_m = upper_m;
        beam.upper_of_same.rho_m = upper_of_same_m;
    }

    void enter_over(TileEdge edge, Beam& beam, FacePlace place) const
    {
        if (const TileShadow* const neighbour = neighbour_across(edge)) {
            const LeavingFront& front = neighbour->leaving;
            begin_with(beam, front.rho_at(beam.turn), front.upper_at(beam.turn),
                       front.upper_of_same_at(beam.turn));
            return;
        }
        const double lower_m = rho_over_edge_m(axis_, &TileShadow::heights_m, beam, place);
        const double upper_m =
            upper_ != nullptr ? rho_over_edge_m(*upper_, &TileShadow::dark_m, beam, place) : 0.0;
        begin_with(beam, lower_m, upper_m, upper_m);
    }

    // Where no neighbour knows.
    double rho_over_edge_m(const LightAxis& axis, Grid<float> TileShadow::*heights_m, const Beam& beam,
                           FacePlace place) const
    {
        const Vector3 direction = direction_of(tile_.face, place);
        const double sine = axis.from_raised_axis(dot(direction, axis.to_sun), dot(direction, beam.outward));
        if (entering_.ancestor != nullptr) // floats: where nothing has been met, a little below the centre
            return std::max(0.0, base_radius_m(globe_, direction) + ancestor_height_m(heights_m, place))
                   * sine;
        if (dot(direction, axis.to_sun) > 0.0)
            return 0.0;
        return bare_rho_m(axis, beam.outward);
    }

    // How far the bare globe reaches from the axis.
    double bare_rho_m(const LightAxis& axis, const Vector3& outward) const
    {
        const Vector3 sun = axis.to_sun * axis.raised_cosine + outward * axis.raised_sine;
        const Vector3 away = outward * axis.raised_cosine - axis.to_sun * axis.raised_sine;
        return LightSection(globe_, sun, away).greatest_rho_m();
    }

    double ancestor_height_m(Grid<float> TileShadow::*which, FacePlace place) const
    {
        const FacePlace first = sample_place(entering_.ancestor_tile, 0, 0);
        const double step =
            2.0 / static_cast<double>(std::uint64_t{kTileSquares} << entering_.ancestor_tile.level);
        const double row = std::clamp((place.v - first.v) / step, 0.0, 1.0 * kLast);
        const double column = std::clamp((place.u - first.u) / step, 0.0, 1.0 * kLast);
        const auto r = std::min(static_cast<std::size_t>(row), kSamples - 2);
        const auto c = std::min(static_cast<std::size_t>(column), kSamples - 2);
        const Grid<float>& heights_m = entering_.ancestor->*which;
        const auto at = [&](std::size_t i, std::size_t k) { return static_cast<double>(heights_m(i, k)); };
        const double down = row - static_cast<double>(r);
        const double right = column - static_cast<double>(c);
        return (1.0 - down) * ((1.0 - right) * at(r, c) + right * at(r, c + 1))
               + down * ((1.0 - right) * at(r + 1, c) + right * at(r + 1, c + 1));
    }

    void copy_edge(TileEdge edge)
    {
        copy_edge(edge, axis_, &TileShadow::heights_m);
        if (upper_ != nullptr)
            copy_edge(edge, *upper_, &TileShadow::dark_m);
    }

    void copy_edge(TileEdge edge, const LightAxis& axis, Grid<float> TileShadow::*heights_m)
    {
        const TileShadow* const shadow = neighbour_across(edge);
        const TileNeighbour neighbour = neighbour_of(tile_, edge);
        for (std::size_t i = 0; i < kSamples; ++i) {
            const SampleIndex own = sample_on(edge, i);
            const SampleIndex other = sample_on(neighbour.edge, neighbour.reversed ? kTileSquares - i : i);
            (shadow_.*heights_m)(own.row, own.column) =
                shadow != nullptr ? (shadow->*heights_m)(other.row, other.column)
                                  : height_without_neighbour_m(axis, heights_m, own);
        }
    }

    float height_without_neighbour_m(const LightAxis& axis, Grid<float> TileShadow::*heights_m,
                                     SampleIndex sample) const
    {
        const FacePlace place =
            sample_place(tile_, static_cast<double>(sample.row), static_cast<double>(sample.column));
        if (entering_.ancestor != nullptr)
            return static_cast<float>(ancestor_height_m(heights_m, place));
        const Vector3 direction = direction_of(tile_.face, place);
        if (dot(direction, axis.to_sun) > 0.0)
            return static_cast<float>(-globe_.equatorial_radius_m);
        const Vector3 away = direction - axis.to_sun * dot(direction, axis.to_sun);
        const double across = std::max(length(away), 1e-9);
        const double sine = axis.from_raised_axis(dot(direction, axis.to_sun), across);
        if (!(sine > 0.0))
            return kDeepNight_m;
        const double rho_m = bare_rho_m(axis, away * (1.0 / across));
        return std::min(static_cast<float>(rho_m / sine - base_radius_m(globe_, direction)), kDeepNight_m);
    }

    const Globe& globe_;
    const LightAxis& axis_;
    const LightAxis* upper_; // of the upper edge of a disc; else null
    const PlanetTile& tile_;
    const TileHeights& heights_;
    const EnteringLight& entering_;
    std::array<bool, 4> enters_ = {};
    BeamRange beams_ = {};
    TileShadow shadow_;
};

} // namespace

double LeavingFront::between_beams(const std::vector<double>& all_m, double turn) const
{
    if (all_m.empty())
        return 0.0;
    const auto count = static_cast<std::int64_t>(all_m.size());
    const double beams = std::ldexp(1.0, static_cast<int>(beams_log2));
    double at = std::ldexp(turn, static_cast<int>(beams_log2)) - static_cast<double>(first);
    at -= std::floor(at / beams) * beams;
    if (at > (beams + static_cast<double>(count)) / 2.0 && static_cast<double>(count) < beams)
        at -= beams; // nearer to the first than to the last
    const auto low = static_cast<std::int64_t>(std::floor(at));
    const auto passed = [&](std::int64_t i) {
        const std::int64_t k = static_cast<double>(count) == beams ? (i + count) % count : i;
        return k >= 0 && k < count && all_m[static_cast<std::size_t>(k)] >= 0.0
                   ? std::optional(all_m[static_cast<std::size_t>(k)])
                   : std::nullopt;
    };
    const double share = at - static_cast<double>(low);
    const std::optional<double> left = passed(low);
    const std::optional<double> right = share > 0.0 ? passed(low + 1) : left;
    if (left && right)
        return *left + share * (*right - *left);
    // Roundings at corners of the tile.
    for (std::int64_t off = 0; off <= 2; ++off)
        for (const std::int64_t i : {low - off, low + 1 + off})
            if (const std::optional<double> rho = passed(i))
                return *rho;
    return 0.0;
}

bool light_enters(const LightAxis& axis, const PlanetTile& tile, TileEdge edge)
{
    const FaceVector sun = on_face(axis.to_sun, tile.face, is_of_u(edge) ? LinesAlong::u : LinesAlong::v);
    const FacePlace place =
        is_highest(edge) ? sample_place(tile, kTileSquares, kTileSquares) : sample_place(tile, 0, 0);
    const double towards = towards_greater_x(sun, is_of_u(edge) ? place.u : place.v);
    if (towards != 0.0)
        return is_highest(edge) == (towards > 0.0);
    // Along the edge: a choice that both tiles make alike.
    const std::uint32_t other = neighbour_of(tile, edge).tile.face;
    return other == tile.face ? is_highest(edge) : other < tile.face;
}

namespace {

// How late light comes to a column (or row) of tiles of a face: it crosses from lower numbers to higher. The edges that have the
// sun on their side of greater x are the first ones of a face that looks towards the sun, and the last ones of another.
std::int64_t steps_from_sun(const FaceVector& sun, std::uint32_t level, std::uint32_t index)
{
    const std::int64_t tiles = std::int64_t{1} << level;
    const auto is_beyond = [&](std::int64_t edge) {
        return towards_greater_x(sun, static_cast<double>(2 * edge) / static_cast<double>(tiles) - 1.0)
               >= 0.0;
    };
    const bool day = sun.ahead >= 0.0;
    std::int64_t first = 0; // after the search, the first edge that is not as edges before the sun's column
    std::int64_t last = tiles + 1;
    while (first < last) {
        const std::int64_t middle = (first + last) / 2;
        if (is_beyond(middle) == day)
            first = middle + 1;
        else
            last = middle;
    }
    const std::int64_t steps = std::abs(static_cast<std::int64_t>(index) - (first - 1));
    return day ? steps : -steps;
}

} // namespace

LightRank light_rank(const LightAxis& axis, const PlanetTile& tile)
{
    const FaceVector sun = on_face(axis.to_sun, tile.face, LinesAlong::u);
    const FaceVector by_columns = on_face(axis.to_sun, tile.face, LinesAlong::v);
    return {tile.level, -sun.ahead, tile.face,
            steps_from_sun(sun, tile.level, tile.column) + steps_from_sun(by_columns, tile.level, tile.row),
            tile};
}

TileShadow cast_on_tile(const Globe& globe, const LightAxis& axis, const PlanetTile& tile,
                        const TileHeights& heights, const EnteringLight& entering)
{
    return TileCast(globe, axis, nullptr, tile, heights, entering).run();
}

TileShadow cast_on_tile(const Globe& globe, const DiscAxes& axes, const PlanetTile& tile,
                        const TileHeights& heights, const EnteringLight& entering)
{
    return TileCast(globe, axes.lower, &axes.upper, tile, heights, entering).run();
}

} // namespace duskline
