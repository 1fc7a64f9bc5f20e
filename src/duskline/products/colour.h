#pragma once

#include <duskline/execution/progress.h>
#include <duskline/geometry/grid.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace duskline {

/// A colour in linear light with the primaries of sRGB (ITU-R BT.709): amounts of light, which may be
/// added, averaged and multiplied. 0 is black, 1 the white of a screen; lit slopes may go beyond.
struct Colour {
    float red = 0.0f;
    float green = 0.0f;
    float blue = 0.0f;

    constexpr Colour operator+(Colour o) const { return {red + o.red, green + o.green, blue + o.blue}; }
    constexpr Colour operator-(Colour o) const { return {red - o.red, green - o.green, blue - o.blue}; }
    constexpr Colour operator*(Colour o) const { return {red * o.red, green * o.green, blue * o.blue}; }
    constexpr Colour operator*(float s) const { return {red * s, green * s, blue * s}; }
    constexpr bool operator==(const Colour&) const = default;
};

/// `a` at t = 0, `b` at t = 1.
constexpr Colour mix(Colour a, Colour b, float t)
{
    return a + (b - a) * t;
}

/// Relative luminance, ITU-R BT.709.
constexpr float luminance(Colour c)
{
    return 0.2126f * c.red + 0.7152f * c.green + 0.0722f * c.blue;
}

/// A pixel of a picture: red, green and blue as sRGB bytes (not premultiplied), and opacity: 0 where there is
/// no data.
using Rgba8 = std::array<std::uint8_t, 4>;

/// A picture, row 0 on top.
using Picture = Grid<Rgba8>;

/// The transfer curve of sRGB (IEC 61966-2-1), both ways, for values in [0, 1].
float linear_from_srgb(float encoded);
float srgb_from_linear(float linear);

/// The light of a colour given as sRGB, 0 to 255 each.
Colour colour_from_srgb(double red, double green, double blue);

/// The same, from 0xRRGGBB.
Colour colour_from_hex(std::uint32_t rgb);

/// A colour where equal steps look equal: lightness from 0 (black) to 1 (white) and two opponent axes.
/// Source: Björn Ottosson, A perceptual color space for image processing, 2020.
struct Oklab {
    double lightness = 0.0;
    double a = 0.0; ///< green to red
    double b = 0.0; ///< blue to yellow
};
Oklab oklab_from(Colour colour);

/// Back again. What lies outside the colours of a screen is cut off at 0.
Colour colour_from(const Oklab& oklab);

/// Light to bytes. Where a colour falls between two bytes, a fixed noise decides for each pixel, in
/// proportion, which of them it gets, so that smooth gradients show no bands. The noise depends on nothing
/// but row and column.
class SrgbEncoder {
public:
    SrgbEncoder();

    /// 255 times `srgb_from_linear`, clamped, within 0.02 of the formula.
    float encode(float linear) const;

    /// The pixel at (row, column), opaque.
    Rgba8 pixel(Colour light, std::size_t row, std::size_t column) const;

private:
    static constexpr std::size_t kSteps = 2048;
    std::array<float, kSteps + 2> table_ = {};
};

/// Bytes to light.
class SrgbDecoder {
public:
    SrgbDecoder();

    Colour colour(const Rgba8& pixel) const { return {table_[pixel[0]], table_[pixel[1]], table_[pixel[2]]}; }

private:
    std::array<float, 256> table_ = {};
};

/// The picture made smaller: each pixel is the average of the light under it, parts of pixels counted by
/// their area, transparent ones only in its opacity. One pass; the same bytes for any number of threads.
///
/// Throws InvalidInput unless 1 <= rows <= picture.rows() and 1 <= columns <= picture.columns(), Cancelled.
Picture shrunk(const Picture& picture, std::size_t rows, std::size_t columns,
               const Execution& execution = {});

} // namespace duskline
