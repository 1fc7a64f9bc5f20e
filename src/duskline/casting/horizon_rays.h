#pragma once

// How high the horizon stands over a cell, between two altitudes: the march of ray_march.h with a ray that is
// raised to whatever it meets.
//
//                         .-'        The ray starts at the lowest altitude of interest. Ground above it lifts it,
//                     .-' |          and what is left over is the tangent of the horizon's altitude: the greatest
//                 .-'  .-'|-._       (surface - ground) / distance over all crossings.
//             .-'  _.-'   |   `.
//        P o------'            `.
//
// Blocks that stay under the ray are left out. Rays of interest graze the ground, that is what a half-shadow is;
// so blocks are judged over a plane that rises with the light (tilted_maxima.h), where grazing rays are level.
//
// Not installed.

#include <duskline/casting/ray_march.h>
#include <duskline/terrain/tilted_maxima.h>

#include <cstddef>
#include <cstdint>

namespace duskline {

/// The plane over which rays of this light are level.
TiltedPlane plane_along(const DirectionalLight& light, CellSize cell_size_m);

/// Horizons in one direction. Keeps views of the heights and maxima.
class HorizonRays {
public:
    /// No height is greater in magnitude than `greatest_m`. `lowest_tangent` (0 or more) and `highest_tangent`
    /// are those of the altitudes of interest.
    HorizonRays(const HeightField& field, const TiltedMaxima& maxima, double greatest_m, Angle azimuth,
                double lowest_tangent, double highest_tangent);

    /// The tangent of the horizon's altitude from a cell with data, in the range of interest or else at its
    /// nearer end. `hint` is the distance, in lines, at which the horizon may stand; 0 for no idea. It is set to
    /// where it was found. It makes the search shorter, and can change the last bit of what is found.
    double tangent(std::size_t row, std::size_t column, std::int64_t& hint) const;

private:
    // A ray on its way. Rises are in metres per line.
    struct Search {
        RayStart start;
        double ground_m;
        double ground_over_plane_m;
        double rise;
    };

    bool is_under(const Search& search, std::size_t level, std::int64_t line, std::int64_t end,
                  std::int64_t first_cell, std::int64_t last_cell) const;
    bool is_over_everything(const Search& search, std::int64_t line) const;
    void follow(Search& search, std::int64_t& hint) const;
    void cross_lines(Search& search, std::int64_t line, std::int64_t end, std::int64_t& cell,
                     std::int64_t& hint) const;
    void raise_to_line(Search& search, std::int64_t line) const;
    void raise_to_cell(Search& search, std::int64_t cell) const;

    HeightField field_;
    const TiltedMaxima& maxima_;
    RayMarch march_;
    double metres_per_line_;
    double slope_; // cells sideways per line
    double plane_rise_;
    double lowest_rise_;
    double highest_rise_;
    double lowest_tangent_;
    double highest_tangent_;
    double highest_m_;
    double margin_m_;
};

} // namespace duskline
