#include <duskline/products/palette.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace duskline {
namespace {

using testing::HasSubstr;

// The sRGB bytes, with fractions, of a palette at a height.
std::array<float, 3> srgb_at(const Palette& palette, float height_m)
{
    const Colour c = palette.at(height_m).colour;
    return {255.0f * srgb_from_linear(c.red), 255.0f * srgb_from_linear(c.green),
            255.0f * srgb_from_linear(c.blue)};
}

void expect_srgb(const Palette& palette, float height_m, std::array<float, 3> expected, float tolerance)
{
    const auto found = srgb_at(palette, height_m);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(found[i], expected[i], tolerance) << "channel " << i << " at " << height_m << " m";
}

TEST(Palette, IsLinearInLightBetweenEntriesAndConstantBeyond)
{
    const Palette palette({{100.0, {1.0f, 0.0f, 0.2f}, 1.0f}, {0.0, {0.0f, 0.4f, 0.2f}, 0.0f}});
    EXPECT_EQ(palette.at(-5.0f).colour, (Colour{0.0f, 0.4f, 0.2f}));
    EXPECT_EQ(palette.at(500.0f).colour, (Colour{1.0f, 0.0f, 0.2f}));
    EXPECT_FLOAT_EQ(palette.at(25.0f).colour.red, 0.25f);
    EXPECT_FLOAT_EQ(palette.at(25.0f).colour.green, 0.3f);
    EXPECT_FLOAT_EQ(palette.at(25.0f).opacity, 0.25f);
}

TEST(Palette, TwoEntriesOfOneHeightMakeAHardEdge)
{
    const Colour sea = {0.0f, 0.0f, 1.0f};
    const Colour land = {0.0f, 1.0f, 0.0f};
    const Palette palette({{-10.0, sea, 1.0f}, {0.0, sea, 1.0f}, {0.0, land, 1.0f}, {10.0, land, 1.0f}});
    EXPECT_EQ(palette.at(-0.001f).colour, sea);
    EXPECT_EQ(palette.at(0.0f).colour, land);
}

TEST(Palette, RefusesNothingAndNotANumber)
{
    EXPECT_THROW(Palette(std::vector<Palette::Entry>{}), InvalidInput);
    EXPECT_THROW(Palette({{std::numeric_limits<double>::quiet_NaN(), {}, 1.0f}}), InvalidInput);
}

TEST(PaletteFromText, ReadsWhatGdaldemReads)
{
    const Palette palette = palette_from_text("# heights of an island\n"
                                              "0 10 20 30\n"
                                              "  50%,\t110:120:130 , 255  # half-way up\r\n"
                                              "\n"
                                              "1000 WHITE\n"
                                              "nv 1 2 3 4",
                                              0.0, 800.0);
    expect_srgb(palette, 0.0f, {10.0f, 20.0f, 30.0f}, 0.01f);
    expect_srgb(palette, 400.0f, {110.0f, 120.0f, 130.0f}, 0.01f);
    expect_srgb(palette, 1000.0f, {255.0f, 255.0f, 255.0f}, 0.01f);
    ASSERT_TRUE(palette.no_data.has_value());
    EXPECT_EQ(*palette.no_data, (Rgba8{1, 2, 3, 4}));
}

TEST(PaletteFromText, IsLinearInSrgbBetweenEntriesAsGdaldemIs)
{
    const Palette palette = palette_from_text("0 0 0 0\n100 255 100 0\n", 0.0, 100.0);
    for (float height_m = 0.0f; height_m <= 100.0f; height_m += 0.5f)
        expect_srgb(palette, height_m, {2.55f * height_m, height_m, 0.0f}, 0.7f);
}

TEST(PaletteFromText, KeepsOpacityAndOrderOfLinesDoesNotMatter)
{
    const Palette palette = palette_from_text("100 0 0 255 255\n0 0 0 255 0\n", 0.0, 100.0);
    EXPECT_FLOAT_EQ(palette.at(50.0f).opacity, 0.5f);
    EXPECT_FALSE(palette.no_data.has_value());
}

TEST(PaletteFromText, SaysWhichLineIsWrongAndWhy)
{
    const auto message = [](std::string_view text) {
        try {
            palette_from_text(text, 0.0, 1.0);
        } catch (const InvalidInput& error) {
            return std::string(error.what());
        }
        return std::string("nothing");
    };
    EXPECT_THAT(message("0 0 0 0\n10 300 0 0"), HasSubstr("line 2 of the palette: '300'"));
    EXPECT_THAT(message("0 0 0"), HasSubstr("'3 words'"));
    EXPECT_THAT(message("0 -1 0 0"), HasSubstr("'-1' is not a number from 0 to 255"));
    EXPECT_THAT(message("0 0 0 nan"), HasSubstr("'nan'"));
    EXPECT_THAT(message("\n\nhigh 0 0 0"), HasSubstr("line 3 of the palette: 'high' is not a height"));
    EXPECT_THAT(message("0 mauve"), HasSubstr("'mauve' is not a colour's name"));
    EXPECT_THAT(message("# nothing but words\n"), HasSubstr("has no entries"));
    EXPECT_THAT(message("nv 0 0 0"), HasSubstr("has no entries"));
    EXPECT_THAT(message(""), HasSubstr("has no entries"));
}

} // namespace
} // namespace duskline
