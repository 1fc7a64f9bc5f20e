#include "render_picture.h"

#include "picture_target.h"
#include "raster_site.h"
#include "scene.h"

#include <duskline/gl/headless_context.h>
#include <duskline/raster_io/write_picture.h>

#include <fmt/format.h>

namespace duskline::viewer {
namespace {

constexpr std::size_t kSamplesPerSide = 2;

} // namespace

void render_picture(const ViewerOptions& options, cli::Report& report)
{
    window::require_new_picture(options);
    const gl::HeadlessContext context;
    ViewedTerrain viewed = read_viewed_terrain(options, report);
    const SunClock clock(cli::light_site(viewed.file.ground()), options.light.sun,
                         options.light.sun_size_deg);
    const ViewerState state = first_state(options, viewed, clock);
    const gl::ShaderSources sources;
    Scene scene(viewed, clock, sources);

    const window::PictureTarget target(kSamplesPerSide * options.width, kSamplesPerSide * options.height);
    target.begin();
    scene.cast(state, target.width(), target.height());
    const FrameCost cost = scene.draw(state, target.width(), target.height());
    const Picture picture = shrunk(target.picture(), options.height, options.width);
    write_picture(options.render, picture.view(), options.overwrite);

    report.line(fmt::format(
        "{}: {} x {} pixels, {} triangles, shadows by {}, light from azimuth {:.1f}, {:.1f} degrees "
        "high",
        options.render, options.width, options.height, cost.mesh.triangles, state.technique,
        state.light.azimuth_deg, state.light.altitude_deg));
    report.field("output", options.render);
    report.field("technique", state.technique);
    report.field("triangles", cost.mesh.triangles);
    report.field("azimuth_deg", state.light.azimuth_deg);
    report.field("altitude_deg", state.light.altitude_deg);
}

} // namespace duskline::viewer
