#pragma once

#include <duskline/casting/light_frame.h>
#include <duskline/casting/shadow_mask.h>
#include <duskline/execution/progress.h>
#include <duskline/geometry/vector.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace duskline {

/// How a silhouette map finds the next silhouette of each of its texels. What it leaves out may depend on it, shadows
/// do not. The two quad searches find the same.
enum class NextVSearch {
    binary,        ///< merge two blocks of lines into one, pass after pass
    quad,          ///< merge four: half the passes
    parallel_quad, ///< merge four, for four lines and many beams at a time: the fastest
};

struct SilhouetteMapOptions {
    NextVSearch search = NextVSearch::parallel_quad;

    /// Leave out of NextV silhouettes that cannot shadow the section, and those that the next one wholly covers.
    /// Without it NextV is the nearest silhouette of all. Changes no shadow, but how soon it is found.
    bool better_next_v = true;

    /// The SIMD level of that name (see `runnable_kernels`); else the best. Changes no bit.
    std::string_view isa = {};
};

/// One section of one line in a silhouette map, an int32 as a graphics card would hold it (R32I):
///
///   bit 0        Color: 1 Black, the section holds a silhouette; 0 White
///   bits 1-31    NextV + 1: the line nearer the light at which to look next; 0 where there is none
struct SilhouetteTexel {
    std::int32_t bits = 0;

    bool is_black() const { return (bits & 1) != 0; }
    bool has_next() const { return bits > 1; }
    std::int32_t next_v() const { return (bits >> 1) - 1; }

    bool operator==(const SilhouetteTexel&) const = default;
};

/// What a silhouette map knows of one line of its light frame.
struct SilhouetteLineFacts {
    std::int32_t shift = 0; ///< floor(lateral * v): whole cells by which beams have moved
    float part =
        0.0f; ///< and the part of a cell beyond, fract(lateral * v); above 1 - 1.2e-6 it is the next cell
    float tilt_m = 0.0f;     ///< drop_m * v: added to its heights, it makes light level
    float rounding_m = 0.0f; ///< by how much tilted heights of this line may be wrong, generously
};

/// How often a mask looks at the ground, and how much of the map is Black.
struct SilhouetteStatistics {
    std::size_t texels = 0;   ///< of the map
    std::size_t black = 0;    ///< those with a silhouette
    std::size_t cells = 0;    ///< with data
    std::size_t look_ups = 0; ///< crossings compared with a ray until all those cells have their answers
};

