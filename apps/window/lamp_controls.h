#pragma once

#include "lamp_settings.h"

#include <cstddef>
#include <span>

namespace duskline::window {

/// A lamp in a panel: what all lamps have, and its height in the program's way, metres.
struct ListedLamp {
    LampSettings& light;
    double& height_m;
};

/// What is to be done with the lamps besides setting them.
struct LampWish {
    enum class Kind {
        none,
        add,       ///< `light`, where the eye is
        move_here, ///< `lamp`, to where the eye is
        remove     ///< `lamp`
    };
    Kind kind = Kind::none;
    std::size_t lamp = 0; ///< its place in the list
    LampSettings light = {};
};

/// The controls of all lamps, and buttons for new ones and to aim beams where the eye looks. Says what was asked for.
LampWish lamp_controls(std::span<const ListedLamp> lamps, const LampBeam& beam_of_view);

} // namespace duskline::window
