#include <duskline/execution/for_rows.h>
#include <duskline/products/block_means.h>
#include <duskline/products/daylight.h>
#include <duskline/products/ground_colours.h>
#include <duskline/products/relief.h>
#include <duskline/terrain/normals.h>
#include <duskline/terrain/require_same_size.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace duskline {

namespace {

constexpr std::size_t kRowsPerPiece = 16;

// Level ground and typical slopes differ by this share of level ground's light.
constexpr double kContrast = 0.55;
constexpr double kLeastExaggeration = 1.0;
constexpr double kMostExaggeration = 6.0;

// Where the light's response bends: ground lit that many times as strongly as level ground is half-way to the
// brightest there is.
constexpr float kKnee = 1.6f;
constexpr double kLowestSine = 0.035; // of 2 degrees: a setting sun lights slopes no brighter than that

constexpr float kBrightSkyShare = 0.6f;
constexpr Angle kBrightSkyAltitude = Angle::from_degrees(55.0);

constexpr std::array<std::size_t, 4> kHollowScales = {4, 8, 16, 32};
constexpr double kHollowGain = 1.2;   // how soon a hollow is a deep one
constexpr float kHollowShade = 0.38f; // the most of the sky that hollows can take

constexpr float kSoftClipBegins = 0.65f;

// ---------------------------------------------------------------------------------------------------------
// Light on a slope

// The slope of a globe's level ground, small.
struct Tilt {
    float dz_dx = 0.0f;
    float dz_dy = 0.0f;
};

// Of the paraboloid that stands for the globe (earth_curvature.h).
class Globe {
public:
    Globe(const EarthCurvature& curvature, CellSize cell_size_m)
        : curvature_(curvature), cell_size_m_(cell_size_m)
    {}

    Tilt tilt_at(std::size_t row, std::size_t column) const
    {
        const double per_metre = curvature_.coefficient / curvature_.radius_m;
        const double east_m = (static_cast<double>(column) - curvature_.tangent_column) * cell_size_m_.x;
        const double north_m = (curvature_.tangent_row - static_cast<double>(row)) * cell_size_m_.y;
        return {static_cast<float>(-per_metre * east_m), static_cast<float>(-per_metre * north_m)};
    }

private:
    EarthCurvature curvature_;
    CellSize cell_size_m_;
};

// What the terrain is lit by, ready for use on many slopes.
class Lighting {
public:
    Lighting(const DirectionalLight& light, const ReliefOptions& options, double exaggeration)
        : daylight_(options.air ? clear_daylight(light.altitude, options.ambient) : Daylight{}),
          towards_light_(direction_towards(light)),
          towards_bright_sky_(direction_towards({.azimuth = light.azimuth, .altitude = kBrightSkyAltitude})),
          exaggeration_(static_cast<float>(exaggeration)),
          level_light_(static_cast<float>(std::max(kLowestSine, towards_light_.z))),
          level_bright_sky_(square(0.5f + 0.5f * static_cast<float>(towards_bright_sky_.z))),
          ambient_(static_cast<float>(options.ambient))
    {}

    // `tilt` is the slope of level ground there, `open` 1 on level ground and less in hollows, `lit` the lit
    // fraction.
    Colour on_slope(Tilt tilt, float dz_dx, float dz_dy, float open, float lit) const
    {
        const float x = -exaggeration_ * dz_dx - tilt.dz_dx;
        const float y = -exaggeration_ * dz_dy - tilt.dz_dy;
        const float z = 1.0f / std::sqrt(1.0f + x * x + y * y);
        const float direct = std::max(0.0f, along(towards_light_, x, y) * z / level_light_);
        const float bent = (1.0f + kKnee) * direct / (kKnee + direct);
        const float bright_sky =
            square(0.5f + 0.5f * along(towards_bright_sky_, x, y) * z) / level_bright_sky_;
        const float even_sky = 0.5f + 0.5f * z;
        const float sky = open * (even_sky + kBrightSkyShare * (bright_sky - even_sky));
        return daylight_.sky * (ambient_ * sky) + daylight_.sun * ((1.0f - ambient_) * bent * lit);
    }

