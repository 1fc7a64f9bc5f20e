#include "option_values.h"

#include "exit_code.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <functional>

namespace duskline::cli {
namespace {

template <typename Number>
bool is_whole_text(std::string_view text, Number& number)
{
    if (text.starts_with('+') && !text.starts_with("+-"))
        text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size();
}

// What users know an option by: the last of its names, the long one.
std::string long_name(const std::string& names)
{
    return names.substr(names.rfind(',') + 1);
}

std::string in_words(const Range& range)
{
    const bool has_least = std::isfinite(range.least);
    const bool has_most = std::isfinite(range.most);
    if (has_least && has_most)
        return fmt::format("{} {} to {}", range.above ? "above" : "from", range.least, range.most);
    if (has_least)
        return fmt::format("{} {}", range.above ? "above" : "at least", range.least);
    return has_most ? fmt::format("at most {}", range.most) : "";
}

CLI::Option* add_checked(CLI::App& app, const NumberOption& option, const std::function<void(double)>& take)
{
    const auto read = [name = long_name(option.names), range = option.range, take](const std::string& typed) {
        take(parse_number(name, typed, range));
    };
    const std::string range = in_words(option.range);
    const std::string text = range.empty() ? option.text : option.text + "; " + range;
    return app.add_option_function<std::string>(option.names, read, text)->type_name(option.unit);
}

} // namespace

double parse_number(std::string_view option, std::string_view text)
{
    double number = 0.0;
    if (!is_whole_text(text, number) || !std::isfinite(number))
        throw UsageError(fmt::format("{} must be a finite number such as 12.5, got '{}'", option, text));
    return number;
}

double parse_number(std::string_view option, std::string_view text, const Range& range)
{
    const double number = parse_number(option, text);
    const bool high_enough = range.above ? number > range.least : number >= range.least;
    if (!(high_enough && number <= range.most))
        throw UsageError(fmt::format("{} must be {}, got {}", option, in_words(range), number));
    return number;
}

std::size_t parse_count(std::string_view option, std::string_view text, std::size_t least)
{
    std::size_t number = 0;
    if (!is_whole_text(text, number) || number < least)
        throw UsageError(fmt::format("{} must be a whole number from {} up, got '{}'", option, least, text));
    return number;
}

CLI::Option* add_number(CLI::App& app, const NumberOption& option, std::optional<double>& value)
{
    return add_checked(app, option, [&value](double number) { value = number; });
}

CLI::Option* add_number(CLI::App& app, const NumberOption& option, double& value)
{
    auto* added = add_checked(app, option, [&value](double number) { value = number; });
    return added->default_str(fmt::format("{}", value));
}

} // namespace duskline::cli
