#include <duskline/execution/for_rows.h>
#include <duskline/products/colour.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace duskline {

float linear_from_srgb(float encoded)
{
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

float srgb_from_linear(float linear)
{
    return linear <= 0.0031308f ? linear * 12.92f : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

Colour colour_from_srgb(double red, double green, double blue)
{
    const auto linear = [](double byte) { return linear_from_srgb(static_cast<float>(byte / 255.0)); };
    return {linear(red), linear(green), linear(blue)};
}

Colour colour_from_hex(std::uint32_t rgb)
{
    return colour_from_srgb(rgb >> 16 & 255U, rgb >> 8 & 255U, rgb & 255U);
}

Oklab oklab_from(Colour c)
{
    const double r = c.red;
    const double g = c.green;
    const double b = c.blue;
    const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
    const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
    const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
    return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
            1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
            0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

Colour colour_from(const Oklab& o)
{
    const auto cube = [](double x) { return x * x * x; };
    const double l = cube(o.lightness + 0.3963377774 * o.a + 0.2158037573 * o.b);
    const double m = cube(o.lightness - 0.1055613458 * o.a - 0.0638541728 * o.b);
    const double s = cube(o.lightness - 0.0894841775 * o.a - 1.2914855480 * o.b);
    const auto positive = [](double x) { return static_cast<float>(std::max(0.0, x)); };
    return {positive(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
            positive(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
            positive(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

namespace {

// A fraction in [0, 1) that looks random from pixel to pixel: row and column, stirred by the finaliser of
// MurmurHash3 (Appleby 2011).
float noise(std::size_t row, std::size_t column)
{
    auto bits =
        static_cast<std::uint32_t>(row) * 0x9E3779B1U ^ static_cast<std::uint32_t>(column) * 0x85EBCA77U;
    bits = (bits ^ (bits >> 16)) * 0x85EBCA6BU;
    bits = (bits ^ (bits >> 13)) * 0xC2B2AE35U;
    bits ^= bits >> 16;
    return static_cast<float>(bits >> 8) * 0x1p-24F;
}

} // namespace

// Steps of equal square root: fine in the dark, where the curve is steep.
SrgbEncoder::SrgbEncoder()
{
    for (std::size_t i = 0; i < table_.size(); ++i) {
        const float root = std::min(1.0f, static_cast<float>(i) / static_cast<float>(kSteps));
        table_[i] = 255.0f * srgb_from_linear(root * root);
    }
}

float SrgbEncoder::encode(float linear) const
{
    const float place = std::sqrt(std::clamp(linear, 0.0f, 1.0f)) * static_cast<float>(kSteps);
    const auto below = static_cast<std::size_t>(place);
    return table_[below] + (table_[below + 1] - table_[below]) * (place - static_cast<float>(below));
}

Rgba8 SrgbEncoder::pixel(Colour light, std::size_t row, std::size_t column) const
{
    const float dither = noise(row, column);
    const auto byte = [&](float linear) {
        return static_cast<std::uint8_t>(std::min(255.0f, encode(linear) + dither));
    };
    return {byte(light.red), byte(light.green), byte(light.blue), 255};
}

SrgbDecoder::SrgbDecoder()
{
    for (std::size_t i = 0; i < table_.size(); ++i)
        table_[i] = linear_from_srgb(static_cast<float>(i) / 255.0f);
}

namespace {

// The pixels of a side that lie under one pixel of the shrunk side, the first and last perhaps in part.
struct Footprint {
    std::size_t first;
    std::size_t last;
    double begin;
    double end;

    float weight(std::size_t i) const
    {
        const auto low = std::max(begin, static_cast<double>(i));
        return static_cast<float>(std::min(end, static_cast<double>(i) + 1.0) - low);
    }
};

Footprint footprint(std::size_t i, std::size_t shrunk_side, std::size_t side)
{
    const double scale = static_cast<double>(side) / static_cast<double>(shrunk_side);
    const double begin = static_cast<double>(i) * scale;
    const double end = std::min(static_cast<double>(side), static_cast<double>(i + 1) * scale);
    const auto last = static_cast<std::size_t>(std::ceil(end)) - 1;
    return {static_cast<std::size_t>(begin), std::min(last, side - 1), begin, end};
}

struct Average {
    Colour light;
    float opacity = 0.0f;
    float area = 0.0f;
};

Average average(const Picture& picture, const Footprint& down, const Footprint& across,
                const SrgbDecoder& decoder)
{
    Average sum;
    for (std::size_t y = down.first; y <= down.last; ++y)
        for (std::size_t x = across.first; x <= across.last; ++x) {
            const float weight = down.weight(y) * across.weight(x);
            const Rgba8& pixel = picture(y, x);
            const float opacity = weight * static_cast<float>(pixel[3]) / 255.0f;
            sum.light = sum.light + decoder.colour(pixel) * opacity;
            sum.opacity += opacity;
            sum.area += weight;
        }
    return sum;
}

void require_smaller(const char* what, std::size_t wanted, std::size_t most)
{
    if (!(wanted >= 1 && wanted <= most))
        throw InvalidInput(std::string(what) + " of the shrunk picture must be from 1 to "
                           + std::to_string(most) + ", got " + std::to_string(wanted));
}

} // namespace

Picture shrunk(const Picture& picture, std::size_t rows, std::size_t columns, const Execution& execution)
{
    require_smaller("rows", rows, picture.rows());
    require_smaller("columns", columns, picture.columns());
    const SrgbDecoder decoder;
    const SrgbEncoder encoder;
    Picture result(rows, columns);
    for_rows(rows, 16, execution, [&](std::size_t first, std::size_t last) {
        for (std::size_t y = first; y < last; ++y)
            for (std::size_t x = 0; x < columns; ++x) {
                const Average sum = average(picture, footprint(y, rows, picture.rows()),
                                            footprint(x, columns, picture.columns()), decoder);
                if (!(sum.opacity > 0.0f)) {
                    result(y, x) = {0, 0, 0, 0};
                    continue;
                }
                result(y, x) = encoder.pixel(sum.light * (1.0f / sum.opacity), y, x);
                result(y, x)[3] = static_cast<std::uint8_t>(std::lround(255.0f * sum.opacity / sum.area));
            }
    });
    return result;
}

} // namespace duskline
