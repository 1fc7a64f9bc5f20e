#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace duskline {

/// A unit that heights come in.
struct HeightUnit {
    std::string name; ///< in words, plural: "US survey feet"
    double metres = 1.0;
};

/// The unit a file means by `written` ("m", "ft", "US survey foot", "sftUS", ...); empty when it is none we
/// know.
std::optional<HeightUnit> height_unit_written(std::string_view written);

/// A unit of that many metres, by its name if it has one.
HeightUnit height_unit_of(double metres);

} // namespace duskline
