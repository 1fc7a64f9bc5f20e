#pragma once

#include <duskline/geometry/grid.h>

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <span>
#include <string>

namespace duskline::cli {

/// A number that is the same for the same bytes and hardly ever for others: tells whether data changed, by accident and
/// not by malice. FNV-1a over words of 4 bytes, of which each also stirs the lower bits.
template <typename T>
std::string content_hash(std::span<const T> values)
{
    static_assert(sizeof(T) == sizeof(std::uint32_t));
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const T& value : values) {
        std::uint32_t word = 0;
        std::memcpy(&word, &value, sizeof word);
        hash = (hash ^ word) * 0x100000001b3U;
        hash ^= hash >> 32U;
    }
    return fmt::format("{:016x}", hash);
}

} // namespace duskline::cli
