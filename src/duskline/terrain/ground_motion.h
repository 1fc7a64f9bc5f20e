#pragma once

#include <duskline/execution/progress.h>
#include <duskline/geometry/cell_rectangle.h>
#include <duskline/terrain/height_field.h>

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>

namespace duskline {

/// Ground that moves: its heights are a function of the ground at rest and of time, and of nothing else. At second 0,
/// and whenever a period is over, it is the ground at rest, to the bit. Seconds may be below 0.
class GroundMotion {
public:
    GroundMotion() = default;
    GroundMotion(const GroundMotion&) = delete;
    GroundMotion& operator=(const GroundMotion&) = delete;
    virtual ~GroundMotion() = default;

    /// The cells that may be other than at rest at that time; of no rows when all is at rest.
    virtual CellRectangle reach(double seconds) const = 0;

    /// Heights at that time of the cells of a row from `first_column` on, from those at rest. No data stays no data.
    virtual void fill_row(std::size_t row, std::size_t first_column, double seconds,
                          std::span<const float> at_rest_m, std::span<float> heights_m) const = 0;
};

/// One way for ground to move. The viewer and the tests iterate over `ground_motions()`.
struct GroundMotionKind {
    std::string_view name;        ///< as typed after --animate
    std::string_view description; ///< one line
    double period_s;              ///< after which it is where it began
    bool carries_water;           ///< what is water at rest moves as water; else what rises out of it is land

    /// Fits the motion to a terrain's size, middle and relief as they are now; edits made later move along. Throws
    /// InvalidInput for cell sizes out of range, Cancelled. Cost: at most one pass.
    std::unique_ptr<GroundMotion> (*make)(const HeightField& at_rest, const Execution& execution);
};

/// Every motion there is.
std::span<const GroundMotionKind> ground_motions();

/// The motion of that name. Throws InvalidInput, listing the names there are.
const GroundMotionKind& ground_motion_named(std::string_view name);

/// Takes heights that are those of one time to another, in place. Returns the cells that may have changed: what has to
/// be told to those who keep shadows, meshes or textures. Throws InvalidInput for seconds that are not finite and for
/// grids of different sizes, with everything as it was. Cost: the cells returned.
CellRectangle move_ground(const GroundMotion& motion, const HeightField& at_rest, double from_s, double to_s,
                          GridView<float> heights_m, const Execution& execution = {});

} // namespace duskline
