#include "ground_probe.h"

#include <duskline/gl/read_back.h>

namespace duskline::planet_app {

GroundProbe::GroundProbe(std::size_t width, std::size_t height)
    : places_(gl::TextureFormat::rgba32f, width, height), depth_(gl::TextureFormat::depth32f, width, height),
      framebuffer_({&places_}, &depth_)
{}

ProbedPicture GroundProbe::settled(PlanetScene& scene, PlanetShadowing& shadowing,
                                   const PlanetState& state) const
{
    scene.load_all(state, places_.width(), places_.height());
    shadowing.update(state, places_.width(), places_.height());
    framebuffer_.bind();
    framebuffer_.clear({kNoGround, kNoGround, kNoGround, kNoGround});
    scene.probe(state, places_.width(), places_.height(), shadowing.shadow(state));
    return gl::read_back<std::array<float, 4>>(places_);
}

} // namespace duskline::planet_app
