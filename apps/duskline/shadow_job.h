#pragma once

#include "shadow_codes.h"

#include <duskline/casting/casters.h>
#include <duskline/execution/progress.h>
#include <duskline/light/directional_light.h>
#include <duskline/light/point_light.h>
#include <duskline/raster_io/raster_writer.h>
#include <duskline/raster_io/read_height_field.h>
#include <duskline/terrain/earth_curvature.h>

#include <cstddef>
#include <vector>

namespace duskline::cli {

/// What `duskline shadow` writes.
enum class ShadowResult {
    mask,
    classes,
    heights,
    lamp_count,
    soft,      ///< the share of the light's disc that is seen
    antialias, ///< the share of a cell's area that is lit
};

/// Whether it is real numbers, not codes, and which of those are shares from 0 to 1.
bool is_real(ShadowResult result);
bool is_share(ShadowResult result);

/// Written for cells without data in a raster of shadow heights or shares.
constexpr float kNoHeight = -9999.0f;

/// Everything there is to know once the options are settled.
struct ShadowJob {
    HeightFile& file;
    RasterWriter& writer;
    DirectionalLight light;
    std::vector<PointLight> lamps; ///< instead of `light`, unless there are none
    EarthCurvature curvature;
    const Caster& caster;
    ShadowResult result = ShadowResult::mask;
    MaskCodes codes;
    Execution execution;
    std::size_t memory_bytes = 0; ///< that `cast_in_windows` may take, about
};

struct ShadowOutcome {
    LitCount count;
    double reading_s = 0.0; ///< stages of a stream overlap: these are the times of each, not parts of a whole
    double casting_s = 0.0;
    double writing_s = 0.0;
};

/// Memory that such a result, its heights and its caster take, a cell.
double bytes_per_cell(const Caster& caster, ShadowResult result, std::size_t lamps);

/// Throws UnsupportedOnThisMachine when `cast_whole` needs more memory than there is.
void require_memory_for_whole(const HeightFile& file, const Caster& caster, ShadowResult result,
                              std::size_t lamps);

/// Reads all heights, casts, writes. Every caster and result. Throws what reading, casting and writing throw.
ShadowOutcome cast_whole(const ShadowJob& job);

/// Whether `cast_in_stream` can do such a job.
bool can_stream(const Caster& caster, ShadowResult result);

/// Casts the file from block to block in the order the light meets them, reading, casting and writing at the
/// same time. Needs memory for a few blocks of lines only. The same bytes as `cast_whole`.
ShadowOutcome cast_in_stream(const ShadowJob& job);

/// Throws UnsupportedOnThisMachine when not even the smallest window fits. For before anything is read or made.
void require_memory_for_windows(const HeightFile& file, const DirectionalLight& light, const Caster& caster,
                                ShadowResult result, double memory_bytes);

/// Casts `light` window by window, each with the ground that can shade it, so that what is in memory at a time fits
/// `memory_bytes`. Every caster and result but lamps. The same bytes as `cast_whole`; the file is read twice and
/// more. Throws UnsupportedOnThisMachine when shadows are so long that a single slab needs more.
ShadowOutcome cast_in_windows(const ShadowJob& job);

/// Shadow heights as they are written, where those that were cast are: at least the ground, in the file's unit
/// and counted from its zero, the earth's curvature put back. `ground_m` are the lowered heights they were cast
/// on; `own_m` those of the file, which lit cells get back to the bit.
void finish_shadow_heights(const ShadowJob& job, GridView<const float> own_m, GridView<const float> ground_m,
                           GridView<float> shadow_m, std::size_t first_row, std::size_t first_column);

/// Which cells are lit, by their shadow heights as cast.
void count_into(LitCount& count, GridView<const float> ground_m, GridView<const float> shadow_m);

} // namespace duskline::cli
