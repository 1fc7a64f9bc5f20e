#include "light_job.h"

#include "height_input.h"
#include "stopwatch.h"

#include <duskline/casting/finer_mask.h>
#include <duskline/casting/lamps.h>
#include <duskline/casting/visible_fraction.h>
#include <duskline/products/lit_fraction.h>
#include <duskline/raster_io/read_colours.h>
#include <duskline/terrain/refined.h>

#include <variant>

namespace duskline::cli {
namespace {

void lower(const LightJob& job, Terrain& terrain, double sign)
{
    EarthCurvature curvature = job.curvature;
    curvature.coefficient *= sign;
    if (curvature.coefficient != 0.0)
        CurvedEarth(curvature, terrain.cell_size_m, terrain.heights_m.columns())
            .lower(terrain.heights_m.view());
}

// gdaldem knows of no curvature, so its model takes the slopes of the ground as it is.
NormalField normals_of(const LightJob& job, Terrain& terrain)
{
    const bool flat = job.options.map.model->model == LightModel::hillshade;
    NormalField normals;
    if (flat)
        normals = upward_normals(terrain, job.execution(0.15, 0.18));
    lower(job, terrain, 1.0);
    if (!flat)
        normals = upward_normals(terrain, job.execution(0.15, 0.18));
    if (job.is_finer())
        normals = refined(normals, job.size.rows, job.size.columns, job.execution(0.18, 0.2));
    if (job.options.map.packed_normals)
        normals = through_bytes(normals, job.execution(0.2, 0.2));
    return normals;
}

// Where a light is seen from; owns what LitCells only sees.
using Cast = std::variant<std::monostate, ShadowMask, Grid<float>>;

LitCells cells_of(const Cast& cast)
{
    if (const auto* mask = std::get_if<ShadowMask>(&cast))
        return mask->view();
    if (const auto* fraction = std::get_if<Grid<float>>(&cast))
        return fraction->view();
    return {};
}

// A piece of the whole work, for its progress.
struct Share {
    double from;
    double to;

