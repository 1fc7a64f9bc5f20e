#pragma once

#include <duskline/execution/progress.h>
#include <duskline/geometry/cell_rectangle.h>
#include <duskline/terrain/height_field.h>
#include <duskline/view/frustum.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace duskline {

/// A square of the mesh that stands for a terrain: kPatchSquares x kPatchSquares squares, each of 2^level x 2^level
/// cells, from cell (row, column) on. Corners beyond the last row or column of the grid lie on it instead.
struct MeshPatch {
    std::uint32_t row = 0;
    std::uint32_t column = 0;
    std::uint32_t level = 0;

    bool operator==(const MeshPatch&) const = default;
};
inline constexpr std::size_t kPatchSquares = 32;

/// Where a level of detail turns into the next coarser one: at distances from the eye up to `begin_m` corners are where
/// their heights say, from `end_m` on every second one lies on its neighbour, as in the coarser level, and between the
/// two it is on its way. The coarsest level never turns: both are infinite.
struct MorphRange {
    double begin_m = 0.0;
    double end_m = 0.0;

    bool operator==(const MorphRange&) const = default;
};

/// How finely which part of a terrain is to be drawn: continuous distance-dependent level of detail.
///
///       eye                              A block of the quadtree is split while its box is nearer than the end of
///        o      end of level 0           the next finer level. So where two levels meet, the finer has wholly
///     +--+--+--+--+--+-----+-----+       turned into the coarser, and the coarser has not begun to turn: there are
///     |__|__|__|__|__|     |     |       no cracks, and nothing jumps when the eye moves.
///     |  |  |  |  |  |     |     |
///     +--+--+--+--+--+-----+-----+
///
/// The ends are chosen so that what a coarser level leaves out is smaller than an allowed error in pixels, for 99 of
/// 100 samples; near the eye everything is drawn. No OpenGL. Source: F. Strugar, Continuous distance-dependent level of
/// detail for rendering heightmaps, Journal of Graphics, GPU, and Game Tools 14, 2009. There ends are multiples of one
/// another; here the errors of the levels decide.
class LevelOfDetail {
public:
    /// One pass over the heights, of which it keeps a view. Throws InvalidInput for cell sizes out of range, Cancelled.
    explicit LevelOfDetail(const HeightField& field, const Execution& execution = {});

    /// To be called when heights have changed in a rectangle inside the grid, before the next `morph_ranges`: it is then
    /// as if made anew. Cost: a pass over the blocks it touches, and over 100 000 samples of each level.
    void heights_changed(const CellRectangle& rectangle, const Execution& execution = {});

    /// Levels there are, the finest 0.
    std::size_t levels() const { return blocks_.size(); }

    /// By how much (metres) a level may be wrong about 99 of 100 samples; 0 for the finest.
    double error_m(std::size_t level) const { return error_m_[level]; }

    /// Of all levels. `pixels_per_radian` is the picture's, `pixel_error` what may be wrong, both above 0.
    std::vector<MorphRange> morph_ranges(double pixels_per_radian, double pixel_error) const;

    /// The patches to draw: together they cover all of the terrain that the camera may see and that has data, each place
    /// once. `ranges` are those of `morph_ranges`. Cost: a fraction of a microsecond for each patch.
    std::vector<MeshPatch> select(const Vector3& eye_m, const Frustum& frustum,
                                  const std::vector<MorphRange>& ranges) const;

    /// All patches of one level that have data and whose box is `wanted`. Boxes of coarser levels around them are asked
    /// first, and what is in one that is not wanted is left out. Throws InvalidInput for a level that there is not.
    std::vector<MeshPatch> patches_of(std::size_t level, const std::function<bool(const Box&)>& wanted) const;

    /// What the ground under a patch lies in. Empty heights (lowest above highest) where it has no data.
    Box box_of(const MeshPatch& patch) const;

    /// Of all heights.
    HeightRange heights() const { return blocks_.back()(0, 0); }

private:
    struct Selection;

    void measure_errors(const Execution& execution);
    void measure_block(std::size_t block_row, std::size_t block_column);
    void measure_parent(std::size_t level, std::size_t block_row, std::size_t block_column);
    void find_diagonals();
    bool is_there(const MeshPatch& block) const;
    void select_block(const MeshPatch& block, Selection& selection) const;

    HeightField field_;
    std::vector<Grid<HeightRange>> blocks_; ///< of each level: those of kPatchSquares * 2^level cells
    std::vector<double> diagonal_m_;        ///< of each level: of its largest box
    std::vector<double> error_m_;
};

/// The same terrain with heights where there are none: the mean of the data around a hole, farther away the wider the
/// hole is. For meshes, which cannot leave out single corners; what is drawn is up to the data. A field without any
/// data becomes 0. One pass and a third. Source: S. Gortler et al., The lumigraph, SIGGRAPH 1996 (pull-push).
Grid<float> with_holes_filled(const HeightField& field);

} // namespace duskline