    float exaggeration() const { return exaggeration_; }

private:
    static float square(float x) { return x * x; }
    static float along(const Vector3& direction, float x, float y)
    {
        return static_cast<float>(direction.x) * x + static_cast<float>(direction.y) * y
               + static_cast<float>(direction.z);
    }

    Daylight daylight_;
    Vector3 towards_light_;
    Vector3 towards_bright_sky_;
    float exaggeration_;
    float level_light_;
    float level_bright_sky_;
    float ambient_;
};

// Bright light is held below white: the identity up to where it begins, 1 at infinity.
float soft_clip(float x)
{
    if (x <= kSoftClipBegins)
        return x;
    constexpr float rest = 1.0f - kSoftClipBegins;
    return 1.0f - rest * std::exp((kSoftClipBegins - x) / rest);
}

Colour soft_clip(Colour c)
{
    return {soft_clip(c.red), soft_clip(c.green), soft_clip(c.blue)};
}

// ---------------------------------------------------------------------------------------------------------
// Ground seen against its surroundings

// Hollow ground sees less of the sky, ground that stands out more. Judged by the height of a cell against
// the means around it, as slopes over the width of their blocks, on several scales.
class Hollows {
public:
    Hollows(const HeightField& field, const Execution& execution)
        : cell_size_m_(std::sqrt(field.cell_size_m.x * field.cell_size_m.y))
    {
        for (const std::size_t scale : kHollowScales)
            if (4 * scale <= std::min(field.rows(), field.columns()))
                means_m_.emplace_back(field.heights_m, scale, execution);
    }

    // The light from the sky that reaches each cell of a row, 1 on a plane.
    void fill_open(std::size_t row, std::span<const float> heights_m, float exaggeration,
                   std::vector<float>& mean_m, std::span<float> open) const
    {
        std::fill(open.begin(), open.end(), 1.0f);
        for (const BlockMeans& means : means_m_) {
            means.row(row, mean_m);
            const auto width_m = static_cast<double>(means.block()) * cell_size_m_;
            const auto gain = static_cast<float>(kHollowGain * exaggeration / width_m);
            const float shade = kHollowShade / static_cast<float>(means_m_.size());
            for (std::size_t x = 0; x < open.size(); ++x) {
                const float hollow = gain * (mean_m[x] - heights_m[x]);
                open[x] -= shade * hollow / std::sqrt(1.0f + hollow * hollow);
            }
        }
    }

private:
    double cell_size_m_;
    std::vector<BlockMeans> means_m_;
};

// ---------------------------------------------------------------------------------------------------------
// The picture

// Everything one thread needs for one row after the other.
struct RowBuffers {
    explicit RowBuffers(std::size_t columns)
        : dz_dx(columns), dz_dy(columns), mean_m(columns), open(columns), ground(columns)
    {}

    std::vector<float> dz_dx;
    std::vector<float> dz_dy;
    std::vector<float> mean_m;
    std::vector<float> open;
    std::vector<GroundColour> ground;
};

class Painter {
public:
    Painter(const HeightField& field, const DirectionalLight& light, const LitFraction& lit,
            const ReliefOptions& options, const Execution& execution)
        : field_(field), lit_(lit), tint_(options.tint),
          lighting_(light, options, options.exaggeration.value_or(shading_exaggeration(field, light))),
          globe_(options.curvature, field.cell_size_m), hollows_(field, Execution{execution.threads, {}}),
          ground_(field, options.tint, options.texture, Execution{execution.threads, {}})
    {}

