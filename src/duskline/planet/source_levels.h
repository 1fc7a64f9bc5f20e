#pragma once

#include <duskline/execution/progress.h>
#include <duskline/planet/globe.h>
#include <duskline/planet/planet_source.h>
#include <duskline/terrain/height_field.h>

#include <cstddef>
#include <vector>

namespace duskline {

/// What a source says of a place.
struct SourceSample {
    double height_m = 0.0;
    double weight = 0.0;      ///< 0 without data and outside, 1 well within, smooth in between
    double roughness_m = 0.0; ///< how far cells around lie off the mean of their neighbours
};

/// How far cubic interpolation leaves the range of the values around, at either end, as a share of that range: an eighth along
/// rows and again along columns.
inline constexpr float kCubicOvershoot = 0.3f;

/// A source and the means of its blocks of 2 x 2, 4 x 4, ... cells, read at any place: what is drawn coarsely is averaged
/// and not picked out. Safe to read from several threads.
class SourceLevels {
public:
    struct Options {
        bool sea = false;             ///< ground below 0 is level sea for the roughness
        std::size_t border_cells = 0; ///< from the source's border, and from holes, to full weight
    };

    /// Takes about three times the memory of the heights. Throws InvalidInput as `require_valid`, and Cancelled.
    SourceLevels(PlanetSource source, const Options& options, const Execution& execution = {});

    /// Blocks of 2^0 to 2^(levels - 1) cells a side.
    std::size_t levels() const { return heights_m_.size(); }

    /// The level whose blocks are at most that large, and at least half as large where there are such.
    std::size_t level_of_spacing(double spacing_m, const Globe& globe) const;

    /// From row to row.
    double cell_m(const Globe& globe) const { return cell_height_.radians() * globe.equatorial_radius_m; }

    /// Cubic convolution between the cells (R. Keys, Cubic convolution interpolation for digital image processing, 1981):
    /// smooth, and right at their centres. Round the globe where the source goes round, over the poles where it reaches
    /// them. About 50 ns.
    SourceSample at(const LonLat& place, std::size_t level, bool with_roughness = true) const;

    /// Of the cells themselves.
    HeightRange heights() const { return range_; }
    float greatest_roughness_m() const;

    /// How far the ground of finer levels may lie from a level's own at the same place, at most: 0 for the finest.
    float relief_below_m(std::size_t level) const { return relief_below_m_[level]; }

private:
    struct Cell {
        double row;
        double column;
    };

    bool find_cell(const LonLat& place, Cell& cell) const;
    template <typename Visit>
    void visit_around(const Grid<float>& grid, const Cell& cell, const Visit& visit) const;
    double cubic(const Grid<float>& grid, const Cell& cell) const;
    double linear(const Grid<float>& grid, const Cell& cell) const;
    void measure_weights(std::size_t border_cells);
    void measure_roughness(bool sea);
    void add_coarser_levels();
    void measure_relief(bool sea);

    Angle west_;
    Angle north_;
    Angle cell_width_;
    Angle cell_height_;
    bool goes_round_ = false;
    bool reaches_poles_ = false;
    HeightRange range_;
    std::vector<Grid<float>> heights_m_; // of each level, holes filled
    std::vector<Grid<float>> weights_;   // of each level; empty where all weights are 1
    Grid<float> roughness_m_;            // of blocks of kRoughnessCells
    std::vector<float> relief_below_m_;
};

} // namespace duskline
