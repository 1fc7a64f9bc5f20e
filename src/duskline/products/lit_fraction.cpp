#include <duskline/casting/ray.h>
#include <duskline/execution/for_rows.h>
#include <duskline/products/lit_fraction.h>
#include <duskline/terrain/ground_height.h>
#include <duskline/terrain/refined.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace duskline {

namespace {

constexpr std::size_t kRowsPerPiece = 32;
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

// Ground less shadow height, within +-most_m, one row at a time.
class Clearances {
public:
    Clearances(const HeightField& field, const ShadowField& shadow_heights_m, float most_m)
        : field_(field), shadow_heights_m_(shadow_heights_m), most_m_(most_m)
    {}

    void fill(std::size_t row, std::vector<float>& out) const
    {
        const auto ground_m = field_.heights_m.row(row);
        const auto shadow_m = shadow_heights_m_.row(row);
        for (std::size_t x = 0; x < out.size(); ++x) {
            const float clearance_m = ground_m[x] - shadow_m[x];
            out[x] = std::isnan(clearance_m) ? clearance_m : std::clamp(clearance_m, -most_m_, most_m_);
        }
    }

private:
    const HeightField& field_;
    const ShadowField& shadow_heights_m_;
    float most_m_;
};

// The clearances of a cell (index 4) and its neighbours, row by row.
using Neighbourhood = std::array<float, 9>;

bool all_agree(const Neighbourhood& clearances)
{
    const bool lit = clearances[4] >= 0.0f;
    return std::all_of(clearances.begin(), clearances.end(), [lit](float c) { return (c >= 0.0f) == lit; });
}

// Where the points of the 4 x 4 lie between the two nearest of three centres.
struct Between {
    std::size_t first;
    float t;
};
constexpr std::array<Between, 4> kPoints = {{{0, 0.625f}, {0, 0.875f}, {1, 0.125f}, {1, 0.375f}}};

// The part of the middle cell where the bilinear clearance is at least 0.
float lit_part(const Neighbourhood& c)
{
    int lit = 0;
    for (const Between& down : kPoints)
        for (const Between& across : kPoints) {
            const float* corner = &c[down.first * 3 + across.first];
            const float upper = corner[0] + (corner[1] - corner[0]) * across.t;
            const float lower = corner[3] + (corner[4] - corner[3]) * across.t;
            lit += upper + (lower - upper) * down.t >= 0.0f ? 1 : 0;
        }
    return static_cast<float>(lit) / 16.0f;
}

// Three rows of clearances, the middle one the row in question; beyond the grid the nearest row again.
class RowWindow {
public:
    RowWindow(const Clearances& clearances, std::size_t rows, std::size_t columns)
        : clearances_(clearances), rows_(rows)
    {
        for (auto& row : around_)
            row.resize(columns);
    }

    void move_to(std::size_t row)
    {
        clearances_.fill(row == 0 ? 0 : row - 1, around_[0]);
        clearances_.fill(row, around_[1]);
        clearances_.fill(std::min(row + 1, rows_ - 1), around_[2]);
    }

    float middle(std::size_t x) const { return around_[1][x]; }

    // Who is missing agrees with the middle.
    Neighbourhood at(std::size_t x) const
    {
        const std::size_t columns = around_[1].size();
        const std::array<std::size_t, 3> places = {x == 0 ? 0 : x - 1, x, std::min(x + 1, columns - 1)};
        Neighbourhood result;
        for (std::size_t y = 0; y < 3; ++y)
            for (std::size_t i = 0; i < 3; ++i) {
                const float value = around_[y][places[i]];
                result[y * 3 + i] = std::isnan(value) ? around_[1][x] : value;
            }
        return result;
    }

private:
    const Clearances& clearances_;
    std::size_t rows_;
    std::array<std::vector<float>, 3> around_;
};

float most_clearance_m(const HeightField& field, const DirectionalLight& light)
{
    const double diagonal_m = std::hypot(field.cell_size_m.x, field.cell_size_m.y);
    return static_cast<float>(diagonal_m * tangent(light.altitude));
}

// The lit share of 4 x 4 points that are on the ground; `row` and `column` are those of the middle of a cell that
// measures `size_down` x `size_across` cells of the terrain.
float sampled_part(const HeightField& field, const TerrainRays& rays, const DirectionalLight& light,
                   double row, double column, double size_down, double size_across)
{
    constexpr std::array<double, 4> offsets = {-0.375, -0.125, 0.125, 0.375};
    int lit = 0;
    int points = 0;
    for (const double down : offsets)
        for (const double across : offsets) {
            const double y = row + down * size_down;
            const double x = column + across * size_across;
            const std::optional<double> ground_m = ground_height_m(field, y, x);
            if (!ground_m)
                continue;
            ++points;
            lit += rays.is_shadowed({y, x, *ground_m}, light) ? 0 : 1;
        }
    return static_cast<float>(lit) / static_cast<float>(points);
}

void require_size(const HeightField& field, const char* what, std::size_t rows, std::size_t columns)
{
    if (rows != field.rows() || columns != field.columns())
        throw InvalidInput(std::string(what) + " must have the size of the terrain, "
                           + std::to_string(field.rows()) + " x " + std::to_string(field.columns()) + ", got "
                           + std::to_string(rows) + " x " + std::to_string(columns));
}

} // namespace

