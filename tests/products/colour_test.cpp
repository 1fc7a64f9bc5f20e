#include <duskline/products/colour.h>

#include <gtest/gtest.h>

#include <cmath>

namespace duskline {
namespace {

TEST(Colour, TheCurveOfSrgbHasItsKnownValuesAndComesBack)
{
    EXPECT_NEAR(linear_from_srgb(0.5f), 0.214041f, 1e-6f);
    EXPECT_NEAR(srgb_from_linear(0.18f), 0.461356f, 1e-6f);
    for (int byte = 0; byte <= 255; ++byte) {
        const auto encoded = static_cast<float>(byte) / 255.0f;
        EXPECT_NEAR(srgb_from_linear(linear_from_srgb(encoded)), encoded, 1e-5f) << byte;
    }
}

TEST(Colour, OklabHasThePublishedValuesOfItsAuthor)
{
    // Ottosson's table of XYZ to Oklab, for the white point, and red of sRGB.
    const Oklab white = oklab_from({1.0f, 1.0f, 1.0f});
    EXPECT_NEAR(white.lightness, 1.0, 1e-4);
    EXPECT_NEAR(white.a, 0.0, 1e-4);
    EXPECT_NEAR(white.b, 0.0, 1e-4);
    const Oklab red = oklab_from({1.0f, 0.0f, 0.0f});
    EXPECT_NEAR(red.lightness, 0.6280, 1e-4);
    EXPECT_NEAR(red.a, 0.2249, 1e-4);
    EXPECT_NEAR(red.b, 0.1258, 1e-4);
}

TEST(Colour, OklabComesBackToTheColourItCameFrom)
{
    for (const std::uint32_t rgb : {0x000000U, 0x123456U, 0xFF0000U, 0x00FF80U, 0xE9E9E9U}) {
        const Colour colour = colour_from_hex(rgb);
        const Colour back = colour_from(oklab_from(colour));
        EXPECT_NEAR(back.red, colour.red, 1e-5f) << std::hex << rgb;
        EXPECT_NEAR(back.green, colour.green, 1e-5f) << std::hex << rgb;
        EXPECT_NEAR(back.blue, colour.blue, 1e-5f) << std::hex << rgb;
    }
}

TEST(SrgbEncoder, FollowsTheFormulaAndClampsBeyondIt)
{
    const SrgbEncoder encoder;
    for (int i = 0; i <= 100000; ++i) {
        const float linear = static_cast<float>(i) / 100000.0f;
        EXPECT_NEAR(encoder.encode(linear), 255.0f * srgb_from_linear(linear), 0.02f) << linear;
    }
    EXPECT_EQ(encoder.encode(-1.0f), 0.0f);
    EXPECT_EQ(encoder.encode(7.0f), encoder.encode(1.0f));
}

TEST(SrgbEncoder, DithersSoThatTheMeanOfManyPixelsIsTheColour)
{
    const SrgbEncoder encoder;
    const float linear = linear_from_srgb(100.3f / 255.0f);
    double sum = 0.0;
    for (std::size_t y = 0; y < 200; ++y)
        for (std::size_t x = 0; x < 200; ++x) {
            const Rgba8 pixel = encoder.pixel({linear, linear, linear}, y, x);
            EXPECT_TRUE(pixel[0] == 100 || pixel[0] == 101) << int{pixel[0]};
            sum += pixel[0];
        }
    EXPECT_NEAR(sum / 40000.0, 100.3, 0.03);
}

TEST(SrgbEncoder, GivesBackBytesThatWereDecoded)
{
    const SrgbEncoder encoder;
    const SrgbDecoder decoder;
    for (int byte = 0; byte <= 255; ++byte) {
        const auto b = static_cast<std::uint8_t>(byte);
        EXPECT_NEAR(encoder.encode(decoder.colour({b, b, b, 255}).green), static_cast<float>(byte), 0.02f);
    }
}

TEST(Shrunk, AveragesLightNotBytes)
{
    Picture picture(1, 2);
    picture(0, 0) = {255, 255, 255, 255};
    picture(0, 1) = {0, 0, 0, 255};
    const Rgba8 grey = shrunk(picture, 1, 1)(0, 0);
    EXPECT_NEAR(grey[0], 188, 1); // half of white's light, not 128
    EXPECT_EQ(grey[3], 255);
}

TEST(Shrunk, CountsPartsOfPixelsByTheirArea)
{
    Picture picture(1, 3);
    picture(0, 0) = {255, 255, 255, 255};
    picture(0, 1) = {0, 0, 0, 255};
    picture(0, 2) = {0, 0, 0, 255};
    const Picture two = shrunk(picture, 1, 2);
    EXPECT_NEAR(two(0, 0)[0], 255.0f * srgb_from_linear(2.0f / 3.0f), 1.0f);
    EXPECT_EQ(two(0, 1)[0], 0);
}

TEST(Shrunk, TransparentPixelsLendOpacityButNoColour)
{
    Picture picture(2, 2);
    picture(0, 0) = {200, 100, 50, 255};
    picture(0, 1) = picture(1, 0) = picture(1, 1) = {0, 0, 0, 0};
    const Rgba8 pixel = shrunk(picture, 1, 1)(0, 0);
    EXPECT_NEAR(pixel[0], 200, 1);
    EXPECT_NEAR(pixel[1], 100, 1);
    EXPECT_NEAR(pixel[2], 50, 1);
    EXPECT_EQ(pixel[3], 64);
    EXPECT_EQ(shrunk(Picture(4, 4, Rgba8{}), 2, 2)(1, 1), (Rgba8{0, 0, 0, 0}));
}

TEST(Shrunk, RefusesSizesThatAreNotSmaller)
{
    const Picture picture(4, 6, Rgba8{});
    EXPECT_THROW(shrunk(picture, 0, 3), InvalidInput);
    EXPECT_THROW(shrunk(picture, 5, 3), InvalidInput);
    EXPECT_THROW(shrunk(picture, 4, 7), InvalidInput);
    EXPECT_NO_THROW(shrunk(picture, 4, 6));
}

} // namespace
} // namespace duskline
