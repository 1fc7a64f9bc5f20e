#include "height_input.h"

#include <fmt/format.h>

namespace duskline::cli {
namespace {

constexpr double kUsualAir =
    6.0 / 7.0; // light bends by a seventh of the earth's curvature, as in gdal_viewshed

double usual_coefficient(const GroundFrame& ground)
{
    if (!ground.body)
        return 0.0;
    return ground.body->is_earth ? kUsualAir : 1.0;
}

} // namespace

ReadOptions read_options(const InputOptions& options, const RunOptions& run)
{
    return {.band = options.band,
            .open_options = options.open_options,
            .z_factor = options.z_factor,
            .metres_per_unit = options.metres_per_z_unit,
            .cell_size_m = options.cell_size_m,
            .no_data = options.no_data,
            .threads = run.threads};
}

HeightFile open_heights(const InputOptions& options, const RunOptions& run, Report& report)
{
    prepare_gdal_for_program();
    HeightFile file(options.path, read_options(options, run));
    for (const std::string& text : file.facts().notes)
        report.note(text);
    for (const std::string& text : file.facts().warnings)
        report.warn(text);
    return file;
}

EarthCurvature choose_curvature(const InputOptions& options, const HeightFile& file, Report& report)
{
    EarthCurvature curvature;
    curvature.coefficient = options.curvature.value_or(usual_coefficient(file.ground()));
    if (file.ground().body)
        curvature.radius_m = file.ground().body->local_radius_m;
    curvature.tangent_row = (static_cast<double>(file.rows()) - 1.0) / 2.0;
    curvature.tangent_column = (static_cast<double>(file.columns()) - 1.0) / 2.0;
    if (curvature.coefficient == 0.0)
        report.note("the ground is taken as flat");
    else
        report.note(fmt::format("the ground falls away by {:.4g} of the curvature of a globe of {:.0f} km",
                                curvature.coefficient, curvature.radius_m / 1000.0));
    return curvature;
}

Terrain read_lowered_terrain(HeightFile& file, const EarthCurvature& curvature, const Execution& execution)
{
    Terrain terrain = read_terrain(file, execution);
    if (curvature.coefficient != 0.0)
        CurvedEarth(curvature, terrain.cell_size_m, terrain.heights_m.columns())
            .lower(terrain.heights_m.view());
    return terrain;
}

void report_reading(const HeightFile& file, Report& report)
{
    const ReadTally& tally = file.tally();
    if (tally.cells > 0 && tally.no_data == tally.cells)
        report.warn(fmt::format("'{}' has no data in any cell", file.facts().path));
    if (tally.undeclared_voids > 0)
        report.note(fmt::format("{} cells hold numbers that are no heights (-32768, -9999, infinity) though "
                                "the file does not declare them: taken as no data",
                                tally.undeclared_voids));
}

} // namespace duskline::cli
