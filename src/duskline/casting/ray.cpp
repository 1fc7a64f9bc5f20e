// Shadows by marching rays: the definition, in double precision.
//
// In the frame of the light (light_frame.h) a ray from (v0, u0) towards the light climbs drop_m per line and
// moves -lateral cells per line. After s lines it is at
//
//      v = v0 - s        u = u0 - lateral s        height = h0 + drop s
//
//           o-----o--x--o-----o   line v0 - 2      x: crossings with lines, s such that v is whole
//           |     | /   |     |                    +: crossings with the lines between cells of equal u,
//           |     |/    |     |                       s such that u is whole
//           |     +     |     |
//           o----x|-----o-----o   line v0 - 1
//           |   / |     |     |
//           o--P--o-----o-----o
//
// The surface is linear between the two samples beside a crossing. Every crossing is computed from its own
// index, so that no error adds up along the ray and whoever leaves crossings out (the pyramid) finds the
// same numbers at the others.

#include <duskline/casting/light_frame.h>
#include <duskline/casting/ray.h>
#include <duskline/execution/for_rows.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace duskline {

namespace {

// A ray that runs along the border within this distance is on it: a light a millionth of a degree off the
// axis must not leave the outermost row of cells without shadow. In cells.
constexpr double kBorderSlack = 1e-6;

constexpr double kNothing = -std::numeric_limits<double>::infinity();

// The rays of one light over one terrain.
class March {
public:
    March(const HeightField& field, const DirectionalLight& light)
        : frame_(light_frame(light, field.cell_size_m)), heights_(in_light_order(field.heights_m, frame_)),
          last_line_(static_cast<double>(heights_.lines) - 1.0),
          last_cell_(static_cast<double>(heights_.cells) - 1.0)
    {
        double highest = kNothing;
        for (std::size_t y = 0; y < field.rows(); ++y)
            for (const float h : field.heights_m.row(y))
                highest = h > highest ? h : highest;
        highest_m_ = highest;
    }

    const LightOrder<const float>& heights() const { return heights_; }

    // The highest shadow over (v0, u0), for which crossings count only while they can raise it above
    // `at_least_m`: what comes back is right when above that, and else somewhere at or below it.
    double shadow_height_m(double v0, double u0, double at_least_m) const
    {
        const double slope = std::abs(frame_.lateral);
        const double to_border = frame_.lateral > 0.0 ? u0 : last_cell_ - u0;
        const double end = slope > 0.0 ? std::min(v0, (to_border + kBorderSlack) / slope) : v0;
        // The first crossings beyond the start: s grows by 1 from line to line, by 1 / slope from cell to
        // cell.
        const double first_line_s = v0 - (std::ceil(v0) - 1.0);
        const double first_cell = frame_.lateral > 0.0 ? std::ceil(u0) - 1.0 : std::floor(u0) + 1.0;
        const double cell_step = frame_.lateral > 0.0 ? -1.0 : 1.0;

        double shadow_m = at_least_m;
        double cell = first_cell;
        double cell_s = slope > 0.0 ? std::abs(u0 - cell) / slope : std::numeric_limits<double>::infinity();
        for (double i = 0.0;; ++i) {
            const double line_s = first_line_s + i;
            for (; cell_s < line_s && cell_s <= end; cell += cell_step, cell_s = std::abs(u0 - cell) / slope)
                shadow_m =
                    std::max(shadow_m, surface_on_cell_line_m(v0 - cell_s, cell) - frame_.drop_m * cell_s);
            if (line_s > end || highest_m_ - frame_.drop_m * line_s < shadow_m)
                return shadow_m;
            shadow_m = std::max(shadow_m, surface_on_line_m(v0 - line_s, u0 - frame_.lateral * line_s)
                                              - frame_.drop_m * line_s);
        }
    }

private:
    static double between(float a, float b, double t)
    {
        if (t == 0.0)
            return std::isnan(a) ? kNothing : static_cast<double>(a);
        const double height = a + (static_cast<double>(b) - a) * t;
        return std::isnan(height) ? kNothing : height;
    }

    double surface_on_line_m(double v, double u) const
    {
        u = std::clamp(u, 0.0, last_cell_);
        const double left = std::floor(u);
        const auto line = static_cast<std::size_t>(v);
        const auto cell = static_cast<std::size_t>(left);
        const auto next = std::min(cell + 1, heights_.cells - 1);
        return between(heights_.at(line, cell), heights_.at(line, next), u - left);
    }

    double surface_on_cell_line_m(double v, double u) const
    {
        v = std::clamp(v, 0.0, last_line_);
        const double nearer = std::floor(v);
        const auto line = static_cast<std::size_t>(nearer);
        const auto cell = static_cast<std::size_t>(std::clamp(u, 0.0, last_cell_));
        const auto next = std::min(line + 1, heights_.lines - 1);
        return between(heights_.at(line, cell), heights_.at(next, cell), v - nearer);
    }

    LightFrame frame_;
    LightOrder<const float> heights_;
    double last_line_;
    double last_cell_;
    double highest_m_;
};

// Calls `cell(v, u)` for every cell, lines shared among threads.
template <typename Cell>
void for_cells(const March& march, const Execution& execution, const Cell& cell)
{
    for_rows(march.heights().lines, 4, execution, [&](std::size_t first, std::size_t last) {
        for (std::size_t v = first; v < last; ++v)
            for (std::size_t u = 0; u < march.heights().cells; ++u)
                cell(v, u);
    });
}

} // namespace

ShadowMask cast_by_ray(const HeightField& field, const DirectionalLight& light, const Execution& execution)
{
    require_valid(field);
    require_valid(light);
    if (const auto answer = uniform_answer(light))
        return uniform_mask(field, *answer);

    const March march(field, light);
    ShadowMask mask(field.rows(), field.columns());
    const auto out = in_light_order(mask.view(), light_frame(light, field.cell_size_m));
    for_cells(march, execution, [&](std::size_t v, std::size_t u) {
        const double ground_m = march.heights().at(v, u);
        if (std::isnan(ground_m)) {
            out.at(v, u) = Lit::unknown;
            return;
        }
        const double shadow_m =
            march.shadow_height_m(static_cast<double>(v), static_cast<double>(u), ground_m);
        out.at(v, u) = ground_m >= shadow_m ? Lit::yes : Lit::no;
    });
    return mask;
}

ShadowField shadow_heights_by_ray(const HeightField& field, const DirectionalLight& light,
                                  const Execution& execution)
{
    require_valid(field);
    require_valid(light);
    if (const auto answer = uniform_answer(light))
        return uniform_shadow_heights(field, *answer);

    const March march(field, light);
    ShadowField shadows(field.rows(), field.columns());
    const auto out = in_light_order(shadows.view(), light_frame(light, field.cell_size_m));
    for_cells(march, execution, [&](std::size_t v, std::size_t u) {
        out.at(v, u) = std::isnan(march.heights().at(v, u))
                           ? std::numeric_limits<float>::quiet_NaN()
                           : static_cast<float>(march.shadow_height_m(static_cast<double>(v),
                                                                      static_cast<double>(u), kNothing));
    });
    return shadows;
}

} // namespace duskline
