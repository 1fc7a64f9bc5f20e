#pragma once

#include "planet_scene.h"
#include "planet_shadowing.h"
#include "shadow_truth.h"

#include <duskline/gl/framebuffer.h>
#include <duskline/gl/texture.h>

namespace duskline::planet_app {

/// Where pictures of places and shadows are drawn instead of colours.
class GroundProbe {
public:
    GroundProbe(std::size_t width, std::size_t height);

    /// Of a state, with everything there that the view wants. Leaves its own framebuffer bound.
    ProbedPicture settled(PlanetScene& scene, PlanetShadowing& shadowing, const PlanetState& state) const;

    /// How much of a lamp of the scene's is to be seen, with everything there; where it lights nothing anyway, because it is too far
    /// away, beside its beam or behind the ground's back, there is no ground.
    ProbedPicture lamp(PlanetScene& scene, const PlanetState& state, std::size_t lamp) const;

private:
    gl::Texture places_;
    gl::Texture depth_;
    gl::Framebuffer framebuffer_;
};

} // namespace duskline::planet_app
