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

ProbedPicture GroundProbe::lamp(PlanetScene& scene, const PlanetState& state, std::size_t lamp) const
{
    scene.load_all(state, places_.width(), places_.height());
    scene.update_lamps(state, true);
    framebuffer_.bind();
    framebuffer_.clear({kNoGround, kNoGround, kNoGround, kNoGround});
    scene.probe_lamp(state, places_.width(), places_.height(), lamp);
    ProbedPicture picture = gl::read_back<std::array<float, 4>>(places_);
    for (std::array<float, 4>& pixel : picture.values())
        if (pixel[3] < 0.0f)
            pixel.fill(kNoGround);
    return picture;
}

} // namespace duskline::planet_app
