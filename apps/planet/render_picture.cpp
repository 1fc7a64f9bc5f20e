#include "render_picture.h"

#include "picture_target.h"
#include "planet_files.h"
#include "planet_frame.h"

#include <duskline/gl/headless_context.h>
#include <duskline/raster_io/write_picture.h>

#include <fmt/format.h>

namespace duskline::planet_app {
namespace {

constexpr std::size_t kSamplesPerSide = 2;

} // namespace

void render_picture(const PlanetOptions& options, cli::Report& report)
{
    window::require_new_picture(options);
    const gl::HeadlessContext context;
    const ViewedPlanet viewed = read_viewed_planet(options, report);
    const PlanetState state = first_state(options, *viewed.terrain);
    const gl::ShaderSources sources;
    PlanetScene scene(viewed, sources, state.square_pixels, {.threads = options.run.threads});
    PlanetShadowing shadowing(scene);

    const window::PictureTarget target(kSamplesPerSide * options.width, kSamplesPerSide * options.height);
    target.begin();
    const FrameCost cost = draw_settled(scene, shadowing, state, target.width(), target.height());
    const Picture picture = shrunk(target.picture(), options.height, options.width);
    write_picture(options.render, picture.view(), options.overwrite);

    const SunAngles sun = sun_angles(viewed.terrain->globe(), state.sun.direction, options.pose.place);
    report.line(fmt::format(
        "{}: {} x {} pixels, {} tiles, {} triangles, shadows by {}, sun at azimuth {:.1f}, {:.1f} "
        "degrees high",
        options.render, options.width, options.height, cost.drawn.tiles, cost.drawn.triangles,
        name_of(state.technique), sun.azimuth.degrees(), sun.altitude.degrees()));
    report.field("output", options.render);
    report.field("technique", name_of(state.technique));
    report.field("tiles", cost.drawn.tiles);
    report.field("triangles", cost.drawn.triangles);
    report.field("azimuth_deg", sun.azimuth.degrees());
    report.field("altitude_deg", sun.altitude.degrees());
}

} // namespace duskline::planet_app
