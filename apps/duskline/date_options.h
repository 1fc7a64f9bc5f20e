#pragma once

#include "cli11_names.h"

#include <duskline/light/date_time.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace duskline::cli {

/// `parse(text)`, with what it throws as InvalidInput turned to a UsageError that names the option.
CalendarDate read_date_of(std::string_view option, const std::string& text);
DateTime read_time_of(std::string_view option, const std::string& text);

/// Adds an option that takes a date; `date` must outlive `app`'s parsing.
void add_date_option(CLI::App& app, const std::string& name, const std::string& text,
                     std::optional<CalendarDate>& date);

/// The same for a list of dates, parted by commas.
void add_dates_option(CLI::App& app, const std::string& name, const std::string& text,
                      std::vector<CalendarDate>& dates);

/// The same for a moment with its offset from UTC.
void add_time_option(CLI::App& app, const std::string& name, const std::string& text,
                     std::optional<DateTime>& time);

/// Adds --utc-offset.
void add_utc_offset_option(CLI::App& app, const std::string& text,
                           std::optional<std::chrono::minutes>& utc_offset);

/// "2026-06-21".
std::string in_words(CalendarDate date);

} // namespace duskline::cli
