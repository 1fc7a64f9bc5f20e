#pragma once

#include "cli11_names.h"

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace duskline::cli {

/// A finite number, written with a point whatever the locale. Throws UsageError naming the option.
double parse_number(std::string_view option, std::string_view text);

/// A whole number of at least `least`. Throws UsageError naming the option.
std::size_t parse_count(std::string_view option, std::string_view text, std::size_t least);

/// The numbers an option takes, both ends included unless `above` says that the least is not.
struct Range {
    double least = -std::numeric_limits<double>::infinity();
    double most = std::numeric_limits<double>::infinity();
    bool above = false;
};

/// The same within a range. Throws UsageError naming the option, also for a number beyond it.
double parse_number(std::string_view option, std::string_view text, const Range& range);

/// One option that takes a number.
struct NumberOption {
    std::string names; ///< as CLI11 wants them: "-z,--z-factor"
    std::string unit;  ///< what --help shows for the value: "DEG"
    std::string text;  ///< one line; the range and the default are added
    Range range = {};
};

/// Adds the option; `value` stays empty when it is not given.
CLI::Option* add_number(CLI::App& app, const NumberOption& option, std::optional<double>& value);

/// Adds the option; what `value` holds now is its default.
CLI::Option* add_number(CLI::App& app, const NumberOption& option, double& value);

} // namespace duskline::cli
