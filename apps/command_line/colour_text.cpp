#include "colour_text.h"

#include "exit_code.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace duskline::cli {

Colour parse_colour(std::string_view option, std::string_view text)
{
    std::string_view digits = text;
    if (digits.starts_with('#'))
        digits.remove_prefix(1);
    unsigned rgb = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), rgb, 16);
    if (digits.size() != 6 || error != std::errc() || end != digits.data() + digits.size())
        throw UsageError(fmt::format("{} must be #RRGGBB such as #ffcc88, got '{}'", option, text));
    const auto channel = [&](unsigned shift) { return static_cast<float>((rgb >> shift) & 255U) / 255.0f; };
    return {channel(16), channel(8), channel(0)};
}

std::string text_of(const Colour& colour)
{
    const auto byte = [](float channel) { return static_cast<int>(std::lround(255.0f * channel)); };
    return fmt::format("#{:02x}{:02x}{:02x}", byte(colour.red), byte(colour.green), byte(colour.blue));
}

} // namespace duskline::cli