/// The shadows of a still sun, prepared to be asked for any points: the SMap of V. Sakalauskas, Hybrid Terrain Shadow
/// Ray Casting, WSCG 2008. Ground can only shadow a point where it is a silhouette, higher along the light than the
/// lines before and after; rays go from one line with a silhouette to the next and leave out all others.
///
/// **What is in shadow.** Only lines across the light count (rows or columns of the grid, see light_frame.h), heights
/// straight between the samples of a line. A point is in shadow when the ray from it towards the light is below one of
/// these lines, beyond its own, on its way to the border. This is `ray` without its lines along the light, computed by
/// the same code in double precision: where `ray` finds a shadow on a line, so does the map. No data casts nothing,
/// and is unknown in masks; the exception of `ray` for samples a millionth of a cell away holds here too.
///
/// **Texels.** texels() has as many rows as the frame has lines, v = 0 nearest the light, and one column more than a
/// line has cells. With u counting the cells of a line in the grid's own order, texel (v, x) is the section of line v
///
///     from  a = x - 1 + lines()[v].part   to  b = a + 1
///
/// and belongs to beam k = x - 1 - lines()[v].shift, which is in column x + lines()[w].shift - lines()[v].shift of
/// line w. A point at u of line v lies in column floor(u - lateral * v) + shift + 1. Texels whose section has no
/// ground are White.
///
/// **Which arithmetic decides.** Colours and NextV are decided in float, with no fused multiply-adds, in this order
/// (so that a shader declared `precise` gets the same bits); a comparison with NaN is false. Outside the grid, heights
/// are NaN. Let s(w, i) be sample u = x - 1 + shift(w) - shift(v) + i of line w, p(w) its `part`, and p(v) where there
/// is no line w. The five places of a section are t = 0, the three 1 - p(w) for w = v - 1, v, v + 1 in ascending
/// order, and 1. Line w is at place t of height, with q = t + p(w), i = q < 1 ? 0 : 1,
///
///     h(w, t) = s(w, i) + (s(w, i + 1) - s(w, i)) * (q - i)    or s(w, i), where q - i = 0
///     over_before(t) = (h(v, t) - h(v - 1, t)) + rise_m()      towards the light: !(over_before < 0)
///     over_after(t)  = (h(v, t) - h(v + 1, t)) + fall_m()      away from it:      !(over_after < 0)
///
/// A piece between neighbouring places t, t' is a silhouette when one end is both, or when t is towards, t' away, and
/// !(over_before(t) * over_after(t') < over_before(t') * over_after(t)), or the same with t and t' exchanged. Black is
/// a section with such a piece and with ground: s(v, 1), or s(v, 0) where p(v) < 1.2e-6.
/// Both rise_m() and fall_m() include the rounding of heights, so no silhouette is missed.
///
/// The ground of a section has bounds at its two ends. With first and last like h, from s(v, 0) and s(v, 1) on with
/// q - i = p(v), and bulge = s(v, 1) - (first + (last - first) * (1 - p(v))):
///
///     highest = (first or last + tilt_m) + ((bulge > 0 ? bulge : 0) + rounding_m)
///     lowest  = (first or last + tilt_m) - ((bulge < 0 ? -bulge : 0) + rounding_m)
///
/// c *cannot shadow* v when highest(c) <= lowest(v) at both ends. NextV begins as none everywhere. In passes D = 1, n,
/// n^2, ... below the number of lines (n = 2 for the binary search, else 4), every line v of every beam, from texels as
/// they were before the pass, does
///
///     for k = 0 .. (v / D mod n) - 1, while NextV(v) is none
///         w = v - v mod D - 1 - k D;   c = w where w is Black, else NextV(w)
///         while c is a line and cannot shadow v:   c = NextV(c)        (with better_next_v)
///         NextV(v) = c
///
/// and then once more, with better_next_v: while NextV(v) cannot shadow NextV(NextV(v)), NextV(v) becomes the latter.
///
/// Keeps a view of the heights: they must outlive it and stay as they were. Safe to ask from many threads. The same
/// bits for any number of threads and any SIMD level. Memory: 4 bytes a cell, and while it is built
/// some 20 bytes for each section of the 64 beams that a thread works on.
class SilhouetteMap {
public:
    /// Throws InvalidInput for angles or cell sizes out of range, for grids of more than 2^26 lines and for a SIMD
    /// level that there is not, Cancelled.
    /// Cost: O(cells log lines). A light at or below the horizon or straight overhead needs no texels, and has none.
    SilhouetteMap(const HeightField& field, const DirectionalLight& light,
                  const SilhouetteMapOptions& options = {}, const Execution& execution = {});

    /// Whether a point on or above the ground is in shadow. It may lie anywhere over the grid or beside it; with
    /// better_next_v nothing is promised under the ground. Throws InvalidInput for a place that is not finite or more
    /// than 2^52 cells away, and for a height of NaN. Cost: a few look-ups.
    bool is_shadowed(const GridPoint& point) const;

    /// The height under which a point above (row, column) is in shadow, metres, where that is above the ground;
    /// else some height not above it, minus infinity when nothing towards the light can shade it.
    double shadow_height_m(double row, double column) const;

    /// One answer per cell. Throws Cancelled.
    ShadowMask cast(const Execution& execution = {}) const;
    ShadowField shadow_heights(const Execution& execution = {}) const;

    /// One more cast, counted. Throws Cancelled.
    SilhouetteStatistics statistics(const Execution& execution = {}) const;

    const LightFrame& frame() const { return frame_; }
    GridView<const SilhouetteTexel> texels() const { return texels_.view(); }
    const std::vector<SilhouetteLineFacts>& lines() const { return lines_; }
    float rise_m() const { return rise_m_; }
    float fall_m() const { return fall_m_; }

private:
    class Query;

    HeightField field_;
    DirectionalLight light_;
    std::optional<Lit> uniform_;
    LightFrame frame_;
    std::vector<SilhouetteLineFacts> lines_;
    Grid<SilhouetteTexel> texels_;
    float rise_m_ = 0.0f;
    float fall_m_ = 0.0f;
};

/// `SilhouetteMap(field, light).cast()`: what the caster table calls `smap`.
ShadowMask cast_by_smap(const HeightField& field, const DirectionalLight& light,
                        const Execution& execution = {});
ShadowField shadow_heights_by_smap(const HeightField& field, const DirectionalLight& light,
                                   const Execution& execution = {});

/// The same answers without a map, by looking at every line on the way to the border or the first that is above the
/// ray: what the paper compares itself with. Slow: O(cells x lines).
ShadowMask cast_by_full_scan(const HeightField& field, const DirectionalLight& light,
                             const Execution& execution = {});

} // namespace duskline