    Share part(double first, double last) const
    {
        return {from + (to - from) * first, from + (to - from) * last};
    }
};

// Casts over the ground's own cells, and from there over those of the map.
template <typename Light, typename CastCoarse>
ShadowMask cast_hard(const LightJob& job, const MapGround& ground, const Light& light, Share share,
                     const CastCoarse& cast_coarse)
{
    const auto execution = [&](double first, double last) {
        const Share part = share.part(first, last);
        return job.execution(part.from, part.to);
    };
    ShadowMask mask = cast_coarse(execution(0.0, job.is_finer() ? 0.2 : 1.0));
    return job.is_finer() ? finer_mask(ground.terrain, mask, light, ground.of_map(), execution(0.2, 1.0))
                          : std::move(mask);
}

Cast cast_sun(const LightJob& job, const MapGround& ground, const DirectionalLight& sun, Share share)
{
    if (job.options.map.soft)
        return visible_fraction(ground.of_map(), sun, job.caster, job.execution(share.from, share.to));
    const bool sampled = job.options.map.antialias;
    ShadowMask mask =
        cast_hard(job, ground, sun, share.part(0.0, sampled ? 0.4 : 1.0),
                  [&](const auto& execution) { return job.caster.cast(ground.terrain, sun, execution); });
    if (!sampled)
        return mask;
    const Share rest = share.part(0.4, 1.0);
    return finer_super_sampled_lit_fraction(ground.terrain, mask, sun, job.execution(rest.from, rest.to));
}

Cast cast_light(const LightJob& job, const MapGround& ground, const ChosenMapLight& light, Share share)
{
    if (!job.casts(light))
        return {};
    if (light.sun)
        return cast_sun(job, ground, light.sun->light, share);
    return cast_hard(job, ground, light.lamp->light, share, [&](const auto& execution) {
        return cast_lamp(job.caster, ground.terrain, light.lamp->light, execution);
    });
}

// The same place over the cells of the map.
PointLight lamp_over_map(const LightJob& job, PointLight lamp)
{
    const auto scaled = [](double place, std::size_t cells, std::size_t finer_cells) {
        return (place + 0.5) * static_cast<double>(finer_cells) / static_cast<double>(cells) - 0.5;
    };
    if (job.is_finer()) {
        lamp.position.row = scaled(lamp.position.row, job.file.rows(), job.size.rows);
        lamp.position.column = scaled(lamp.position.column, job.file.columns(), job.size.columns);
    }
    return lamp;
}

MapLight as_map_takes_it(const LightJob& job, const ChosenMapLight& light, const Cast& cast)
{
    MapLight result;
    if (light.sun)
        result.source = light.sun->light;
    else
        result.source = lamp_over_map(job, light.lamp->light);
    result.lit = cells_of(cast);
    result.strength = light.strength;
    result.colour = light.colour;
    result.reach_m = light.reach_m;
    return result;
}

} // namespace

// Heights, normals, the map and its pixels; what the lights are seen from, and what casting them takes.
double bytes_per_cell(const LightJob& job)
{
    const LightMapCommandOptions& map = job.options.map;
    const bool shares = map.soft || map.antialias;
    double bytes = sizeof(float) + 3.0 * sizeof(float) + 3.0 * sizeof(float);
    bytes += static_cast<double>(job.lights.size()) * (shares ? sizeof(float) : 1.0);
    bytes += map.soft ? 4.5 : 0.0; // masks of the disc's edges
    bytes += map.antialias || job.is_finer() ? sizeof(float) + 1.0 + 8.0 * 2.0 / 3.0 : 0.0; // pyramid of rays
    bytes += map.texture.empty() ? 0.0 : sizeof(Rgba8);
    bytes += map.packed_normals ? 3.0 * sizeof(float) : 0.0;
    return bytes + (job.mesh ? 3.0 : 0.0);
}

MapGround read_ground(const LightJob& job, Report& report)
{
    MapGround ground;
    ground.terrain = read_terrain(job.file, job.execution(0.0, 0.15));
    report_reading(job.file, report);
    ground.normals = normals_of(job, ground.terrain);
    if (job.is_finer())
        ground.finer = refined(ground.terrain, job.size.rows, job.size.columns, job.execution(0.2, 0.2));
    const std::string& texture = job.options.map.texture;
    if (!texture.empty())
        ground.texture =
            read_colours(texture, job.file, job.size.rows, job.size.columns, job.execution(0.2, 0.25));
    return ground;
}

LightMap make_map(const LightJob& job, const MapGround& ground, LightSeconds& seconds)
{
    std::vector<Cast> casts;
    {
        const Stopwatch watch(seconds.casting);
        const auto count = static_cast<double>(job.lights.size());
        for (std::size_t i = 0; i < job.lights.size(); ++i) {
            const auto number = static_cast<double>(i);
            const Share whole = {0.25, 0.75};
            casts.push_back(
                cast_light(job, ground, job.lights[i], whole.part(number / count, (number + 1.0) / count)));
        }
    }
    const Stopwatch watch(seconds.lighting);
    std::vector<MapLight> lights;
    for (std::size_t i = 0; i < job.lights.size(); ++i)
        lights.push_back(as_map_takes_it(job, job.lights[i], casts[i]));
    LightMap map = light_map(ground.of_map(), ground.normals, lights, job.options.map.light(),
                             job.execution(0.75, 0.85));
    if (!ground.texture.empty())
        multiply(map, ground.texture.view(), job.execution(0.85, 0.87));
    return map;
}

void raise_again(const LightJob& job, MapGround& ground)
{
    lower(job, ground.terrain, -1.0);
    if (job.is_finer())
        ground.finer =
            refined(ground.terrain, job.size.rows, job.size.columns, {.threads = job.options.run.threads});
}

} // namespace duskline::cli
