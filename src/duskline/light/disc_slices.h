#pragma once

// The disc of a light cut into upright slices, for those who ask how much of it a horizon hides. Not installed.
//
//          .-+-+-.
//        / | | | | \        the disc as seen from the ground: a group is five slices, looked at together
//       | || | | || |       along the azimuth of the middle one, or each on its own
//   ----+-++-+-+-++-+----   what is below the horizontal lights nothing and is in no slice
//        \ | | | | /
//
// Discs are caps of the sphere, of any size up to a half of it, and may hold the zenith. Shares are those of
// their solid angle.

#include <duskline/light/directional_light.h>

#include <array>
#include <cstddef>
#include <vector>

namespace duskline {

/// A part of a disc between two azimuths, before a horizon that is level within it.
class DiscSlice {
public:
    /// One upright line through the disc: the sines of its lowest and highest altitude, and what a unit of their
    /// difference is as a share of the disc.
    struct Chord {
        double lowest_sine;
        double highest_sine;
        double share_per_sine;
    };

    /// The slice of the chords from `first` to before `last`, at least one.
    DiscSlice(Angle azimuth, const Chord* first, const Chord* last);

    /// Half of the slice lies on either side of it.
    Angle azimuth() const { return azimuth_; }
    /// Tangents of altitudes: a horizon no higher than the lowest hides nothing of the slice, one as high as
    /// the highest all of it. The highest is finite, even at the zenith.
    double lowest_tangent() const { return lowest_tangent_; }
    double highest_tangent() const { return highest_tangent_; }

    /// The share of the whole disc that is in this slice.
    double whole() const { return above_.front(); }

    /// And above a horizon whose altitude has this tangent, 0 or more. Falls steadily, to 0.
    double above(double horizon_tangent) const;

private:
    static constexpr std::size_t kSteps = 64;

    Angle azimuth_;
    double lowest_tangent_;
    double highest_tangent_;
    double lowest_sine_;
    double steps_per_sine_;
    std::array<double, kSteps + 1> above_{}; // at even steps of the sine of the horizon's altitude
};

/// Slices that share most horizons.
struct DiscGroup {
    DiscSlice all;
    static constexpr std::size_t kParts = 5; ///< slices of a group
    std::array<DiscSlice, kParts> parts;     ///< by azimuth; `all` looks where the middle one does
};

/// A disc in slices.
struct DiscSlices {
    std::vector<DiscGroup> groups; ///< side by side, by azimuth; none when all is below the horizontal
    double above_horizontal = 0.0; ///< the share of the disc that is not
    bool all_around = false;       ///< it holds the zenith: the last group stands beside the first
};

/// Cuts the disc of a light into slices that are equal shares of what there is of it above the horizontal: in
/// groups of five, 3 groups at least, and for wide discs one for 5 degrees of azimuth, up to 27. The angular
/// diameter must be above 0. Throws InvalidInput for angles out of range.
DiscSlices disc_slices(const DirectionalLight& light);

} // namespace duskline