    void paint_row(std::size_t y, RowBuffers& buffers, std::span<Rgba8> out) const
    {
        const auto heights_m = field_.heights_m.row(y);
        slopes_of_row(field_, y, buffers.dz_dx, buffers.dz_dy);
        hollows_.fill_open(y, heights_m, lighting_.exaggeration(), buffers.mean_m, buffers.open);
        ground_.fill_row(y, buffers.dz_dx, buffers.dz_dy, buffers.ground);
        for (std::size_t x = 0; x < out.size(); ++x)
            out[x] = std::isnan(heights_m[x]) ? tint_.ground.no_data.value_or(Rgba8{0, 0, 0, 0})
                                              : pixel(y, x, heights_m[x], buffers);
    }

private:
    Rgba8 pixel(std::size_t y, std::size_t x, float height_m, const RowBuffers& buffers) const
    {
        const float lit = std::isnan(lit_(y, x)) ? 1.0f : lit_(y, x);
        const GroundColour& ground = buffers.ground[x];
        const Tilt tilt = globe_.tilt_at(y, x);
        const Colour light =
            ground_.is_water(height_m)
                ? lighting_.on_slope(tilt, 0.0f, 0.0f, 1.0f, lit)
                : lighting_.on_slope(tilt, buffers.dz_dx[x], buffers.dz_dy[x], buffers.open[x], lit);
        Rgba8 result = encoder_.pixel(soft_clip(ground.colour * light), y, x);
        result[3] = static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(ground.opacity, 0.0f, 1.0f)));
        return result;
    }

    const HeightField& field_;
    const LitFraction& lit_;
    const Tint& tint_;
    Lighting lighting_;
    Globe globe_;
    Hollows hollows_;
    GroundColours ground_;
    SrgbEncoder encoder_;
};

void require_valid(const ReliefOptions& options)
{
    if (!(options.ambient >= 0.0 && options.ambient < 1.0))
        throw InvalidInput("ambient light must be from 0 to below 1, got " + std::to_string(options.ambient));
    if (options.exaggeration && !(*options.exaggeration > 0.0 && std::isfinite(*options.exaggeration)))
        throw InvalidInput("exaggeration must be above 0, got " + std::to_string(*options.exaggeration));
}

} // namespace

double shading_exaggeration(const HeightField& field, const DirectionalLight& light)
{
    require_valid(field);
    duskline::require_valid(light);
    const double cells = static_cast<double>(field.rows()) * static_cast<double>(field.columns());
    const auto step = std::max<std::size_t>(1, static_cast<std::size_t>(std::sqrt(cells / 1e6)));
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t y = 0; y < field.rows(); y += step)
        for (std::size_t x = 0; x < field.columns(); x += step) {
            const Slope slope = slope_at(field, y, x);
            const double square = slope.dz_dx * slope.dz_dx + slope.dz_dy * slope.dz_dy;
            if (square > 0.0) {
                sum += square;
                count += 1.0;
            }
        }
    if (!(count > 0.0) || !(light.altitude.degrees() > 0.0))
        return kLeastExaggeration;
    const double slope_along_light = std::sqrt(sum / count / 2.0);
    return std::clamp(kContrast * tangent(light.altitude) / slope_along_light, kLeastExaggeration,
                      kMostExaggeration);
}

Picture relief(const HeightField& field, const DirectionalLight& light, const LitFraction& lit,
               const ReliefOptions& options, const Execution& execution)
{
    require_valid(field);
    duskline::require_valid(light);
    require_valid(options);
    require_same_size("the lit fraction", lit, field);
    if (!options.texture.empty())
        require_same_size("the texture", options.texture, field);

    const Painter painter(field, light, lit, options, execution);
    Picture picture(field.rows(), field.columns());
    for_rows(field.rows(), kRowsPerPiece, execution, [&](std::size_t first, std::size_t last) {
        RowBuffers buffers(field.columns());
        for (std::size_t y = first; y < last; ++y)
            painter.paint_row(y, buffers, picture.row(y));
    });
    return picture;
}

} // namespace duskline
