#pragma once

#include "input_options.h"
#include "light_map_options.h"
#include "map_lights.h"
#include "output_options.h"
#include "progress_bar.h"
#include "report.h"
#include "run_options.h"

#include <duskline/casting/casters.h>
#include <duskline/products/light_map.h>
#include <duskline/raster_io/read_height_field.h>
#include <duskline/terrain/earth_curvature.h>
#include <duskline/terrain/normals.h>

#include <string>
#include <vector>

namespace duskline::cli {

/// All of `duskline light`.
struct LightCommandOptions {
    InputOptions input;
    OutputOptions output;
    MapLightOptions lights;
    LightMapCommandOptions map;
    std::string caster;
    RunOptions run;
};

/// Everything there is to know once the options are settled.
struct LightJob {
    const LightCommandOptions& options;
    HeightFile& file;
    std::vector<ChosenMapLight> lights;
    EarthCurvature curvature;
    const Caster& caster;
    MapSize size;
    bool mesh; ///< the output is a PLY file
    ProgressBar& bar;

    Execution execution(double from, double to) const
    {
        return {.threads = options.run.threads, .progress = bar.part(from, to)};
    }
    bool is_finer() const { return size != MapSize{file.rows(), file.columns()}; }
    bool casts(const ChosenMapLight& light) const { return light.casts && !options.map.no_shadows; }
};

/// How long the parts took.
struct LightSeconds {
    double reading = 0.0;
    double casting = 0.0;
    double lighting = 0.0;
    double writing = 0.0;
    double total = 0.0;
};

/// The ground as light sees it, and finer between its samples where the map is.
struct MapGround {
    Terrain terrain;
    Terrain finer; ///< empty unless the map is finer
    NormalField normals;
    Grid<Rgba8> texture; ///< empty: none

    HeightField of_map() const { return finer.heights_m.empty() ? HeightField(terrain) : HeightField(finer); }
};

/// Memory that making such a map takes, a cell of the map.
double bytes_per_cell(const LightJob& job);

/// Reads the heights and what belongs to them. Throws as HeightFile::read and read_colours.
MapGround read_ground(const LightJob& job, Report& report);

/// Casts every light and adds them up, over the texture if there is one.
LightMap make_map(const LightJob& job, const MapGround& ground, LightSeconds& seconds);

/// Gives the ground back the heights it has without the curvature of the earth.
void raise_again(const LightJob& job, MapGround& ground);

} // namespace duskline::cli
