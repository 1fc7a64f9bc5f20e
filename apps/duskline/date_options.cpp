#include "date_options.h"

#include "exit_code.h"

#include <duskline/geometry/invalid_input.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <sstream>

namespace duskline::cli {
namespace {

constexpr auto kGroup = "Light";

template <typename Parse>
auto read_of(std::string_view option, const std::string& text, const Parse& parse)
{
    try {
        return parse(text);
    } catch (const InvalidInput& error) {
        throw UsageError(fmt::format("{} {}", option, error.what()));
    }
}

} // namespace

CalendarDate read_date_of(std::string_view option, const std::string& text)
{
    return read_of(option, text, parse_date);
}

DateTime read_time_of(std::string_view option, const std::string& text)
{
    return read_of(option, text, parse_date_time);
}

void add_date_option(CLI::App& app, const std::string& name, const std::string& text,
                     std::optional<CalendarDate>& date)
{
    app.add_option_function<std::string>(
           name, [name, &date](const std::string& typed) { date = read_date_of(name, typed); }, text)
        ->type_name("DATE")
        ->group(kGroup);
}

void add_dates_option(CLI::App& app, const std::string& name, const std::string& text,
                      std::vector<CalendarDate>& dates)
{
    const auto read = [name, &dates](const std::string& typed) {
        std::istringstream words(typed);
        for (std::string word; std::getline(words, word, ',');)
            dates.push_back(read_date_of(name, word));
    };
    app.add_option_function<std::string>(name, read, text)->type_name("DATE,...")->group(kGroup);
}

void add_time_option(CLI::App& app, const std::string& name, const std::string& text,
                     std::optional<DateTime>& time)
{
    app.add_option_function<std::string>(
           name, [name, &time](const std::string& typed) { time = read_time_of(name, typed); }, text)
        ->type_name("TIME")
        ->group(kGroup);
}

void add_utc_offset_option(CLI::App& app, const std::string& text,
                           std::optional<std::chrono::minutes>& utc_offset)
{
    const auto read = [&utc_offset](const std::string& typed) {
        utc_offset = read_of("--utc-offset", typed, parse_utc_offset);
    };
    app.add_option_function<std::string>("--utc-offset", read, text)->type_name("HH:MM")->group(kGroup);
}

std::string in_words(CalendarDate date)
{
    return to_iso8601({std::chrono::sys_days(date)}).substr(0, 10);
}

} // namespace duskline::cli
