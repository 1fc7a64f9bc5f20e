#include <duskline/geometry/invalid_input.h>
#include <duskline/light/date_time.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <optional>

namespace duskline {
namespace {

using std::chrono::days;
using std::chrono::hours;
using std::chrono::microseconds;
using std::chrono::minutes;
using std::chrono::seconds;

constexpr auto kExample = "2026-06-21T18:30-10:00";

// Reads from the front of a text; what fits is consumed.
class TextReader {
public:
    explicit TextReader(std::string_view rest) : rest_(rest) {}

    bool at_end() const { return rest_.empty(); }
    bool at_digit() const { return !rest_.empty() && rest_.front() >= '0' && rest_.front() <= '9'; }

    bool accept(std::string_view one_of)
    {
        if (rest_.empty() || one_of.find(rest_.front()) == std::string_view::npos)
            return false;
        rest_.remove_prefix(1);
        return true;
    }

    // Exactly `count` digits.
    std::optional<int> digits(std::size_t count)
    {
        if (rest_.size() < count)
            return std::nullopt;
        int number = 0;
        for (const char c : rest_.substr(0, count)) {
            if (c < '0' || c > '9')
                return std::nullopt;
            number = number * 10 + (c - '0');
        }
        rest_.remove_prefix(count);
        return number;
    }

