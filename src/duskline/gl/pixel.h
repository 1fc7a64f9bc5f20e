#pragma once

#include <array>
#include <cstdint>

namespace duskline::gl {

/// How values of one type lie in memory, channels side by side.
struct PixelLayout {
    enum class Channel { uint8, uint32, int32, float32 };
    Channel channel = Channel::float32;
    int channels = 1;
};

/// The layout of the types that textures are filled from and read back into.
template <typename T>
struct PixelLayoutOf;

template <>
struct PixelLayoutOf<std::uint8_t> {
    static constexpr PixelLayout kLayout{PixelLayout::Channel::uint8, 1};
};
template <>
struct PixelLayoutOf<std::uint32_t> {
    static constexpr PixelLayout kLayout{PixelLayout::Channel::uint32, 1};
};
template <>
struct PixelLayoutOf<std::int32_t> {
    static constexpr PixelLayout kLayout{PixelLayout::Channel::int32, 1};
};
template <>
struct PixelLayoutOf<float> {
    static constexpr PixelLayout kLayout{PixelLayout::Channel::float32, 1};
};
template <typename T, std::size_t kChannels>
struct PixelLayoutOf<std::array<T, kChannels>> {
    static constexpr PixelLayout kLayout{PixelLayoutOf<T>::kLayout.channel, static_cast<int>(kChannels)};
};

} // namespace duskline::gl
