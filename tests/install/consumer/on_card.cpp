// A foreign project with OpenGL: the same wall, its shadow found on the graphics card, or on the processor where there is
// no card.

#include <duskline/casting/sweep.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/headless_context.h>
#include <duskline/gl/height_texture.h>
#include <duskline/gl/read_back.h>
#include <duskline/gl/shadow_sweep.h>

#include <algorithm>
#include <iostream>

using namespace duskline::angle_literals;

static const duskline::DirectionalLight kSun{.azimuth = 90_deg, .altitude = 44.9_deg};

static duskline::ShadowField found_on_card(const duskline::Terrain& terrain)
{
    const duskline::gl::HeadlessContext context;
    duskline::gl::ShadowSweep sweep{duskline::gl::ShaderSources()};
    const duskline::gl::Texture heights = duskline::gl::height_texture(terrain.heights_m.view());
    return duskline::gl::read_back<float>(sweep.cast(heights, terrain.cell_size_m, kSun));
}

static void print(const char* name, const duskline::Terrain& terrain, const duskline::ShadowField& shadow_m)
{
    const auto mask = duskline::mask_of(terrain, shadow_m);
    std::cout << name << ": " << std::ranges::count(mask.row(0), duskline::Lit::no) << " cells\n";
}

int main()
{
    duskline::Terrain terrain{duskline::Grid<float>(1, 32, 0.0f), {.x = 1.0, .y = 1.0}};
    terrain.heights_m(0, 20) = 10.0f;
    try {
        print("sweep_on_card", terrain, found_on_card(terrain));
    } catch (const duskline::UnsupportedOnThisMachine&) {
        print("sweep_on_processor", terrain, duskline::shadow_heights_by_sweep(terrain, kSun));
    }
}
