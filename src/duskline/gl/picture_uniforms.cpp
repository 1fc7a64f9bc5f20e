#include <duskline/gl/picture_uniforms.h>
#include <duskline/gl/terrain_renderer.h>

#include <algorithm>
#include <cmath>

namespace duskline::gl {

namespace {

constexpr Angle kBrightSkyAltitude = Angle::from_degrees(55.0);
constexpr double kClearOverExtent = 5.0; // how far one sees, in extents of the terrain

std::array<float, 3> scaled(const std::array<float, 3>& colour, float by)
{
    return {colour[0] * by, colour[1] * by, colour[2] * by};
}

double extent_m(const HeightField& field)
{
    return std::hypot(static_cast<double>(field.columns()) * field.cell_size_m.x,
                      static_cast<double>(field.rows()) * field.cell_size_m.y);
}

} // namespace

std::array<float, 3> as_floats(const Vector3& v)
{
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

void set_eye(const Program& program, const Camera& camera, CellSize cell_size_m)
{
    const GridPoint eye = grid_point(camera.position_m, cell_size_m);
    const std::array<double, 2> whole = {std::floor(eye.column), std::floor(eye.row)};
    program.set("eye_cell", std::array<int, 2>{static_cast<int>(whole[0]), static_cast<int>(whole[1])});
    program.set("eye_in_cell", std::array<float, 2>{static_cast<float>(eye.column - whole[0]),
                                                    static_cast<float>(eye.row - whole[1])});
    program.set("eye_height_m", static_cast<float>(eye.height_m));
    program.set("cell_size_m",
                std::array<float, 2>{static_cast<float>(cell_size_m.x), static_cast<float>(cell_size_m.y)});
}

// Blue high up, pale or warm at the horizon; darker with the sun. Without air black.
void set_sky(const Program& program, const TerrainLight& light)
{
    const double altitude_deg = light.light.altitude.degrees();
    const auto day = static_cast<float>(std::clamp((altitude_deg + 8.0) / 16.0, 0.0, 1.0));
    const auto warm = static_cast<float>(std::clamp(1.0 - altitude_deg / 18.0, 0.0, 1.0));
    const float seen = light.air ? light.exposure * (0.03f + 0.97f * day * day) : 0.0f;
    const std::array<float, 3> cool = {0.62f, 0.74f, 0.88f};
    const std::array<float, 3> dusk = {0.80f, 0.66f, 0.52f};
    std::array<float, 3> horizon = {};
    for (std::size_t i = 0; i < 3; ++i)
        horizon.at(i) = cool.at(i) + 0.6f * warm * (dusk.at(i) - cool.at(i));
    program.set("zenith", scaled({0.16f, 0.33f, 0.66f}, seen));
    program.set("horizon", scaled(horizon, seen));
    program.set("glow", scaled(light.sun_colour, light.air ? seen * (0.3f + 0.7f * warm) : light.exposure));
    program.set("towards_sun", as_floats(direction_towards(light.light)));
}

void set_light(const Program& program, const TerrainLight& light, const HeightField& field)
{
    const double clear_m = kClearOverExtent * extent_m(field);
    program.set("towards_light", as_floats(direction_towards(light.light)));
    program.set("towards_bright_sky", as_floats(direction_towards(
                                          {.azimuth = light.light.azimuth, .altitude = kBrightSkyAltitude})));
    program.set("exaggeration", light.exaggeration);
    program.set("ambient", light.ambient);
    program.set("exposure", light.exposure);
    // A sun under the horizon gives nothing.
    program.set("sun_colour",
                light.light.altitude.degrees() > 0.0 ? light.sun_colour : std::array<float, 3>{});
    program.set("sky_light", light.sky_light);
    program.set("clear_m", light.air ? static_cast<float>(clear_m) : 0.0f);
    set_sky(program, light);
}

} // namespace duskline::gl
