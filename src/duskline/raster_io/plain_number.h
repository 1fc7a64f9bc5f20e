#pragma once

#include <string>

namespace duskline {

/// A number for a sentence: at most `decimals` digits after the point, no trailing zeros ("75", "92.46").
std::string plain_number(double value, int decimals = 2);

} // namespace duskline
