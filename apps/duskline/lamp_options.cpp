#include "lamp_options.h"

#include "exit_code.h"
#include "height_input.h"
#include "option_values.h"

#include <duskline/raster_io/map_place.h>
#include <duskline/terrain/ground_height.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace duskline::cli {
namespace {

constexpr auto kGroup = "Light";

// Lamps this many times the raster's size away were hardly meant.
constexpr double kFarOutside = 10.0;

struct MapPoint {
    double x;
    double y;
    double z_m;
    bool above_ground;
};

MapPoint parse_point(const std::string& text)
{
    const std::size_t first = text.find(',');
    const std::size_t second = first == std::string::npos ? first : text.find(',', first + 1);
    if (second == std::string::npos || text.find(',', second + 1) != std::string::npos)
        throw UsageError(fmt::format("--point must be X,Y,Z in map coordinates and metres such as "
                                     "243500,2193200,4250, or X,Y,+30 for 30 m above the ground; got '{}'",
                                     text));
    const std::string z = text.substr(second + 1);
    return {parse_number("X of --point", text.substr(0, first)),
            parse_number("Y of --point", text.substr(first + 1, second - first - 1)),
            parse_number("Z of --point", z), z.starts_with('+')};
}

// How far a coordinate lies outside the samples 0 .. count - 1.
double outside(double place, std::size_t count)
{
    return std::max({0.0 - place, place - (static_cast<double>(count) - 1.0), 0.0});
}

// The ground at a place as casters see it: lowered, less the file's base.
std::optional<double> ground_at(HeightFile& file, const EarthCurvature& curvature, const GridPlace& place)
{
    const auto inside = [](double coordinate, std::size_t count) {
        return static_cast<std::size_t>(
            std::clamp(std::floor(coordinate), 0.0, static_cast<double>(count) - 1.0));
    };
    const std::size_t row = inside(place.row, file.rows());
    const std::size_t column = inside(place.column, file.columns());
    Terrain around{Grid<float>(std::min<std::size_t>(2, file.rows() - row),
                               std::min<std::size_t>(2, file.columns() - column)),
                   file.ground().cell_size_m};
    file.read(row, column, around.heights_m.view());
    if (curvature.coefficient != 0.0)
        CurvedEarth(curvature, around.cell_size_m, file.columns())
            .lower(around.heights_m.view(), row, column);
    return ground_height_m(around, place.row - static_cast<double>(row),
                           place.column - static_cast<double>(column));
}

// How far the ground at a place lies under the plane that touches the globe.
double drop_m(const EarthCurvature& curvature, CellSize cell_size_m, const GridPlace& place)
{
    const double distance_m = std::hypot((place.row - curvature.tangent_row) * cell_size_m.y,
                                         (place.column - curvature.tangent_column) * cell_size_m.x);
    return curvature_drop_m(distance_m, curvature.coefficient, curvature.radius_m);
}

void report_place(const ChosenLamp& lamp, const HeightFile& file, Report& report)
{
    const auto [x_m, y_m] = file.ground().cell_size_m;
    const double away_m = std::hypot(outside(lamp.light.position.row, file.rows()) * y_m,
                                     outside(lamp.light.position.column, file.columns()) * x_m);
    if (away_m == 0.0)
        return;
    const double size_m =
        std::hypot(static_cast<double>(file.rows()) * y_m, static_cast<double>(file.columns()) * x_m);
    const std::string text =
        fmt::format("the lamp {} lies {:.3g} km outside the raster", in_words(lamp), away_m / 1000.0);
    if (away_m > kFarOutside * size_m)
        report.warn(text + ": --point takes coordinates of the raster's own system");
    else
        report.note(text + ": what lies between casts no shadow");
}

ChosenLamp choose_lamp(const std::string& text, HeightFile& file, const EarthCurvature& curvature,
                       Report& report)
{
    const MapPoint point = parse_point(text);
    const GridPlace place = grid_place(file.facts(), point.x, point.y);
    const std::optional<double> ground_m = ground_at(file, curvature, place);
    if (point.above_ground && !ground_m)
        throw UsageError(
            fmt::format("--point {}: there is no ground at that place to stand above (outside the "
                        "raster, or no data); give the height itself, without '+'",
                        text));
    const double lowered_m = drop_m(curvature, file.ground().cell_size_m, place);
    const double base_m = file.facts().base_m;
    ChosenLamp lamp{point.x, point.y, point.z_m, {}};
    const double seen_m = point.above_ground ? *ground_m + point.z_m : point.z_m - base_m - lowered_m;
    if (point.above_ground)
        lamp.height_m = seen_m + base_m + lowered_m;
    lamp.light.position = {place.row, place.column, seen_m};
    require_valid(lamp.light);
    report_place(lamp, file, report);
    if (ground_m && seen_m < *ground_m - 1e-6)
        report.warn(fmt::format("the lamp {} lies {:.4g} m below the ground: it lights nothing",
                                in_words(lamp), *ground_m - seen_m));
    return lamp;
}

} // namespace

void add_point_option(CLI::App& app, LampOptions& options, const std::string& more)
{
    app.add_option("--point", options.points,
                   "instead of the sun a lamp at map coordinates X,Y, Z metres high, or +Z metres above the "
                   "ground"
                       + more)
        ->type_name("X,Y,Z")
        ->allow_extra_args(false)
        ->group(kGroup);
}

void add_lamp_options(CLI::App& app, LampOptions& options)
{
    add_point_option(app, options, "; may be repeated: lit is what at least one lamp lights");
    app.add_flag("--count", options.count,
                 "write how many of the lamps light each cell, 0 to 254; 255 no data")
        ->group("Output");
}

void require_point(const std::string& text)
{
    parse_point(text);
}

void require_lamps_or_sun(const LampOptions& lamps, const LightOptions& sun)
{
    if (lamps.count && !lamps.given())
        throw UsageError("--count counts lamps: give --point too");
    if (!lamps.given())
        return;
    if (asks_for_light(sun))
        throw UsageError("give --point, or --azimuth and --altitude, or --time, not both");
    if (sun.sun_size_deg)
        throw UsageError(
            "--sun-size is the size of a sun: it goes with --azimuth or --time, not with --point");
    if (lamps.count && lamps.points.size() > 254)
        throw UsageError(fmt::format("--count takes at most 254 lamps, got {}", lamps.points.size()));
}

std::vector<ChosenLamp> choose_lamps(const LampOptions& options, const InputOptions& input,
                                     const RunOptions& run, const HeightFile& file,
                                     const EarthCurvature& curvature, Report& report)
{
    for (const std::string& text : options.points)
        require_point(text); // all mistakes before any work
    if (!file.facts().geotransform)
        report.note("the raster has no map coordinates: --point counts pixels from its upper left corner");
    HeightFile again(input.path, read_options(input, run));
    std::vector<ChosenLamp> lamps;
    for (const std::string& text : options.points)
        lamps.push_back(choose_lamp(text, again, curvature, report));
    return lamps;
}

std::string in_words(const ChosenLamp& lamp)
{
    return fmt::format("{:.10g},{:.10g},{:.6g}", lamp.x, lamp.y, lamp.height_m);
}

} // namespace duskline::cli
