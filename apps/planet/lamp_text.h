#pragma once

#include "placed_lamp.h"

#include <string>

namespace duskline::planet_app {

/// Reads what is typed after --lamp: "LON,LAT,HEIGHT" and, by commas, NAME=VALUE of what is not usual. Throws
/// cli::UsageError with the option, the value and what would be right.
PlacedLamp parse_lamp(const std::string& typed);

/// The same after --searchlight: "LON,LAT,HEIGHT,AZIMUTH,ALTITUDE,HALF_ANGLE[,NAME=VALUE...]".
PlacedLamp parse_searchlight(const std::string& typed);

/// The option that brings the lamp: "--lamp -155.62,20.1,30,strength=2".
std::string option_of(const PlacedLamp& lamp);

/// What may be said by name, with what is usual, for help texts: of any lamp, and what is different of searchlights.
std::string lamp_help();
std::string searchlight_help();

} // namespace duskline::planet_app
