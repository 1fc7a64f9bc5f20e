#pragma once

#include "cli11_names.h"

#include <duskline/geometry/angle.h>
#include <duskline/products/colour.h>
#include <duskline/view/scene_lamp.h>

#include <array>
#include <functional>
#include <optional>
#include <string>

namespace duskline::window {

/// Where a searchlight shines: clockwise from north, above the horizontal, and from the middle of its beam to its border.
struct LampBeam {
    Angle azimuth = {};
    Angle altitude = {};
    Angle half_angle = Angle::from_degrees(10.0);

    bool operator==(const LampBeam&) const = default;
};

/// A lamp or a searchlight as people say it, wherever it stands: by where it is as bright as the sun.
struct LampSettings {
    std::optional<LampBeam> beam = {}; ///< of a searchlight
    double strength = 1.0;             ///< at its reach, in suns; with the square of the distance it falls
    double reach_m = 100.0;
    double range_m = 5000.0;   ///< farther away it lights nothing
    double soft_edge = 0.2;    ///< of a beam: SceneLamp
    Colour colour = {1, 1, 1}; ///< factors, 0 to 1
    bool on = true;

    bool operator==(const LampSettings&) const = default;
};

/// A lamp that shines all round, or a searchlight, with what is usual: those see farther.
LampSettings usual_lamp();
LampSettings usual_searchlight(const LampBeam& beam);

/// As a scene has it, in its frame. `beam_direction` is that of the beam, if there is one.
SceneLamp scene_lamp(const LampSettings& lamp, const Vector3& position_m, const Vector3& beam_direction);

/// How a program's users say where a lamp stands, by three numbers.
struct LampPlaceForm {
    const char* numbers; ///< "LON,LAT,HEIGHT"
    const char* example; ///< "-155.62,20.1,30"
    const char* text;    ///< for --help: "at a place, so many metres over the ground"
};

/// A lamp as it was typed, the numbers of its place not read yet.
struct TypedLamp {
    std::string option; ///< --lamp or --searchlight
    std::array<std::string, 3> place;
    LampSettings light;
};

/// Adds --lamp and --searchlight: place, of a searchlight AZIMUTH,ALTITUDE,HALF_ANGLE, and by commas NAME=VALUE of what is not
/// usual. `take` is called for each as it comes; it may throw cli::UsageError, as what is wrong here does, with the option,
/// the value and what would be right.
void add_lamp_options(CLI::App& app, const LampPlaceForm& form, const std::string& group,
                      const std::function<void(const TypedLamp&)>& take);

/// What `add_lamp_options` reads: of one that shines all round, and of one with a beam.
TypedLamp parse_lamp(const LampPlaceForm& form, const std::string& typed);
TypedLamp parse_searchlight(const LampPlaceForm& form, const std::string& typed);

/// The option that brings a lamp at such a place: "--lamp -155.62,20.1,30,strength=2".
std::string option_of(const std::string& place, const LampSettings& lamp);

/// Throws cli::UsageError for more lamps than may shine.
void require_lamps_fit(std::size_t lamps);

/// A number as options take it, with as many digits as it is worth: to 1e-6 degrees, and to a centimetre.
std::string degrees_text(Angle angle);
std::string metres_text(double value_m);

} // namespace duskline::window
