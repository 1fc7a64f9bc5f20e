#include "light_pixels.h"

#include "exit_code.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace duskline::cli {
namespace {

// Of a cell, 0 to 1; nothing where there is no data.
float opacity_at(const LightPixels& pixels, std::size_t row, std::size_t column)
{
    if (std::isnan(pixels.map.channels.front()(row, column)))
        return 0.0f;
    return pixels.texture.empty() ? 1.0f : static_cast<float>(pixels.texture(row, column)[3]) / 255.0f;
}

float light_at(const LightPixels& pixels, std::size_t channel, std::size_t row, std::size_t column)
{
    const std::size_t last = pixels.map.channels.size() - 1;
    const float light = pixels.map.channels[std::min(channel, last)](row, column);
    if (!pixels.over_white)
        return light;
    const float opacity = opacity_at(pixels, row, column);
    return opacity > 0.0f ? 1.0f + opacity * (light - 1.0f) : 1.0f;
}

template <typename Sample>
Sample sample_of(float light, float opacity)
{
    if constexpr (std::is_same_v<Sample, float>)
        return opacity > 0.0f ? light : kNoLight;
    else
        return light_sample<Sample>(light);
}

template <typename Sample, std::size_t Bands>
using Pixel = std::conditional_t<Bands == 1, Sample, std::array<Sample, Bands>>;

// Two or four bands are one or three of light, and opacity.
template <typename Sample, std::size_t Bands>
Pixel<Sample, Bands> pixel_at(const LightPixels& pixels, std::size_t row, std::size_t column)
{
    const float opacity = opacity_at(pixels, row, column);
    const auto sample = [&](std::size_t channel) {
        return sample_of<Sample>(light_at(pixels, channel, row, column), opacity);
    };
    if constexpr (Bands == 1) {
        return sample(0);
    } else {
        constexpr std::size_t lights = Bands < 3 ? 1 : 3;
        Pixel<Sample, Bands> pixel = {};
        for (std::size_t channel = 0; channel < lights; ++channel)
            pixel[channel] = sample(channel);
        if constexpr (Bands > lights)
            pixel[lights] = light_sample<Sample>(opacity);
        return pixel;
    }
}

// In bands of rows, so that the progress moves and an interruption is heard.
template <typename Sample, std::size_t Bands>
void write_all(RasterWriter& writer, const LightPixels& pixels, const ProgressCallback& progress)
{
    const std::size_t rows = pixels.map.channels.front().rows();
    const std::size_t columns = pixels.map.channels.front().columns();
    const std::size_t band = std::max<std::size_t>(writer.block_rows(), 256);
    for (std::size_t first = 0; first < rows; first += band) {
        Grid<Pixel<Sample, Bands>> part(std::min(band, rows - first), columns);
        for (std::size_t y = 0; y < part.rows(); ++y)
            for (std::size_t x = 0; x < columns; ++x)
                part(y, x) = pixel_at<Sample, Bands>(pixels, first + y, x);
        writer.write(first, 0, GridView<const Pixel<Sample, Bands>>(part.view()));
        if (!progress(static_cast<double>(first + part.rows()) / static_cast<double>(rows)))
            throw Cancelled();
    }
}

} // namespace

SampleDepth parse_depth(const std::string& text)
{
    if (text == "Byte")
        return SampleDepth::byte;
    if (text == "UInt16")
        return SampleDepth::word;
    if (text == "Float32")
        return SampleDepth::real;
    throw UsageError(fmt::format("--ot must be Byte, UInt16 or Float32, got '{}'", text));
}

bool is_opaque(const LightPixels& pixels)
{
    const Grid<float>& light = pixels.map.channels.front();
    for (std::size_t y = 0; y < light.rows(); ++y)
        for (std::size_t x = 0; x < light.columns(); ++x)
            if (opacity_at(pixels, y, x) < 1.0f)
                return false;
    return true;
}

Samples samples_of(const LightPixels& pixels, bool opacity)
{
    const bool grey = pixels.map.channels.size() == 1;
    switch (pixels.depth) {
    case SampleDepth::real:
        return grey ? Samples::real : Samples::rgb_reals;
    case SampleDepth::word:
        if (opacity)
            return grey ? Samples::word_alpha : Samples::rgba_words;
        return grey ? Samples::word : Samples::rgb_words;
    case SampleDepth::byte:
        break;
    }
    if (opacity)
        return grey ? Samples::byte_alpha : Samples::rgba;
    return grey ? Samples::byte : Samples::rgb;
}

void write_pixels(RasterWriter& writer, const LightPixels& pixels, Samples samples,
                  const ProgressCallback& progress)
{
    switch (samples) {
    case Samples::byte:
        return write_all<std::uint8_t, 1>(writer, pixels, progress);
    case Samples::byte_alpha:
        return write_all<std::uint8_t, 2>(writer, pixels, progress);
    case Samples::rgb:
        return write_all<std::uint8_t, 3>(writer, pixels, progress);
    case Samples::rgba:
        return write_all<std::uint8_t, 4>(writer, pixels, progress);
    case Samples::word:
        return write_all<std::uint16_t, 1>(writer, pixels, progress);
    case Samples::word_alpha:
        return write_all<std::uint16_t, 2>(writer, pixels, progress);
    case Samples::rgb_words:
        return write_all<std::uint16_t, 3>(writer, pixels, progress);
    case Samples::rgba_words:
        return write_all<std::uint16_t, 4>(writer, pixels, progress);
    case Samples::real:
        return write_all<float, 1>(writer, pixels, progress);
    case Samples::rgb_reals:
        return write_all<float, 3>(writer, pixels, progress);
    }
}

void fill_colours(const LightPixels& pixels, std::size_t row, std::span<std::array<std::uint8_t, 3>> out)
{
    for (std::size_t x = 0; x < out.size(); ++x)
        out[x] = pixel_at<std::uint8_t, 3>(pixels, row, x);
}

} // namespace duskline::cli
