#pragma once

#include <duskline/casting/shadow_mask.h>
#include <duskline/execution/progress.h>
#include <duskline/geometry/vector.h>
#include <duskline/light/point_light.h>
#include <duskline/terrain/min_max_pyramid.h>

namespace duskline {

/// The truth: a straight march in double precision from every cell towards the light, past every crossing
/// with the lines along rows and columns of the grid-line surface.
///
/// A cell is in shadow when the surface is above the ray at a crossing beyond its start; where they touch
/// it is lit. The ray ends at the border of the grid: nothing out there casts. A crossing beside a sample
/// without data is skipped, unless it is within a millionth of a cell of the other one, which then counts
/// alone; the border is like a frame of no data, bit for bit. A light at or below the horizon lights
/// nothing.
///
/// The same bits for any number of threads, for a terrain and light turned by quarter turns or mirrored, and
/// for a window that holds all the ground the rays meet.
///
/// Throws InvalidInput for angles or cell sizes out of range, Cancelled. Slow: O(cells x shadow length).
ShadowMask cast_by_ray(const HeightField& field, const DirectionalLight& light,
                       const Execution& execution = {});

/// The shadow heights of the same march, rounded up to float: `mask_of` them is the mask.
ShadowField shadow_heights_by_ray(const HeightField& field, const DirectionalLight& light,
                                  const Execution& execution = {});

/// The same for a lamp: a march from every cell to it, past every crossing before it. What lies outside the grid
/// casts nothing, on the way to a lamp out there too. A lamp under the ground (`ground_height_m`), by more
/// than a micrometre, lights nothing; one on it does. A lamp within a billionth of a cell of a row or column of samples counts as on it, and the
/// cell right under a lamp is lit.
///
/// The same bits for any number of threads; for turned and mirrored terrains and lamps whose places turn exactly
/// (a fraction of a power of two). Throws InvalidInput for a place or cell size out of range, Cancelled.
ShadowMask cast_by_ray(const HeightField& field, const PointLight& light, const Execution& execution = {});

/// The shadow heights of that march: a point above a cell is in shadow when it lies lower. Plus infinity for a
/// lamp under the ground.
ShadowField shadow_heights_by_ray(const HeightField& field, const PointLight& light,
                                  const Execution& execution = {});

/// Rays over one terrain, made fast by a min/max pyramid that is built once: a ray climbs over whole
/// blocks of ground that cannot reach it. The same answers as the plain march, bit for bit, in a small
/// part of its time; the way to ask about single points, and about points above the ground.
///
/// Keeps a view of the heights: they must outlive it and stay as they were. Safe to ask from many threads.
/// Source: Tevs, Ihrke and Seidel, Maximum mipmaps for fast, accurate, and scalable dynamic height field
/// rendering, I3D 2008.
class TerrainRays {
public:
    /// Builds the pyramid: one pass over the heights, and two thirds of their memory. Throws InvalidInput for
    /// cell sizes out of range, Cancelled.
    explicit TerrainRays(const HeightField& field, const Execution& execution = {});

    /// The height under which a point above (row, column) is in shadow, metres; minus infinity when nothing
    /// towards the light can shade it, plus infinity for a light at or below the horizon or under the ground.
    /// Row and column
    /// may be fractions, and may lie outside the grid: what the ray meets is what counts. The start itself
    /// does not: a point is never shaded by the ground right under it. Throws InvalidInput for a place that
    /// is not finite or more than 2^52 cells away, or angles out of range. Takes about a microsecond.
    double shadow_height_m(double row, double column, const DirectionalLight& light) const;
    double shadow_height_m(double row, double column, const PointLight& light) const;

    /// Whether a point on or above the ground is in shadow. Throws as shadow_height_m, and for a height of
    /// NaN.
    bool is_shadowed(const GridPoint& point, const DirectionalLight& light) const;
    bool is_shadowed(const GridPoint& point, const PointLight& light) const;

    /// `cast_by_ray` and `shadow_heights_by_ray` through the pyramid: the same bytes.
    ShadowMask cast(const DirectionalLight& light, const Execution& execution = {}) const;
    ShadowField shadow_heights(const DirectionalLight& light, const Execution& execution = {}) const;
    ShadowMask cast(const PointLight& light, const Execution& execution = {}) const;
    ShadowField shadow_heights(const PointLight& light, const Execution& execution = {}) const;

private:
    HeightField field_;
    MinMaxPyramid pyramid_;
};

/// `TerrainRays(field).cast(light)`: what the caster table calls `fast-ray`.
ShadowMask cast_by_fast_ray(const HeightField& field, const DirectionalLight& light,
                            const Execution& execution = {});
ShadowField shadow_heights_by_fast_ray(const HeightField& field, const DirectionalLight& light,
                                       const Execution& execution = {});

ShadowMask cast_by_fast_ray(const HeightField& field, const PointLight& light,
                            const Execution& execution = {});
ShadowField shadow_heights_by_fast_ray(const HeightField& field, const PointLight& light,
                                       const Execution& execution = {});

} // namespace duskline
