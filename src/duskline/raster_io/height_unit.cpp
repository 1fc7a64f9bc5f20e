#include <duskline/raster_io/height_unit.h>
#include <duskline/raster_io/plain_number.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

namespace duskline {

namespace {

struct KnownUnit {
    std::string_view name;
    double metres;
    std::string_view spellings; // between blanks, lower case, without blanks, dots, dashes and underscores
};

constexpr std::array kKnownUnits = {
    KnownUnit{"metres", 1.0, " m metre metres meter meters mtr "},
    KnownUnit{"feet", 0.3048,
              " ft foot feet internationalfoot internationalfeet ftinternational footintl "
              "ifoot intft "},
    KnownUnit{"US survey feet", 1200.0 / 3937.0,
              " usft ftus sftus ussurveyfoot ussurveyfeet usfoot usfeet footus surveyfoot surveyfeet ussft "},
    KnownUnit{"kilometres", 1000.0, " km kilometre kilometres kilometer kilometers "},
    KnownUnit{"decimetres", 0.1, " dm decimetre decimetres decimeter decimeters "},
    KnownUnit{"centimetres", 0.01, " cm centimetre centimetres centimeter centimeters "},
    KnownUnit{"millimetres", 0.001, " mm millimetre millimetres millimeter millimeters "},
};

} // namespace

std::optional<HeightUnit> height_unit_written(std::string_view written)
{
    std::string key = " ";
    for (const char c : written)
        if (std::isalnum(static_cast<unsigned char>(c)))
            key += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    key += ' ';
    if (key == "  ")
        return std::nullopt;
    const auto found = std::ranges::find_if(kKnownUnits, [&](const KnownUnit& unit) {
        return unit.spellings.find(key) != std::string_view::npos;
    });
    if (found == kKnownUnits.end())
        return std::nullopt;
    return HeightUnit{std::string(found->name), found->metres};
}

HeightUnit height_unit_of(double metres)
{
    for (const KnownUnit& unit : kKnownUnits)
        if (std::abs(unit.metres - metres) < 1e-9 * metres)
            return {std::string(unit.name), metres};
    return {"units of " + plain_number(metres, 6) + " m", metres};
}

} // namespace duskline
