#pragma once

#include <duskline/raster_io/read_height_field.h>

#include <cstdint>
#include <optional>
#include <span>

namespace duskline {

/// How stored numbers become heights.
struct Cleaning {
    std::optional<float> declared_no_data;
    std::optional<float> more_no_data; ///< asked for by the user
    float factor = 1.0F;               ///< height = stored * factor + shift
    float shift = 0.0F;
};

/// Turns stored numbers into heights where they lie; NaN where there is no data (HeightFile::read says what
/// that is). Counts into `tally`.
void clean_heights(std::span<float> values, const Cleaning& how, ReadTally& tally);

/// NaN wherever the mask is 0.
void apply_mask(std::span<float> heights, std::span<const std::uint8_t> mask, ReadTally& tally);

} // namespace duskline
