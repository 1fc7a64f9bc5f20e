#include "raster_io/made_raster.h"

#include <duskline/geometry/invalid_input.h>
#include <duskline/raster_io/file_errors.h>
#include <duskline/raster_io/write_animation.h>

#include <gtest/gtest.h>
#include <webp/demux.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>

namespace duskline {
namespace {

using WriteAnimation = raster_test::FolderTest;

std::vector<Grid<std::uint8_t>> greys(const std::vector<int>& values)
{
    std::vector<Grid<std::uint8_t>> frames;
    for (const int value : values)
        frames.emplace_back(20, 30, static_cast<std::uint8_t>(value));
    return frames;
}

struct Shown {
    int grey = 0; ///< of the middle pixel
    int until_ms = 0;
};

struct Film {
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    std::uint32_t loops = 1;
    std::vector<Shown> frames;
};

Film read(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    const WebPData data = {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
    const std::unique_ptr<WebPAnimDecoder, decltype(&WebPAnimDecoderDelete)> decoder(
        WebPAnimDecoderNew(&data, nullptr), WebPAnimDecoderDelete);
    WebPAnimInfo info = {};
    WebPAnimDecoderGetInfo(decoder.get(), &info);
    Film film = {info.canvas_width, info.canvas_height, info.loop_count, {}};
    while (WebPAnimDecoderHasMoreFrames(decoder.get()) != 0) {
        std::uint8_t* pixels = nullptr;
        Shown shown;
        WebPAnimDecoderGetNext(decoder.get(), &pixels, &shown.until_ms);
        shown.grey = pixels[4U * (info.canvas_height / 2 * info.canvas_width + info.canvas_width / 2)];
        film.frames.push_back(shown);
    }
    return film;
}

TEST_F(WriteAnimation, ShowsItsFramesOneAfterTheOtherForEver)
{
    write_animation(path("film.webp"), greys({0, 200, 90}), {.seconds_a_frame = 0.25});
    const Film film = read(path("film.webp"));
    EXPECT_EQ(film.columns, 30U);
    EXPECT_EQ(film.rows, 20U);
    EXPECT_EQ(film.loops, 0U) << "0 is for ever";
    ASSERT_EQ(film.frames.size(), 3U);
    EXPECT_NEAR(film.frames[0].grey, 0, 6);
    EXPECT_NEAR(film.frames[1].grey, 200, 6);
    EXPECT_NEAR(film.frames[2].grey, 90, 6);
    EXPECT_EQ(film.frames[0].until_ms, 250);
    EXPECT_EQ(film.frames[2].until_ms, 750);
}

TEST_F(WriteAnimation, ReplacesNothingUnasked)
{
    write_animation(path("film.webp"), greys({0, 200}));
    EXPECT_THROW(write_animation(path("film.webp"), greys({0, 200})), OutputError);
    write_animation(path("film.webp"), greys({0, 200, 50}), {.overwrite = true});
    EXPECT_EQ(read(path("film.webp")).frames.size(), 3U);
}

TEST_F(WriteAnimation, RefusesWhatIsNoFilm)
{
    EXPECT_THROW(write_animation(path("film.webp"), {}), InvalidInput);
    auto frames = greys({0, 200});
    frames.emplace_back(20, 31, std::uint8_t{0});
    EXPECT_THROW(write_animation(path("film.webp"), frames), InvalidInput);
    std::vector<Grid<std::uint8_t>> wide;
    wide.emplace_back(1, 16384, std::uint8_t{0});
    EXPECT_THROW(write_animation(path("film.webp"), wide), InvalidInput);
    EXPECT_THROW(write_animation(path("film.webp"), greys({0}), {.seconds_a_frame = 0.0}), InvalidInput);
    EXPECT_THROW(write_animation(path("film.webp"), greys({0}), {.quality = 101.0f}), InvalidInput);
    EXPECT_THROW(write_animation(path("no/folder/film.webp"), greys({0})), OutputError);
    EXPECT_TRUE(files().empty());
}

} // namespace
} // namespace duskline