LitFraction super_sampled_lit_fraction(const HeightField& field, const ShadowMask& mask,
                                       const DirectionalLight& light, const Execution& execution)
{
    require_size(field, "a mask", mask.rows(), mask.columns());
    return finer_super_sampled_lit_fraction(field, mask, light, execution);
}

LitFraction finer_super_sampled_lit_fraction(const HeightField& field, const ShadowMask& finer_mask,
                                             const DirectionalLight& light, const Execution& execution)
{
    require_valid(field);
    require_valid(light);
    if (finer_mask.rows() < field.rows() || finer_mask.columns() < field.columns())
        require_size(field, "a mask of finer cells, or more", finer_mask.rows(), finer_mask.columns());
    LitFraction result = lit_fraction(finer_mask, {.threads = execution.threads});
    if (uniform_answer(light) || field.heights_m.empty())
        return result;
    const TerrainRays rays(field, {.threads = execution.threads});
    const std::vector<FinerPlace> columns = finer_places(result.columns(), field.columns());
    const double down = static_cast<double>(field.rows()) / static_cast<double>(result.rows());
    const double across = static_cast<double>(field.columns()) / static_cast<double>(result.columns());
    for_rows(result.rows(), 4, execution, [&](std::size_t first, std::size_t last) {
        for (std::size_t y = first; y < last; ++y) {
            const double row = finer_place(y, result.rows(), field.rows()).place;
            for (std::size_t x = 0; x < result.columns(); ++x)
                if (finer_mask(y, x) != Lit::unknown && has_other_neighbour(finer_mask, y, x)) {
                    const float part = sampled_part(field, rays, light, row, columns[x].place, down, across);
                    result(y, x) = std::isnan(part) ? result(y, x) : part; // a sample between holes
                }
        }
    });
    return result;
}

LitFraction lit_fraction(const ShadowMask& mask, const Execution& execution)
{
    LitFraction result(mask.rows(), mask.columns());
    for_rows(mask.rows(), kRowsPerPiece, execution, [&](std::size_t first, std::size_t last) {
        for (std::size_t y = first; y < last; ++y)
            std::transform(mask.row(y).begin(), mask.row(y).end(), result.row(y).begin(), [](Lit lit) {
                return lit == Lit::unknown ? kUnknown : lit == Lit::yes ? 1.0f : 0.0f;
            });
    });
    return result;
}

LitFraction lit_fraction(const HeightField& field, const ShadowField& shadow_heights_m,
                         const DirectionalLight& light, const Execution& execution)
{
    require_valid(field);
    require_valid(light);
    require_size(field, "shadow heights", shadow_heights_m.rows(), shadow_heights_m.columns());
    if (const auto answer = uniform_answer(light))
        return lit_fraction(uniform_mask(field, *answer), execution);

    const Clearances clearances(field, shadow_heights_m, most_clearance_m(field, light));
    LitFraction result(field.rows(), field.columns());
    for_rows(field.rows(), kRowsPerPiece, execution, [&](std::size_t first, std::size_t last) {
        RowWindow window(clearances, field.rows(), field.columns());
        for (std::size_t y = first; y < last; ++y) {
            window.move_to(y);
            const auto out = result.row(y);
            for (std::size_t x = 0; x < out.size(); ++x) {
                const float clearance_m = window.middle(x);
                const Neighbourhood around = window.at(x);
                if (std::isnan(clearance_m))
                    out[x] = kUnknown;
                else if (all_agree(around))
                    out[x] = clearance_m >= 0.0f ? 1.0f : 0.0f;
                else
                    out[x] = lit_part(around);
            }
        }
    });
    return result;
}

} // namespace duskline
