#pragma once

#include <duskline/products/ground_colours.h>
#include <duskline/terrain/brush.h>
#include <duskline/terrain/earth_curvature.h>
#include <duskline/terrain/ground_motion.h>

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace duskline::viewer {

/// What --animate and a state call ground that keeps still.
inline constexpr std::string_view kNoMotion = "none";

/// Throws InvalidInput, listing the names there are, unless that is a motion or `kNoMotion`.
void require_motion(std::string_view name);

/// The ground as it is now: moved by an animation, edited by a brush, lowered for the curvature; and its own colours.
class ChangingGround {
public:
    /// `texture` is empty or of the terrain's size.
    ChangingGround(Terrain at_rest, Tint tint, Picture texture, std::optional<CurvedEarth> curvature,
                   const Execution& execution);
    ChangingGround(const ChangingGround&) = delete;
    ChangingGround& operator=(const ChangingGround&) = delete;

    /// What is seen and casts shadows. Changes in place.
    const Terrain& terrain() const { return seen_; }
    const Picture& colours() const { return picture_; }

    /// Before it moved and was lowered; level water is level in it.
    HeightField at_rest() const { return still_; }

    /// Takes the ground to that second of a motion, of which `kNoMotion` is none. Returns the cells whose heights may
    /// have changed. Throws InvalidInput for a name there is not.
    CellRectangle move_to(std::string_view motion, double seconds);

    /// A stroke over the ground at rest, of which what is seen follows. Returns as `move_to`.
    CellRectangle stroke(const GridPoint& at, const Brush& brush);

    /// The cells whose colours may have changed with heights.
    CellRectangle repainted(const CellRectangle& heights_changed) const
    {
        return duskline::repainted(heights_changed, level_);
    }

private:
    void change_motion(std::string_view motion);
    void bring_up_to_date(const CellRectangle& changed);

    Execution execution_;
    Terrain at_rest_;
    Terrain moved_;
    Terrain seen_;
    HeightField still_; ///< at_rest_, and moved_: colours know nothing of the curvature
    HeightField level_;
    Tint tint_;
    Picture texture_;
    std::optional<CurvedEarth> curvature_;
    std::optional<GroundColours> colours_;
    Picture picture_;
    std::string motion_name_{kNoMotion};
    std::unique_ptr<GroundMotion> motion_;
    double seconds_ = 0.0;
};

} // namespace duskline::viewer
