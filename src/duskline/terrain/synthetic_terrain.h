#pragma once

#include <duskline/execution/progress.h>
#include <duskline/geometry/angle.h>
#include <duskline/terrain/height_field.h>

#include <cstddef>
#include <cstdint>
#include <limits>

namespace duskline {

// Terrains whose shadows are known on paper, and mountains to try things on.
//
// Every shape is placed by its centre, which is the centre of the grid: halfway between its first and last
// cell centres, so on a cell when there is an odd number of them. x runs east and y north from there, metres.
// Directions are compass directions, clockwise from north. Heights are metres, rounded to float at the end.
// All functions throw InvalidInput for cell sizes, lengths or angles out of range. Cost: one pass.

/// The cells a terrain is sampled on. No rows or no columns give an empty terrain.
struct SampleGrid {
    std::size_t rows = 257;
    std::size_t columns = 257;
    CellSize cell_size_m = {};
};

/// An inclined plane, level by default.
struct PlaneOptions {
    SampleGrid grid = {};
    double height_m = 0.0; ///< at the centre
    Angle slope = {};      ///< steepness, 0 to below 90 degrees
    Angle aspect = {};     ///< the direction in which it falls
};
Terrain make_plane(const PlaneOptions& options);

/// A straight wall on level ground: a cell belongs to it when its centre lies within half the thickness of
/// the wall's middle line. A wall that runs along rows or columns is watertight when it is a cell thick, an
/// oblique one when it is cell_x |cos course| + cell_y |sin course| thick.
struct WallOptions {
    SampleGrid grid = {};
    double ground_m = 0.0;
    double height_m = 10.0; ///< above the ground
    Angle course = {};      ///< the direction it runs in; 0 is north-south
    double thickness_m = 1.0;
    double length_m = std::numeric_limits<double>::infinity(); ///< half of it either way from the centre
    double offset_m = 0.0; ///< of the middle line from the centre, to the right of the course
};
Terrain make_wall(const WallOptions& options);

/// High ground that ends at a straight vertical face; cells on the edge belong to the high ground.
struct StepOptions {
    SampleGrid grid = {};
    double ground_m = 0.0;
    double height_m = 10.0; ///< of the high ground above the low
    Angle facing = {};      ///< the direction in which the face looks, towards the low ground
    double offset_m = 0.0;  ///< of the edge from the centre, in that direction
};
Terrain make_step(const StepOptions& options);

/// A cone on level ground.
struct ConeOptions {
    SampleGrid grid = {};
    double ground_m = 0.0;
    double height_m = 50.0;                  ///< of the tip above the ground
    Angle slope = Angle::from_degrees(45.0); ///< of its side, above 0 and below 90 degrees
};
Terrain make_cone(const ConeOptions& options);

/// Half a ball on level ground.
struct DomeOptions {
    SampleGrid grid = {};
    double ground_m = 0.0;
    double radius_m = 50.0;
};
Terrain make_dome(const DomeOptions& options);

/// A bowl in level ground, part of a sphere; half a sphere when it is as deep as its radius.
struct PitOptions {
    SampleGrid grid = {};
    double ground_m = 0.0;
    double radius_m = 50.0; ///< of the sphere
    double depth_m =
        50.0; ///< above 0, at most the radius; the rim's radius is sqrt(depth (2 radius - depth))
};
Terrain make_pit(const PitOptions& options);

/// ground + height exp(-r^2 / (2 sigma^2)). A negative height makes a hollow.
struct GaussianHillOptions {
    SampleGrid grid = {};
    double ground_m = 0.0;
    double height_m = 50.0;
    double sigma_m = 50.0;
};
Terrain make_gaussian_hill(const GaussianHillOptions& options);

/// A straight valley with two even sides, level ground beyond.
struct ValleyOptions {
    SampleGrid grid = {};
    double bottom_m = 0.0;
    Angle course = {};                                        ///< the direction it runs in; 0 is north-south
    Angle slope = Angle::from_degrees(30.0);                  ///< of its sides, 0 to below 90 degrees
    double depth_m = std::numeric_limits<double>::infinity(); ///< of the bottom under the level ground
};
Terrain make_valley(const ValleyOptions& options);

/// Fractal mountains: folded gradient noise, summed over octaves from `feature_m` down to twice the cell; an
/// octave counts the more the higher the ground is already, so that peaks are rugged and valleys smooth.
///
/// The height at a place depends on the place, the seed and the lengths alone: a smaller grid shows the
/// middle of a larger one. Nothing but basic arithmetic and integer hashes is used: the same bits on every
/// machine. Cost: some 0.2 microseconds a cell. Source: Perlin, Improving noise, 2002; Musgrave, ridged
/// multifractal, in Texturing and Modeling, 1994.
struct MountainsOptions {
    SampleGrid grid = {};
    std::uint64_t seed = 1;
    double lowest_m = 0.0;     ///< nothing lies lower
    double height_m = 2500.0;  ///< nothing lies higher above the lowest; peaks reach about 0.9 of it
    double feature_m = 8000.0; ///< distance from range to range
    double roughness = 0.45;   ///< each octave's height over that of the one twice as wide, 0 to 1
};
Terrain make_mountains(const MountainsOptions& options, const Execution& execution = {});

} // namespace duskline
