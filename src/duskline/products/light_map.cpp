// Light maps: how bright every cell of a terrain is under several lights, with the shadows that were cast.
//
//            L  *                     for every light, row by row:
//              /                        shade     f(L.N), and (reach / d)^2 of a lamp
//         N   /                         lit       0 in shadow ... 1 in the light
//         |  /                          channel  += strength * colour * shade * lit
//     ____|_/____                     then ambient, and 0 to 1
//
// Sources: in light_map.h. Departs from them in that L.N counts from 0 up (in the first, a slope that looks away and
// that its rays call lit is darker than the shadow), normals are floats and results are rounded, not cut off.

#include <duskline/execution/for_rows.h>
#include <duskline/products/light_map.h>
#include <duskline/terrain/require_same_size.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace duskline {

namespace {

constexpr std::size_t kRowsPerPiece = 16;

struct RowOfNormals {
    std::span<const float> east;
    std::span<const float> north;
    std::span<const float> up;
};

float share_of(LightModel model, float cosine)
{
    if (model == LightModel::half_lambert)
        return 0.5f * (1.0f + cosine);
    return cosine > 0.0f ? cosine : 0.0f;
}

// One light, ready for use on many rows.
class Shader {
public:
    Shader(const HeightField& field, const NormalField& normals, const MapLight& light, LightModel model)
        : field_(field), normals_(normals), light_(light), model_(model)
    {}

    bool adds_nothing() const
    {
        const auto* sun = std::get_if<DirectionalLight>(&light_.source);
        return sun != nullptr && !(sun->altitude.degrees() > 0.0)
               && std::holds_alternative<std::monostate>(light_.lit);
    }

    // The light of a row, before its strength and colour.
    void fill(std::size_t row, std::span<float> shade) const
    {
        const RowOfNormals normals = {normals_.east.row(row), normals_.north.row(row), normals_.up.row(row)};
        if (const auto* sun = std::get_if<DirectionalLight>(&light_.source))
            fill_from_afar(direction_towards(*sun), normals, shade);
        else
            fill_from_near(std::get<PointLight>(light_.source).position, row, normals, shade);
        if (const auto* mask = std::get_if<GridView<const Lit>>(&light_.lit))
            darken(mask->row(row), shade);
        else if (const auto* fraction = std::get_if<GridView<const float>>(&light_.lit))
            darken(fraction->row(row), shade);
    }

private:
    void fill_from_afar(Vector3 towards, const RowOfNormals& normals, std::span<float> shade) const
    {
        const auto x = static_cast<float>(towards.x);
        const auto y = static_cast<float>(towards.y);
        const auto z = static_cast<float>(towards.z);
        const LightModel model = model_;
        for (std::size_t i = 0; i < shade.size(); ++i)
            shade[i] = share_of(model, x * normals.east[i] + y * normals.north[i] + z * normals.up[i]);
    }

    void fill_from_near(const GridPoint& lamp, std::size_t row, const RowOfNormals& normals,
                        std::span<float> shade) const
    {
        const auto heights_m = field_.heights_m.row(row);
        const auto north_m = static_cast<float>((static_cast<double>(row) - lamp.row) * field_.cell_size_m.y);
        const auto reach_m = static_cast<float>(light_.reach_m);
        for (std::size_t i = 0; i < shade.size(); ++i) {
            const auto east_m =
                static_cast<float>((lamp.column - static_cast<double>(i)) * field_.cell_size_m.x);
            const auto up_m = static_cast<float>(lamp.height_m - heights_m[i]);
            const float distance_m = std::sqrt(east_m * east_m + north_m * north_m + up_m * up_m);
            if (!(distance_m > 0.0f)) {
                shade[i] = 0.0f;
                continue;
            }
            const float along = east_m * normals.east[i] + north_m * normals.north[i] + up_m * normals.up[i];
            const float nearness = reach_m / distance_m;
            shade[i] = nearness * nearness * share_of(model_, along / distance_m);
        }
    }

    static void darken(std::span<const Lit> mask, std::span<float> shade)
    {
        for (std::size_t i = 0; i < shade.size(); ++i)
            shade[i] = mask[i] == Lit::no ? 0.0f : shade[i];
    }

    static void darken(std::span<const float> fraction, std::span<float> shade)
    {
        for (std::size_t i = 0; i < shade.size(); ++i)
            shade[i] *= std::isnan(fraction[i]) ? 1.0f : fraction[i];
    }

