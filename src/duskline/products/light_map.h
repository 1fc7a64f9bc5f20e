#pragma once

#include <duskline/casting/shadow_mask.h>
#include <duskline/execution/progress.h>
#include <duskline/light/directional_light.h>
#include <duskline/light/point_light.h>
#include <duskline/products/colour.h>
#include <duskline/terrain/height_field.h>
#include <duskline/terrain/normals.h>

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

namespace duskline {

/// How bright a slope is that the light meets; N is the ground's upward normal, L the direction towards the light.
enum class LightModel {
    lambert,      ///< L.N, nothing below 0
    half_lambert, ///< (1 + L.N) / 2: slopes that look away keep some form
    hillshade,    ///< as lambert, and the sum s is drawn as (1 + 254 s) / 255: the bytes of gdaldem hillshade
};

/// A model as it is typed after --model. Command line, tests and docs iterate over `kLightModels`.
struct NamedLightModel {
    std::string_view name;
    std::string_view description; ///< one line for --help and the docs
    LightModel model;
    double usual_ambient; ///< light in shadows that suits it
};

inline constexpr std::array kLightModels = {
    NamedLightModel{"lambert", "ambient + L.N", LightModel::lambert, 0.2},
    NamedLightModel{"half-lambert", "ambient + (1 + L.N) / 2", LightModel::half_lambert, 0.1},
    NamedLightModel{"hillshade", "what gdaldem hillshade writes, 1 to 255, with cast shadows",
                    LightModel::hillshade, 0.0},
};

/// The model of that name. Throws InvalidInput, listing the names there are.
const NamedLightModel& light_model_named(std::string_view name);

/// Where a light is seen from: everywhere, or where a mask or a lit fraction (visible_fraction.h, lit_fraction.h)
/// says. Views of the map's size, which must live while the map is made. Where they are unknown or NaN and there is
/// ground, the light is seen.
using LitCells = std::variant<std::monostate, GridView<const Lit>, GridView<const float>>;

/// One of the lights of a map.
struct MapLight {
    std::variant<DirectionalLight, PointLight> source = DirectionalLight{};
    LitCells lit = {};
    double strength = 1.0;     ///< its light on a slope square to it; of a lamp, `reach_m` away. At least 0
    Colour colour = {1, 1, 1}; ///< factors of red, green and blue, at least 0
    double reach_m = 1000.0;   ///< of a lamp: at distance d its light is strength (reach_m / d)^2. Above 0
};

struct LightMapOptions {
    LightModel model = LightModel::lambert;
    double ambient = 0.2;              ///< light that reaches every cell, at least 0
    Colour ambient_colour = {1, 1, 1}; ///< at least 0
};

/// How bright every cell is: one channel when all lights and the ambient light are grey, else red, green and blue.
/// From 0 to 1; NaN where there is no data.
struct LightMap {
    std::vector<Grid<float>> channels;
};

/// The light on a terrain, for every channel of every cell
///
///     ambient + sum over lights of strength * lit * f(L.N),      0 to 1
///
/// with f by the model. A slope that looks away from a light gets nothing from it, also where no mask says so
/// (lambert, hillshade). Numbers are factors to multiply colours with, as in a texture unit; no transfer curve is
/// applied to them.
///
/// `field` is what the lights were cast on: lamps need its heights. `normals` are those of the same ground, or of the
/// ground as it is before it was lowered for the curvature of the earth. A light at or below the horizon adds
/// something only where `lit` says that it is seen. A lamp on the ground lights its own place not at all.
///
/// Same bytes for any number of threads. Throws InvalidInput for sizes that differ and values out of range,
/// Cancelled. On one thread 3 to 4 nanoseconds a cell for a sun, 8 for a lamp; 4 bytes a cell and channel.
///
/// Source: ambient + L.N in light maps: Marghidanu, Fast computation of terrain shadow maps, GameDev.net 2002, with
/// (1 + L.N) / 2 in its code; half Lambert: Mitchell, McTaggart and Green, Shading in Valve's Source engine,
/// SIGGRAPH 2006 course.
LightMap light_map(const HeightField& field, const NormalField& normals, std::span<const MapLight> lights,
                   const LightMapOptions& options = {}, const Execution& execution = {});

/// Lays the map over a picture of the ground: three channels, each the light times the picture's byte / 255, as they
/// are. The picture's opacity is left to whoever draws the result. Throws InvalidInput for sizes that differ, Cancelled.
void multiply(LightMap& map, GridView<const Rgba8> texture, const Execution& execution = {});

/// A value of a light map as an integer sample: 0 to 255 or 65535, rounded to the nearest; 0 for NaN.
template <typename Sample>
constexpr Sample light_sample(float light)
{
    constexpr float most = static_cast<float>(std::numeric_limits<Sample>::max());
    // Light is not below 0, and rounding this way keeps loops in SIMD registers.
    // NOLINTNEXTLINE(bugprone-incorrect-roundings)
    return light >= 0.0f ? static_cast<Sample>(light * most + 0.5f) : Sample{0};
}

} // namespace duskline
