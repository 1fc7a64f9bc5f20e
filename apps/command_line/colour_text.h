#pragma once

#include <duskline/products/colour.h>

#include <string>
#include <string_view>

namespace duskline::cli {

/// Red, green and blue of "#RRGGBB", 0 to 1; the # may be left out. Throws UsageError naming the option.
Colour parse_colour(std::string_view option, std::string_view text);

/// "#ffcc88" for parts of 0 to 1.
std::string text_of(const Colour& colour);

} // namespace duskline::cli
