// Whether the casters that call themselves exact are, on real terrain under many suns.
//
// usage: check_exact [--suns N] [--seed N] [--side CELLS] [--cell-size METRES] [--ties] [-j N] PATH...
//
//   --suns N            random suns for each elevation model (terrains.h, random_sun); else 200
//   --seed N            of their random numbers; else 1
//   --side CELLS        looks at a square of so many cells in the middle of larger ones; else at all
//   --cell-size METRES  of all cells; else as the file says, and files that cannot say one are skipped
//   --ties              lists the cells that differ by float rounding too
//   -j N                threads; else all
//   PATH                an elevation model, or a folder: everything below it that is one
//
// Every other sun shines on a round earth. The truth is fast-ray. Prints a line for each model and caster, and one
// for each cell that is really wrong, not by float rounding; exits with 1 if there is any, 2 for wrong usage.

#include "mask_assertions.h"
#include "terrains.h"

#include <duskline/raster_io/file_errors.h>
#include <duskline/raster_io/read_height_field.h>
#include <duskline/terrain/earth_curvature.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace duskline {
namespace {

namespace fs = std::filesystem;

struct Options {
    std::size_t suns = 200;
    std::size_t seed = 1;
    std::size_t side = 0;
    std::size_t cell_size_m = 0;
    std::size_t threads = 0;
    bool ties = false;
    std::vector<fs::path> paths;
};

std::size_t as_number(std::string_view option, std::string_view text)
{
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size())
        throw std::invalid_argument(std::string(option) + " takes a whole number, got '" + std::string(text)
                                    + "'");
    return number;
}

Options parsed(const std::vector<std::string_view>& words)
{
    Options options;
    for (std::size_t i = 0; i < words.size(); ++i) {
        std::size_t* const number = words[i] == "--suns"        ? &options.suns
                                    : words[i] == "--seed"      ? &options.seed
                                    : words[i] == "--side"      ? &options.side
                                    : words[i] == "--cell-size" ? &options.cell_size_m
                                    : words[i] == "-j"          ? &options.threads
                                                                : nullptr;
        if (number != nullptr && i + 1 < words.size())
            *number = as_number(words[i], words[i + 1]), ++i;
        else if (words[i] == "--ties")
            options.ties = true;
        else if (!words[i].starts_with('-'))
            options.paths.emplace_back(words[i]);
        else
            throw std::invalid_argument("no option is called '" + std::string(words[i])
                                        + "', or its value is missing");
    }
    if (options.paths.empty())
        throw std::invalid_argument("give elevation models, or folders with some");
    return options;
}

std::vector<fs::path> files_of(const fs::path& path)
{
    if (!fs::is_directory(path))
        return {path};
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(path))
        if (entry.is_regular_file())
            files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

HeightField middle(const HeightField& field, std::size_t side)
{
    const std::size_t rows = side == 0 ? field.rows() : std::min(field.rows(), side);
    const std::size_t columns = side == 0 ? field.columns() : std::min(field.columns(), side);
    return field.window((field.rows() - rows) / 2, (field.columns() - columns) / 2, rows, columns);
}

// What one caster made of all suns over one elevation model.
struct Tally {
    std::size_t cells = 0;
    std::size_t shadow = 0;
    std::size_t ties = 0;          // differ, by float rounding
    std::size_t wrong = 0;         // differ, and should not
    double widest_tie_share = 0.0; // of the rounding allowed
    double seconds = 0.0;          // of the casts
    double slowest_s = 0.0;        // of them, and its light
    DirectionalLight slowest;
};

// The ground of a file, flat and round.
struct Ground {
    std::string name;
    Terrain flat;
    Terrain round;
};

Ground read_ground(const fs::path& path, const Options& options)
{
    ReadOptions reading;
    if (options.cell_size_m > 0)
        reading.cell_size_m = static_cast<double>(options.cell_size_m);
    HeightFile file(path.string(), reading);
    const Terrain all = read_terrain(file);
    Ground ground{path.string(), copy_of(middle(all, options.side)), copy_of(middle(all, options.side))};
    EarthCurvature curvature;
    if (file.ground().body)
        curvature.radius_m = file.ground().body->local_radius_m;
    curvature.tangent_row = (static_cast<double>(ground.round.heights_m.rows()) - 1.0) / 2.0;
    curvature.tangent_column = (static_cast<double>(ground.round.heights_m.columns()) - 1.0) / 2.0;
    CurvedEarth(curvature, ground.round.cell_size_m, ground.round.heights_m.columns())
        .lower(ground.round.heights_m.view());
    return ground;
}

// A height field with rays over it.
struct Scene {
    explicit Scene(const HeightField& heights)
        : field(heights), rays(heights), rounding_m(float_rounding_m(heights))
    {}

    HeightField field;
    TerrainRays rays;
    double rounding_m;
};

