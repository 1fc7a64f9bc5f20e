#include <duskline/geometry/invalid_input.h>
#include <duskline/raster_io/file_errors.h>
#include <duskline/raster_io/staged_output.h>
#include <duskline/raster_io/write_animation.h>

#include <webp/encode.h>
#include <webp/mux.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>

namespace duskline {

namespace {

constexpr std::size_t kLongestWebpSide = 16383;

struct EncoderCloser {
    void operator()(WebPAnimEncoder* encoder) const { WebPAnimEncoderDelete(encoder); }
};
using Encoder = std::unique_ptr<WebPAnimEncoder, EncoderCloser>;

// A frame as WebP takes it.
class WebpPicture {
public:
    explicit WebpPicture(const Grid<std::uint8_t>& frame)
    {
        WebPPictureInit(&picture_);
        picture_.use_argb = 1;
        picture_.width = static_cast<int>(frame.columns());
        picture_.height = static_cast<int>(frame.rows());
        if (WebPPictureAlloc(&picture_) == 0)
            throw std::bad_alloc();
        for (std::size_t y = 0; y < frame.rows(); ++y)
            std::ranges::transform(frame.row(y),
                                   picture_.argb + y * static_cast<std::size_t>(picture_.argb_stride),
                                   [](std::uint8_t grey) { return 0xff000000U | 0x010101U * grey; });
    }
    ~WebpPicture() { WebPPictureFree(&picture_); }
    WebpPicture(const WebpPicture&) = delete;
    WebpPicture& operator=(const WebpPicture&) = delete;

    WebPPicture* get() { return &picture_; }

private:
    WebPPicture picture_ = {};
};

// What the encoder made, freed by its own means.
struct WebpBytes {
    WebpBytes() { WebPDataInit(&data); }
    ~WebpBytes() { WebPDataClear(&data); }
    WebpBytes(const WebpBytes&) = delete;
    WebpBytes& operator=(const WebpBytes&) = delete;

    WebPData data = {};
};

void require_valid(std::span<const Grid<std::uint8_t>> frames, const AnimationOptions& options)
{
    if (frames.empty())
        throw InvalidInput("an animation needs a frame at least");
    const std::size_t rows = frames.front().rows();
    const std::size_t columns = frames.front().columns();
    for (const Grid<std::uint8_t>& frame : frames)
        if (frame.rows() != rows || frame.columns() != columns)
            throw InvalidInput("the frames of an animation must have one size");
    if (std::min(rows, columns) < 1 || std::max(rows, columns) > kLongestWebpSide)
        throw InvalidInput("a WebP picture has 1 to " + std::to_string(kLongestWebpSide)
                           + " pixels a side, got " + std::to_string(rows) + " x " + std::to_string(columns));
    if (!(options.seconds_a_frame > 0.0 && options.seconds_a_frame <= 60.0))
        throw InvalidInput("a frame must last above 0 and at most 60 seconds, got "
                           + std::to_string(options.seconds_a_frame));
    if (!(options.quality >= 0.0f && options.quality <= 100.0f))
        throw InvalidInput("quality must be from 0 to 100, got " + std::to_string(options.quality));
}

[[noreturn]] void fail(const std::string& path, WebPAnimEncoder* encoder)
{
    const char* why = encoder != nullptr ? WebPAnimEncoderGetError(encoder) : nullptr;
    throw OutputError("cannot write '" + path + "': " + (why != nullptr ? why : "no WebP encoder"));
}

void encode(std::span<const Grid<std::uint8_t>> frames, const AnimationOptions& options,
            const std::string& path, WebPData& bytes)
{
    WebPAnimEncoderOptions settings = {};
    WebPConfig config = {};
    if (WebPAnimEncoderOptionsInit(&settings) == 0 || WebPConfigInit(&config) == 0)
        fail(path, nullptr);
    config.quality = options.quality;
    const Encoder encoder(WebPAnimEncoderNew(static_cast<int>(frames.front().columns()),
                                             static_cast<int>(frames.front().rows()), &settings));
    if (!encoder)
        fail(path, nullptr);
    const auto time_ms = [&options](std::size_t frame) {
        return static_cast<int>(std::lround(1000.0 * options.seconds_a_frame * static_cast<double>(frame)));
    };
    for (std::size_t i = 0; i < frames.size(); ++i) {
        WebpPicture picture(frames[i]);
        if (WebPAnimEncoderAdd(encoder.get(), picture.get(), time_ms(i), &config) == 0)
            fail(path, encoder.get());
    }
    if (WebPAnimEncoderAdd(encoder.get(), nullptr, time_ms(frames.size()), nullptr) == 0
        || WebPAnimEncoderAssemble(encoder.get(), &bytes) == 0)
        fail(path, encoder.get());
}

} // namespace

void write_animation(const std::string& path, std::span<const Grid<std::uint8_t>> frames,
                     const AnimationOptions& options)
{
    require_valid(frames, options);
    StagedOutput staged(path, options.overwrite);
    WebpBytes bytes;
    encode(frames, options, path, bytes.data);
    {
        std::ofstream file(staged.path(), std::ios::binary);
        file.write(reinterpret_cast<const char*>(bytes.data.bytes),
                   static_cast<std::streamsize>(bytes.data.size));
        if (!file.flush())
            throw OutputError("cannot write '" + path + "': the disk may be full");
    }
    staged.publish();
}

} // namespace duskline
