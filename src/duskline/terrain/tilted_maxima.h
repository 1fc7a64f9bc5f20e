#pragma once

// The highest ground of blocks, seen over a tilted plane. Not installed.
//
// A slope that rises as steeply as a ray looks as if it reached high above the ray everywhere, when all that is
// known of a block is its highest ground. Over a plane that rises with the ray it is what it is, level:
//
//        |   block  |                        |   block  |
//        |       .-'|  <- highest            |          |
//     ---|----.-'---|---- ray  . '           |.-'-._.-'-|  <- highest
//        |.-'    . '|                     ---|----------|---- ray

#include <duskline/execution/progress.h>
#include <duskline/terrain/height_field.h>

#include <cstddef>
#include <limits>
#include <vector>

namespace duskline {

/// A plane through the first sample.
struct TiltedPlane {
    double rise_per_row_m = 0.0;
    double rise_per_column_m = 0.0;

    double at(double row, double column) const { return rise_per_row_m * row + rise_per_column_m * column; }
};

/// The greatest height over a plane in blocks of 2^level x 2^level grid squares, samples on their borders
/// included, for levels from kFirstLevel on. NaN does not count; of nothing at all it is minus infinity.
class TiltedMaxima {
public:
    static constexpr std::size_t kFirstLevel = 2;

    TiltedMaxima() = default;

    /// One pass over the heights, none of which is greater in magnitude than `greatest_m`; memory: a third of a byte a
    /// cell. Keeps no view. Throws Cancelled.
    TiltedMaxima(const HeightField& field, const TiltedPlane& plane, double greatest_m,
                 const Execution& execution = {});

    /// The level whose one block covers everything.
    std::size_t last_level() const { return kFirstLevel + levels_.size() - 1; }

    float highest_m(std::size_t level, std::size_t block_row, std::size_t block_column) const
    {
        const Level& of = levels_[level - kFirstLevel];
        return of.highest_m[block_row * of.columns + block_column];
    }

    const TiltedPlane& plane() const { return plane_; }

    /// More than floats round heights over the plane by.
    double rounding_m() const { return rounding_m_; }

private:
    struct Level {
        std::size_t rows;
        std::size_t columns;
        std::vector<float> highest_m;
    };

    void fill_highest_of_rows(const HeightField& field, std::size_t block_row,
                              std::vector<float>& over_m) const;
    void fill_first_level(const HeightField& field, const Execution& execution);
    void add_level();

    TiltedPlane plane_;
    double rounding_m_ = 0.0;
    std::vector<Level> levels_;
};

} // namespace duskline