void print_cell(const char* what, const HeightField& field, const DirectionalLight& light, std::size_t row,
                std::size_t column, double shadow_m, Lit answer)
{
    std::printf(
        "  %s: row %zu, column %zu, azimuth %.17g, altitude %.17g: ground %.9g m, shadow %.17g m, called "
        "%s\n",
        what, row, column, light.azimuth.degrees(), light.altitude.degrees(),
        static_cast<double>(field.heights_m(row, column)), shadow_m,
        answer == Lit::yes ? "lit" : "in shadow");
}

void compare(const Scene& scene, const DirectionalLight& light, const ShadowMask& truth,
             const ShadowMask& mask, bool list_ties, Tally& tally)
{
    for (std::size_t row = 0; row < truth.rows(); ++row)
        for (std::size_t column = 0; column < truth.columns(); ++column) {
            tally.shadow += truth(row, column) == Lit::no ? 1U : 0U;
            if (mask(row, column) == truth(row, column))
                continue;
            const double shadow_m =
                scene.rays.shadow_height_m(static_cast<double>(row), static_cast<double>(column), light);
            const double apart_m =
                std::abs(static_cast<double>(scene.field.heights_m(row, column)) - shadow_m);
            if (apart_m <= scene.rounding_m) {
                ++tally.ties;
                if (list_ties)
                    print_cell("rounding", scene.field, light, row, column, shadow_m, mask(row, column));
                tally.widest_tie_share = std::max(tally.widest_tie_share, apart_m / scene.rounding_m);
            } else {
                ++tally.wrong;
                print_cell("wrong", scene.field, light, row, column, shadow_m, mask(row, column));
            }
        }
    tally.cells += truth.size();
}

void print(const Ground& ground, const Caster& caster, const Options& options, const Tally& tally)
{
    const double share =
        static_cast<double>(tally.shadow) / static_cast<double>(std::max<std::size_t>(tally.cells, 1));
    std::printf(
        "%s: %zu x %zu, %zu suns, %s: %zu cells (%.1f %% in shadow), %zu differ: %zu by rounding (at most "
        "%.2g of what is allowed), %zu wrong; cast in %.1f s, the slowest in %.0f ms (azimuth %.17g, "
        "altitude %.17g)\n",
        ground.name.c_str(), ground.flat.heights_m.rows(), ground.flat.heights_m.columns(), options.suns,
        std::string(caster.name).c_str(), tally.cells, 100.0 * share, tally.ties + tally.wrong, tally.ties,
        tally.widest_tie_share, tally.wrong, tally.seconds, 1e3 * tally.slowest_s,
        tally.slowest.azimuth.degrees(), tally.slowest.altitude.degrees());
    std::fflush(stdout);
}

std::vector<const Caster*> exact_casters()
{
    std::vector<const Caster*> casters;
    for (const Caster& caster : kCasters)
        if (caster.exact && !is_truth(caster))
            casters.push_back(&caster);
    return casters;
}

void cast_and_compare(const Scene& scene, const DirectionalLight& light, const ShadowMask& truth,
                      const Caster& caster, const Options& options, Tally& tally)
{
    const auto start = std::chrono::steady_clock::now();
    const ShadowMask mask = caster.cast(scene.field, light, {.threads = options.threads});
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    tally.seconds += seconds;
    if (seconds > tally.slowest_s) {
        tally.slowest_s = seconds;
        tally.slowest = light;
    }
    compare(scene, light, truth, mask, options.ties, tally);
}

// Returns the number of cells that are really wrong.
std::size_t check(const Ground& ground, const Options& options)
{
    const Scene flat(ground.flat);
    const Scene round(ground.round);
    const std::vector<const Caster*> casters = exact_casters();
    std::vector<Tally> tallies(casters.size());
    Dice dice(options.seed);
    for (std::size_t sun = 0; sun < options.suns; ++sun) {
        const Scene& scene = sun % 2 == 1 ? round : flat;
        const DirectionalLight light = random_sun(dice, scene.field.cell_size_m);
        const ShadowMask truth = scene.rays.cast(light, {.threads = options.threads});
        for (std::size_t i = 0; i < casters.size(); ++i)
            cast_and_compare(scene, light, truth, *casters[i], options, tallies[i]);
    }
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < casters.size(); ++i) {
        print(ground, *casters[i], options, tallies[i]);
        wrong += tallies[i].wrong;
    }
    return wrong;
}

std::size_t check_all(const Options& options)
{
    std::size_t wrong = 0;
    for (const fs::path& path : options.paths)
        for (const fs::path& file : files_of(path)) {
            try {
                wrong += check(read_ground(file, options), options);
            } catch (const InputError& error) {
                std::printf("%s: skipped: %s\n", file.c_str(), error.what());
            }
        }
    return wrong;
}

int run(const std::vector<std::string_view>& words)
{
    try {
        prepare_gdal_for_program();
        return check_all(parsed(words)) == 0 ? 0 : 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "check_exact: %s\n", error.what());
        return 2;
    }
}

} // namespace
} // namespace duskline

int main(int argc, char** argv)
{
    return duskline::run({argv + 1, argv + argc});
}
