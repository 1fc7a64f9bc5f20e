// Pictures of a silhouette map: what is Black, the beams, and how the search for NextV goes on.
//
//   draw_silhouette_map silhouettes DEM AZIMUTH ALTITUDE OUT.ppm   black where the light sees an edge of the ground
//   draw_silhouette_map beams       DEM AZIMUTH ALTITUDE OUT.ppm   the sections of a small window, a colour per beam
//   draw_silhouette_map passes      DEM AZIMUTH ALTITUDE OUT.ppm   the map after passes with D = 1, 4, 16, 64, 256:
//                                                                  NextV in red, Black in blue
#include <duskline/casting/smap.h>
#include <duskline/raster_io/read_height_field.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <exception>
#include <fstream>
#include <iostream>
#include <string>

namespace {

using namespace duskline;

using Colour = std::array<std::uint8_t, 3>;
using Picture = Grid<Colour>;

constexpr Colour kWhite{255, 255, 255};

void write_ppm(const Picture& picture, const std::string& path)
{
    std::ofstream out(path, std::ios::binary);
    out << "P6\n" << picture.columns() << ' ' << picture.rows() << "\n255\n";
    for (const Colour& colour : picture.values())
        out.write(reinterpret_cast<const char*>(colour.data()), 3);
    out.close();
    if (!out)
        throw std::runtime_error("cannot write '" + path + "'");
}

// The cell nearest the middle of a section, in the rows and columns of the grid.
struct Cell {
    std::size_t row;
    std::size_t column;
};

Cell cell_of(const SilhouetteMap& map, std::size_t v, std::size_t x)
{
    const auto cells = static_cast<double>(map.texels().columns() - 1);
    const double middle = static_cast<double>(x) - 0.5 + static_cast<double>(map.lines()[v].part);
    const auto u = static_cast<std::size_t>(std::clamp(std::floor(middle), 0.0, cells - 1.0));
    const std::size_t line = map.frame().first_line_is_index_0 ? v : map.texels().rows() - 1 - v;
    return map.frame().lines_are_rows ? Cell{line, u} : Cell{u, line};
}

// Every pixel is 4 x 4 cells, the darker the more of them are Black.
Picture draw_silhouettes(const Terrain& terrain, const SilhouetteMap& map)
{
    constexpr std::size_t cells = 4;
    Grid<int> black((terrain.heights_m.rows() + cells - 1) / cells,
                    (terrain.heights_m.columns() + cells - 1) / cells, 0);
    for (std::size_t v = 0; v < map.texels().rows(); ++v)
        for (std::size_t x = 0; x < map.texels().columns(); ++x)
            if (map.texels()(v, x).is_black()) {
                const Cell cell = cell_of(map, v, x);
                ++black(cell.row / cells, cell.column / cells);
            }
    Picture picture(black.rows(), black.columns());
    std::ranges::transform(black.values(), picture.values().begin(), [](int count) {
        const auto shade = static_cast<std::uint8_t>(255 - std::min(255, 40 * count));
        return Colour{shade, shade, shade};
    });
    return picture;
}

// Lines from top to bottom, nearest the light first. A bar for each section, dark where it is Black, brown where there
// is no ground; dots are the samples.
Picture draw_beams(const SilhouetteMap& map)
{
    constexpr std::size_t pixels = 24;
    constexpr std::array<Colour, 6> beams = {Colour{244, 199, 123}, Colour{160, 205, 235},
                                             Colour{186, 220, 160}, Colour{236, 170, 170},
                                             Colour{200, 185, 230}, Colour{225, 225, 150}};
    constexpr Colour brown{150, 110, 80};
    const auto texels = map.texels();
    const std::size_t cells = texels.columns() - 1;
    const std::size_t left = 2 * pixels; // of the first sample
    Picture picture(texels.rows() * pixels, (cells + 3) * pixels, kWhite);
    const auto fill = [&](std::size_t y, std::size_t x, std::size_t rows, std::size_t columns,
                          Colour colour) {
        for (std::size_t i = y; i < y + rows; ++i)
            std::ranges::fill(picture.row(i).subspan(x, columns), colour);
    };
    for (std::size_t v = 0; v < texels.rows(); ++v) {
        const SilhouetteLineFacts& line = map.lines()[v];
        for (std::size_t x = 0; x <= cells; ++x) {
            const auto beam = static_cast<std::size_t>((static_cast<int>(x) - line.shift + 6'000'000) % 6);
            const bool outside = x == cells && line.part > 0.0f;
            Colour colour = outside ? brown : beams[beam];
            if (texels(v, x).is_black())
                std::ranges::transform(colour, colour.begin(),
                                       [](int c) { return static_cast<std::uint8_t>(c * 2 / 5); });
            const auto from = static_cast<std::size_t>(static_cast<float>(left + x * pixels)
                                                       - (1.0f - line.part) * static_cast<float>(pixels));
            fill(v * pixels + 4, from + 1, pixels - 8, pixels - 2, colour);
        }
        for (std::size_t u = 0; u < cells; ++u)
            fill(v * pixels + pixels / 2 - 2, left + u * pixels - 2, 4, 4, {20, 20, 20});
    }
    return picture;
}

// A pixel for 2 x 2 texels of the map, the highest NextV of them, red the brighter the nearer it is.
void draw_pass(const SilhouetteMap& map, std::size_t distance, Picture& picture, std::size_t left)
{
    const auto texels = map.texels();
    for (std::size_t v = 0; v < texels.rows(); ++v)
        for (std::size_t x = 0; x + 1 < texels.columns(); ++x) {
            const SilhouetteTexel texel = texels(v, x);
            Colour& pixel = picture(v / 2, left + x / 2);
            if (texel.is_black())
                pixel[2] = 255;
            // Blocks of 4 D lines know their own silhouettes then, and no others.
            const auto block = static_cast<std::int32_t>(v / (4 * distance) * (4 * distance));
            if (!texel.has_next() || texel.next_v() < block)
                continue;
            const auto lines = static_cast<double>(static_cast<std::int32_t>(v) - texel.next_v());
            const double near = 1.0 - std::log2(lines) / std::log2(static_cast<double>(texels.rows()));
            pixel[0] = std::max(pixel[0], static_cast<std::uint8_t>(55.0 + 200.0 * near));
        }
}

Picture draw_passes(const SilhouetteMap& map)
{
    constexpr std::array<std::size_t, 5> distances = {1, 4, 16, 64, 256};
    constexpr std::size_t gap = 8;
    const std::size_t width = (map.texels().columns() - 1 + 1) / 2;
    Picture picture((map.texels().rows() + 1) / 2, distances.size() * (width + gap) - gap, kWhite);
    for (std::size_t i = 0; i < distances.size(); ++i) {
        const std::size_t left = i * (width + gap);
        for (std::size_t y = 0; y < picture.rows(); ++y)
            std::ranges::fill(picture.row(y).subspan(left, width), Colour{0, 0, 0});
        draw_pass(map, distances[i], picture, left);
    }
    return picture;
}

// A part of the grid around its highest cell.
HeightField around_summit(const HeightField& field, std::size_t rows, std::size_t columns)
{
    const HeightRange range = height_range(field);
    std::size_t row = 0;
    std::size_t column = 0;
    for (std::size_t y = 0; y < field.rows(); ++y)
        for (std::size_t x = 0; x < field.columns(); ++x)
            if (field.heights_m(y, x) == range.highest_m) {
                row = y;
                column = x;
            }
    const auto first = [](std::size_t middle, std::size_t part, std::size_t all) {
        return std::min(middle - std::min(middle, part / 2), all - part);
    };
    rows = std::min(rows, field.rows());
    columns = std::min(columns, field.columns());
    return field.window(first(row, rows, field.rows()), first(column, columns, field.columns()), rows,
                        columns);
}

Picture draw(const std::string& kind, const Terrain& terrain, const DirectionalLight& light)
{
    if (kind == "silhouettes")
        return draw_silhouettes(terrain, SilhouetteMap(terrain, light));
    if (kind == "beams")
        return draw_beams(SilhouetteMap(around_summit(terrain, 14, 24), light));
    if (kind == "passes")
        return draw_passes(SilhouetteMap(around_summit(terrain, 512, 512), light, {.better_next_v = false}));
    throw std::runtime_error("no picture is called '" + kind + "'; there are: silhouettes, beams, passes");
}

} // namespace

int main(int argc, char** argv)
try {
    if (argc != 6) {
        std::cerr << "usage: draw_silhouette_map silhouettes|beams|passes DEM AZIMUTH ALTITUDE OUT.ppm\n";
        return 2;
    }
    HeightFile file(argv[2]);
    const DirectionalLight light{.azimuth = Angle::from_degrees(std::stod(argv[3])),
                                 .altitude = Angle::from_degrees(std::stod(argv[4]))};
    write_ppm(draw(argv[1], read_terrain(file), light), argv[5]);
    return 0;
} catch (const std::exception& error) {
    std::cerr << "draw_silhouette_map: " << error.what() << '\n';
    return 1;
}
