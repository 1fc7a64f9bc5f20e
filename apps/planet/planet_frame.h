#pragma once

#include "planet_scene.h"
#include "planet_shadowing.h"

#include <cstddef>

namespace duskline::planet_app {

/// What a frame may do besides drawing.
struct FrameBudget {
    std::size_t loads = 8; ///< tiles read
    ShadowBudget shadows = {.tiles = 24};
};

/// What a frame cost, by the wall clock; with `wait` the graphics card's work is part of it.
struct FrameCost {
    double load_ms = 0.0;  ///< choosing tiles, reading those that are new and taking what is seen to the card
    double lamps_ms = 0.0; ///< drawing shadow maps of lamps
    double cast_ms = 0.0;  ///< finding shadows
    double draw_ms = 0.0;
    gl::DrawnPlanet drawn;
    bool settled = false; ///< all that the view wants is there

    double frame_ms() const { return load_ms + cast_ms + lamps_ms + draw_ms; }
};

/// Loads tiles for a frame. Says how long it took.
double load_tiles(PlanetScene& scene, const PlanetState& state, std::size_t width, std::size_t height,
                  const FrameBudget& budget, bool wait = false);

/// Brings lamps up to date for the tiles that are loaded: PlanetLamps::update. Says how long it took.
double light_lamps(PlanetScene& scene, const PlanetState& state, bool exact, bool wait = false);

/// Finds shadows and draws a picture of that size into the current framebuffer, with the tiles that are loaded and lamps as
/// they are.
FrameCost draw_loaded(PlanetScene& scene, PlanetShadowing& shadowing, const PlanetState& state,
                      std::size_t width, std::size_t height, const FrameBudget& budget, bool wait = false);

/// All of it: a picture with what is there and what the budget adds.
FrameCost draw_frame(PlanetScene& scene, PlanetShadowing& shadowing, const PlanetState& state,
                     std::size_t width, std::size_t height, const FrameBudget& budget = {},
                     bool wait = false);

/// The same with everything there, however long it takes.
FrameCost draw_settled(PlanetScene& scene, PlanetShadowing& shadowing, const PlanetState& state,
                       std::size_t width, std::size_t height);

} // namespace duskline::planet_app