    const HeightField& field_;
    const NormalField& normals_;
    const MapLight& light_;
    LightModel model_;
};

float channel_of(Colour colour, std::size_t channel)
{
    const std::array<float, 3> channels = {colour.red, colour.green, colour.blue};
    return channels.at(channel);
}

// From the sum to what is drawn. Ground has a normal that points up, no data has none.
void finish(std::span<const float> up, LightModel model, std::span<float> light)
{
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    const float least = model == LightModel::hillshade ? 1.0f / 255.0f : 0.0f;
    const float scale = model == LightModel::hillshade ? 254.0f / 255.0f : 1.0f;
    for (std::size_t i = 0; i < light.size(); ++i) {
        const float clamped = light[i] < 1.0f ? light[i] : 1.0f;
        light[i] = up[i] > 0.0f ? least + scale * clamped : nan;
    }
}

bool is_grey(Colour colour)
{
    return colour.red == colour.green && colour.green == colour.blue;
}

bool is_light(Colour colour)
{
    return std::isfinite(colour.red + colour.green + colour.blue)
           && std::min({colour.red, colour.green, colour.blue}) >= 0.0f;
}

void require_colour(Colour colour)
{
    if (!is_light(colour))
        throw InvalidInput("the colour of a light must be finite and at least 0, got "
                           + std::to_string(colour.red) + ", " + std::to_string(colour.green) + ", "
                           + std::to_string(colour.blue));
}

void require_valid(const MapLight& light, const HeightField& field)
{
    std::visit([](const auto& source) { duskline::require_valid(source); }, light.source);
    if (!(light.strength >= 0.0 && std::isfinite(light.strength)))
        throw InvalidInput("the strength of a light must be at least 0, got "
                           + std::to_string(light.strength));
    if (!(light.reach_m > 0.0 && std::isfinite(light.reach_m)))
        throw InvalidInput("the reach of a lamp must be above 0 metres, got "
                           + std::to_string(light.reach_m));
    require_colour(light.colour);
    if (const auto* mask = std::get_if<GridView<const Lit>>(&light.lit))
        require_same_size("the mask", *mask, field);
    if (const auto* fraction = std::get_if<GridView<const float>>(&light.lit))
        require_same_size("the lit fraction", *fraction, field);
}

void require_valid(const LightMapOptions& options)
{
    if (!(options.ambient >= 0.0 && std::isfinite(options.ambient)))
        throw InvalidInput("ambient light must be at least 0, got " + std::to_string(options.ambient));
    require_colour(options.ambient_colour);
}

// Makes the channels of a map, some rows at a time.
class MapMaker {
public:
    MapMaker(const HeightField& field, const NormalField& normals, std::span<const MapLight> lights,
             const LightMapOptions& options, LightMap& map)
        : normals_(normals), lights_(lights), options_(options), map_(map)
    {
        for (const MapLight& light : lights)
            shaders_.emplace_back(field, normals, light, options.model);
    }

    void make_rows(std::size_t first, std::size_t last) const
    {
        std::vector<float> shade(normals_.columns());
        for (std::size_t row = first; row < last; ++row)
            make_row(row, shade);
    }

private:
    void make_row(std::size_t row, std::span<float> shade) const
    {
        for (std::size_t c = 0; c < map_.channels.size(); ++c)
            std::ranges::fill(map_.channels[c].row(row),
                              weight(options_.ambient, options_.ambient_colour, c));
        for (std::size_t i = 0; i < lights_.size(); ++i) {
            if (shaders_[i].adds_nothing())
                continue;
            shaders_[i].fill(row, shade);
            for (std::size_t c = 0; c < map_.channels.size(); ++c)
                add(shade, weight(lights_[i].strength, lights_[i].colour, c), map_.channels[c].row(row));
        }
        for (Grid<float>& channel : map_.channels)
            finish(normals_.up.row(row), options_.model, channel.row(row));
    }

    static float weight(double strength, Colour colour, std::size_t channel)
    {
        return static_cast<float>(strength) * channel_of(colour, channel);
    }

    static void add(std::span<const float> shade, float weight, std::span<float> sum)
    {
        for (std::size_t i = 0; i < sum.size(); ++i)
            sum[i] += weight * shade[i];
    }

    const NormalField& normals_;
    std::span<const MapLight> lights_;
    const LightMapOptions& options_;
    LightMap& map_;
    std::vector<Shader> shaders_;
};

} // namespace

const NamedLightModel& light_model_named(std::string_view name)
{
    std::string names;
    for (const NamedLightModel& model : kLightModels) {
        if (model.name == name)
            return model;
        names += (names.empty() ? "" : ", ") + std::string(model.name);
    }
    throw InvalidInput("no light model is called '" + std::string(name) + "'; there are: " + names);
}

LightMap light_map(const HeightField& field, const NormalField& normals, std::span<const MapLight> lights,
                   const LightMapOptions& options, const Execution& execution)
{
    require_valid(field);
    require_valid(options);
    require_same_size("the normals", normals, field);
    for (const MapLight& light : lights)
        require_valid(light, field);

    const bool grey =
        is_grey(options.ambient_colour)
        && std::ranges::all_of(lights, [](const MapLight& light) { return is_grey(light.colour); });
    LightMap map;
    for (std::size_t channel = 0; channel < (grey ? 1U : 3U); ++channel)
        map.channels.emplace_back(field.rows(), field.columns());
    const MapMaker maker(field, normals, lights, options, map);
    for_rows(field.rows(), kRowsPerPiece, execution,
             [&](std::size_t first, std::size_t last) { maker.make_rows(first, last); });
    return map;
}

void multiply(LightMap& map, GridView<const Rgba8> texture, const Execution& execution)
{
    const Grid<float>& first_channel = map.channels.at(0);
    if (texture.rows() != first_channel.rows() || texture.columns() != first_channel.columns())
        throw InvalidInput("the texture must have the size of the light map, "
                           + size_text(first_channel.rows(), first_channel.columns()) + ", got "
                           + size_text(texture.rows(), texture.columns()));
    while (map.channels.size() < 3)
        map.channels.push_back(map.channels.front().copy());
    for_rows(texture.rows(), kRowsPerPiece, execution, [&](std::size_t first, std::size_t last) {
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t y = first; y < last; ++y)
                for (std::size_t x = 0; x < texture.columns(); ++x)
                    map.channels[c](y, x) *= static_cast<float>(texture(y, x)[c]) / 255.0f;
    });
}

} // namespace duskline