    // The digits after a decimal point, in millionths; those beyond are cut off.
    microseconds fraction()
    {
        microseconds sum{0};
        for (int place = 100000; at_digit(); place /= 10) {
            sum += microseconds(place * (rest_.front() - '0'));
            rest_.remove_prefix(1);
        }
        return sum;
    }

private:
    std::string_view rest_;
};

[[noreturn]] void reject(std::string_view text, const std::string& why)
{
    throw InvalidInput("'" + std::string(text) + "' " + why);
}

std::string name_of(std::chrono::year_month month)
{
    static constexpr std::array kNames = {"January",   "February", "March",    "April",
                                          "May",       "June",     "July",     "August",
                                          "September", "October",  "November", "December"};
    return std::string(kNames.at(static_cast<unsigned>(month.month()) - 1)) + " "
           + std::to_string(static_cast<int>(month.year()));
}

CalendarDate read_date(TextReader& reader, std::string_view text)
{
    const auto year = reader.digits(4);
    const bool has_month = year && reader.accept("-");
    const auto month = has_month ? reader.digits(2) : std::nullopt;
    const bool has_day = month && reader.accept("-");
    const auto day = has_day ? reader.digits(2) : std::nullopt;
    if (!day)
        reject(text, std::string("does not begin with a date such as 2026-06-21"));
    if (*year < 1)
        reject(text, "is before the year 0001");
    if (*month < 1 || *month > 12)
        reject(text, "has month " + std::to_string(*month) + "; months are 01 to 12");
    const CalendarDate date{std::chrono::year(*year), std::chrono::month(static_cast<unsigned>(*month)),
                            std::chrono::day(static_cast<unsigned>(*day))};
    const auto last = date.year() / date.month() / std::chrono::last;
    if (!date.ok())
        reject(text, "has day " + std::to_string(*day) + "; " + name_of(date.year() / date.month()) + " has "
                         + std::to_string(static_cast<unsigned>(last.day())) + " days");
    return date;
}

struct ClockTime {
    microseconds since_midnight{0};
    bool is_leap_second = false;
};

ClockTime read_clock(TextReader& reader, std::string_view text)
{
    const auto hour = reader.digits(2);
    const bool has_minute = hour && reader.accept(":");
    const auto minute = has_minute ? reader.digits(2) : std::nullopt;
    if (!minute)
        reject(text, std::string("has no time of day such as 18:30; ") + kExample + " is a whole one");
    int second = 0;
    microseconds fraction{0};
    if (reader.accept(":")) {
        const auto given = reader.digits(2);
        if (!given)
            reject(text, "has no two digits of seconds after its second colon");
        second = *given;
        if (reader.accept(".,")) {
            if (!reader.at_digit())
                reject(text, "has no digits after its decimal point");
            fraction = reader.fraction();
        }
    }
    if (*hour > 23)
        reject(text, "has hour " + std::to_string(*hour) + "; hours are 00 to 23");
    if (*minute > 59)
        reject(text, "has minute " + std::to_string(*minute) + "; minutes are 00 to 59");
    if (second > 60)
        reject(text, "has second " + std::to_string(second) + "; seconds are 00 to 59");
    return {hours(*hour) + minutes(*minute) + seconds(second) + fraction, second == 60};
}

minutes read_offset(TextReader& reader, std::string_view text)
{
    if (reader.accept("Zz"))
        return minutes(0);
    const bool west = reader.accept("-");
    if (!west && !reader.accept("+"))
        reject(text, std::string("has no offset from UTC; add Z or one like -10:00 (") + kExample + ")");
    const auto hour = reader.digits(2);
    const bool has_minute = hour && (reader.accept(":") || reader.at_digit());
    const auto minute = has_minute ? reader.digits(2) : std::optional(0);
    if (!hour || !minute || *minute > 59)
        reject(text, "has no offset from UTC such as +05:45 or Z at its end");
    const minutes offset = hours(*hour) + minutes(*minute);
    if (offset > hours(14))
        reject(text, "has an offset from UTC of more than 14 hours");
    return west ? -offset : offset;
}

void require_possible_leap_second(UtcTime after, std::string_view text)
{
    // The second after an inserted one begins a half-year.
    const auto day = std::chrono::floor<days>(after);
    const CalendarDate date(day);
    const bool begins_half_year =
        date.day() == std::chrono::day(1)
        && (date.month() == std::chrono::January || date.month() == std::chrono::July);
    if (!begins_half_year || after - day >= seconds(1))
        reject(text, "has second 60, which is only ever at 23:59 UTC on 30 June or 31 December");
}

} // namespace

DateTime parse_date_time(std::string_view text)
{
    TextReader reader(text);
    const CalendarDate date = read_date(reader, text);
    if (!reader.accept("Tt "))
        reject(text, std::string("has no time of day; ") + kExample + " is a whole one");
    const ClockTime clock = read_clock(reader, text);
    const minutes offset = read_offset(reader, text);
    if (!reader.at_end())
        reject(text, std::string("goes on after its offset from UTC; ") + kExample + " is a whole one");
    const UtcTime utc = std::chrono::sys_days(date) + clock.since_midnight - offset;
    if (clock.is_leap_second)
        require_possible_leap_second(utc, text);
    return {utc, offset};
}

CalendarDate parse_date(std::string_view text)
{
    TextReader reader(text);
    const CalendarDate date = read_date(reader, text);
    if (!reader.at_end())
        reject(text, "goes on after the date; 2026-06-21 is a whole one");
    return date;
}

minutes parse_utc_offset(std::string_view text)
{
    try {
        TextReader reader(text);
        const minutes offset = read_offset(reader, text);
        if (reader.at_end())
            return offset;
    } catch (const InvalidInput&) {
        // Its text speaks of a whole date and time.
    }
    reject(text, "is no offset from UTC; write Z or, up to 14 hours, one like +05:45");
}

std::string to_iso8601(const DateTime& time)
{
    const auto local = std::chrono::round<seconds>(time.utc + time.utc_offset);
    const auto day = std::chrono::floor<days>(local);
    const CalendarDate date(day);
    const std::chrono::hh_mm_ss clock(local - day);
    char text[64];
    std::snprintf(text, sizeof text, "%04d-%02u-%02uT%02d:%02d:%02d", static_cast<int>(date.year()),
                  static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                  static_cast<int>(clock.hours().count()), static_cast<int>(clock.minutes().count()),
                  static_cast<int>(clock.seconds().count()));
    const auto offset = static_cast<int>(time.utc_offset.count());
    if (offset == 0)
        return std::string(text) + "Z";
    char zone[16];
    std::snprintf(zone, sizeof zone, "%c%02d:%02d", offset < 0 ? '-' : '+', std::abs(offset) / 60,
                  std::abs(offset) % 60);
    return std::string(text) + zone;
}

CalendarDate local_date(const DateTime& time)
{
    return CalendarDate(std::chrono::floor<days>(time.utc + time.utc_offset));
}

double julian_date(UtcTime time)
{
    constexpr double at_1970 = 2440587.5;
    return at_1970 + std::chrono::duration<double, days::period>(time.time_since_epoch()).count();
}

} // namespace duskline
