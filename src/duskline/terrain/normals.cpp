#include <duskline/execution/for_rows.h>
#include <duskline/terrain/normals.h>

#include <cassert>
#include <cmath>
#include <limits>

namespace duskline {

namespace {

constexpr std::size_t kRowsPerPiece = 16;
constexpr double kPackedOne = 127.0; // the byte that stands for 1

NormalField unset_normals(std::size_t rows, std::size_t columns)
{
    return {Grid<float>(rows, columns), Grid<float>(rows, columns), Grid<float>(rows, columns)};
}

// Differences first: neighbouring heights are so alike that theirs are exact, or nearly so, in float.
float weighted(float first, float middle, float last)
{
    return (first + last) + 2.0f * middle;
}

// The sample `down` rows south and `right` columns east of a cell; NaN beyond the border.
float sample(GridView<const float> heights_m, std::size_t row, std::size_t column, int down, int right)
{
    // Off the first row or column the sum wraps to a number that no grid reaches.
    row += static_cast<std::size_t>(down);
    column += static_cast<std::size_t>(right);
    if (row >= heights_m.rows() || column >= heights_m.columns())
        return std::numeric_limits<float>::quiet_NaN();
    return heights_m(row, column);
}

// Rise over two steps of a line of three samples; of its half when an end is missing, NaN when more is.
float rise(float first, float middle, float last)
{
    if (std::isnan(first))
        return 2.0f * (last - middle);
    if (std::isnan(last))
        return 2.0f * (middle - first);
    return last - first;
}

// Horn's sum of the lines that have a rise, as if the others had their mean.
float weighted_of_known(float first, float middle, float last)
{
    float sum = 0.0f;
    float weights = 0.0f;
    const auto add = [&](float weight, float value) {
        if (std::isnan(value))
            return;
        sum += weight * value;
        weights += weight;
    };
    add(1.0f, first);
    add(1.0f, last);
    add(2.0f, middle);
    return weights > 0.0f ? sum * (4.0f / weights) : 0.0f;
}

} // namespace

Slope slope_at(const HeightField& field, std::size_t row, std::size_t column)
{
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    if (std::isnan(field.heights_m(row, column)))
        return {nan, nan};
    const auto z = [&](int down, int right) { return sample(field.heights_m, row, column, down, right); };
    const auto eastwards = [&](int down) { return rise(z(down, -1), z(down, 0), z(down, 1)); };
    const auto northwards = [&](int right) { return rise(z(1, right), z(0, right), z(-1, right)); };
    return {weighted_of_known(eastwards(-1), eastwards(0), eastwards(1)) / (8.0 * field.cell_size_m.x),
            weighted_of_known(northwards(-1), northwards(0), northwards(1)) / (8.0 * field.cell_size_m.y)};
}

void slopes_of_row(const HeightField& field, std::size_t row, std::span<float> dz_dx, std::span<float> dz_dy)
{
    const std::size_t columns = field.columns();
    assert(row < field.rows() && dz_dx.size() == columns && dz_dy.size() == columns);
    const auto slowly = [&](std::size_t column) {
        const Slope slope = slope_at(field, row, column);
        dz_dx[column] = static_cast<float>(slope.dz_dx);
        dz_dy[column] = static_cast<float>(slope.dz_dy);
    };
    if (row == 0 || row + 1 == field.rows() || columns < 3) {
        for (std::size_t column = 0; column < columns; ++column)
            slowly(column);
        return;
    }

    const float* north = field.heights_m.row(row - 1).data();
    const float* here = field.heights_m.row(row).data();
    const float* south = field.heights_m.row(row + 1).data();
    const double across_m = 8.0 * field.cell_size_m.x;
    const double up_m = 8.0 * field.cell_size_m.y;
    for (std::size_t x = 1; x + 1 < columns; ++x) {
        dz_dx[x] = static_cast<float>(
            weighted(north[x + 1] - north[x - 1], here[x + 1] - here[x - 1], south[x + 1] - south[x - 1])
            / across_m);
        dz_dy[x] = static_cast<float>(
            weighted(north[x - 1] - south[x - 1], north[x] - south[x], north[x + 1] - south[x + 1]) / up_m);
    }
    slowly(0);
    slowly(columns - 1);
    // Missing neighbours, and a missing cell among present ones, have made NaN of what they touched.
    for (std::size_t x = 1; x + 1 < columns; ++x)
        if (std::isnan(dz_dx[x] + dz_dy[x] + here[x]))
            slowly(x);
}

NormalField upward_normals(const HeightField& field, const Execution& execution)
{
    require_valid(field);
    NormalField normals = unset_normals(field.rows(), field.columns());
    for_rows(field.rows(), kRowsPerPiece, execution, [&](std::size_t first, std::size_t last) {
        for (std::size_t row = first; row < last; ++row) {
            const auto east = normals.east.row(row);
            const auto north = normals.north.row(row);
            const auto up = normals.up.row(row);
            slopes_of_row(field, row, east, north);
            for (std::size_t x = 0; x < up.size(); ++x) {
                up[x] = 1.0f / std::sqrt(1.0f + east[x] * east[x] + north[x] * north[x]);
                east[x] *= -up[x];
                north[x] *= -up[x];
            }
        }
    });
    return normals;
}

PackedNormal packed(Vector3 normal)
{
    if (std::isnan(normal.z))
        return {0, 0, 0};
    const auto byte = [](double component) {
        return static_cast<std::int8_t>(std::lround(kPackedOne * component));
    };
    return {byte(normal.x), byte(normal.y), byte(normal.z)};
}

Vector3 unpacked(PackedNormal bytes)
{
    if (bytes == PackedNormal{0, 0, 0}) {
        constexpr double nan = std::numeric_limits<double>::quiet_NaN();
        return {nan, nan, nan};
    }
    return normalized(
        {static_cast<double>(bytes[0]), static_cast<double>(bytes[1]), static_cast<double>(bytes[2])});
}

NormalField through_bytes(const NormalField& normals, const Execution& execution)
{
    NormalField result = unset_normals(normals.rows(), normals.columns());
    for_rows(normals.rows(), kRowsPerPiece, execution, [&](std::size_t first, std::size_t last) {
        for (std::size_t row = first; row < last; ++row)
            for (std::size_t x = 0; x < normals.columns(); ++x) {
                const Vector3 back =
                    unpacked(packed({normals.east(row, x), normals.north(row, x), normals.up(row, x)}));
                result.east(row, x) = static_cast<float>(back.x);
                result.north(row, x) = static_cast<float>(back.y);
                result.up(row, x) = static_cast<float>(back.z);
            }
    });
    return result;
}

} // namespace duskline
