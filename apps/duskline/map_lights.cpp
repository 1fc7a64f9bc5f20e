#include "map_lights.h"

#include "colour_text.h"
#include "exit_code.h"
#include "option_values.h"
#include "raster_site.h"

#include <duskline/geometry/invalid_input.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

namespace duskline::cli {
namespace {

constexpr auto kGroup = "Light";

using KeyValues = std::map<std::string, std::string, std::less<>>;

constexpr std::array kKeys = {"azimuth", "altitude", "time",  "at",   "point",
                              "colour",  "strength", "reach", "size", "shadows"};

std::string as_key(const std::string& typed)
{
    if (typed == "color")
        return "colour";
    if (std::ranges::find(kKeys, typed) != kKeys.end())
        return typed;
    throw UsageError(fmt::format("it has no key '{}'; there are: {}", typed, fmt::join(kKeys, ", ")));
}

// What has no '=' goes on with the value before it: point=X,Y,Z.
KeyValues parse_key_values(const std::string& text)
{
    KeyValues values;
    auto last = values.end();
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t comma = std::min(text.find(',', at), text.size());
        const std::string part = text.substr(at, comma - at);
        const std::size_t equals = part.find('=');
        if (equals == std::string::npos && last == values.end())
            throw UsageError(
                "it must be KEY=VALUE,KEY=VALUE... such as azimuth=315,altitude=45,strength=0.5");
        if (equals == std::string::npos) {
            last->second += "," + part;
        } else {
            const auto [place, is_new] =
                values.emplace(as_key(part.substr(0, equals)), part.substr(equals + 1));
            if (!is_new)
                throw UsageError(fmt::format("it has '{}' twice", place->first));
            last = place;
        }
        at = comma + 1;
    }
    return values;
}

std::optional<std::string> value_of(const KeyValues& values, std::string_view key)
{
    const auto found = values.find(key);
    return found == values.end() ? std::nullopt : std::optional(found->second);
}

std::optional<double> number_of(const KeyValues& values, std::string_view key, double least, double most)
{
    const auto text = value_of(values, key);
    if (!text)
        return std::nullopt;
    const double number = parse_number(key, *text);
    if (!(number >= least && number <= most))
        throw UsageError(fmt::format("{} must be from {:g} to {:g}, got {:g}", key, least, most, number));
    return number;
}

bool yes_or_no(const KeyValues& values, std::string_view key)
{
    const std::string text = value_of(values, key).value_or("yes");
    if (text != "yes" && text != "no")
        throw UsageError(fmt::format("{} must be yes or no, got '{}'", key, text));
    return text == "yes";
}

// One --light, before the file says where it shines.
struct LightSpec {
    LightOptions sun;
    std::string point; ///< empty: it is a sun
    ChosenMapLight light;
};

void require_no(const KeyValues& values, std::initializer_list<const char*> keys, const char* kind)
{
    for (const char* key : keys)
        if (values.contains(key))
            throw UsageError(fmt::format("{} has no {}", kind, key));
}

LightOptions sun_of(const KeyValues& values, const LightOptions& common)
{
    require_no(values, {"reach"}, "a sun");
    LightOptions sun = common;
    sun.azimuth_deg = number_of(values, "azimuth", -1e9, 1e9);
    sun.altitude_deg = number_of(values, "altitude", -90.0, 90.0);
    if (const auto time = value_of(values, "time"))
        sun.sun.time = parse_time(*time);
    if (const auto at = value_of(values, "at"))
        sun.sun.at = parse_place(*at);
    if (const auto size = number_of(values, "size", 0.0, 180.0))
        sun.sun_size_deg = size;
    require_one_light(sun);
    return sun;
}

LightSpec parse_spec(const std::string& text, const LightOptions& common)
{
    const KeyValues values = parse_key_values(text);
    LightSpec spec;
    spec.light.strength = number_of(values, "strength", 0.0, 1e9).value_or(1.0);
    spec.light.casts = yes_or_no(values, "shadows");
    if (const auto colour = value_of(values, "colour"))
        spec.light.colour = parse_colour("colour", *colour);
    if (const auto point = value_of(values, "point")) {
        require_no(values, {"azimuth", "altitude", "time", "at", "size"}, "a lamp");
        spec.light.reach_m = number_of(values, "reach", 1e-3, 1e9).value_or(spec.light.reach_m);
        spec.point = *point;
        require_point(spec.point);
    } else {
        spec.sun = sun_of(values, common);
    }
    return spec;
}

// What is wrong with a --light is said with the light.
template <typename Work>
auto for_light(const std::string& text, const Work& work)
{
    try {
        return work();
    } catch (const UsageError& error) {
        throw UsageError(fmt::format("--light '{}': {}", text, error.what()));
    }
}

// Chooses lights one after the other.
class Chooser {
public:
    Chooser(const InputOptions& input, const RunOptions& run, const HeightFile& file,
            const EarthCurvature& curvature, bool discs_count, Report& report)
        : input_(input), run_(run), file_(file), curvature_(curvature), discs_count_(discs_count),
          report_(report)
    {}

    ChosenMapLight sun(LightOptions options, ChosenMapLight light = {}) const
    {
        options.disc_counts = discs_count_;
        light.sun = choose_light(options, light_site(file_.ground()), report_);
        return light;
    }

    std::vector<ChosenMapLight> lamps(const LampOptions& options, const ChosenMapLight& like = {}) const
    {
        std::vector<ChosenMapLight> lights;
        for (const ChosenLamp& lamp : choose_lamps(options, input_, run_, file_, curvature_, report_)) {
            lights.push_back(like);
            lights.back().lamp = lamp;
        }
        return lights;
    }

    ChosenMapLight from(const LightSpec& spec) const
    {
        if (spec.point.empty())
            return sun(spec.sun, spec.light);
        LampOptions lamp;
        lamp.points = {spec.point};
        return lamps(lamp, spec.light).front();
    }

private:
    const InputOptions& input_;
    const RunOptions& run_;
    const HeightFile& file_;
    const EarthCurvature& curvature_;
    bool discs_count_;
    Report& report_;
};

} // namespace

void add_map_light_options(CLI::App& app, MapLightOptions& options)
{
    add_light_options(app, options.sun);
    add_point_option(app, options.lamps, ", of strength 1 at 1000 m; may be repeated");
    app.add_option(
           "--light", options.lights,
           "one of several lights: azimuth=DEG,altitude=DEG or time=TIME[,at=LON,LAT] of a sun, point=X,Y,Z "
           "of a lamp; and colour=#RRGGBB, strength=S (1: full light on ground square to it), of a lamp "
           "reach=METRES (where it has its strength, which falls with the square of distance; 1000), of a "
           "sun size=DEG, shadows=no for light that passes through everything; may be repeated")
        ->type_name("KEY=VALUE,...")
        ->allow_extra_args(false)
        ->group(kGroup);
}

void require_lights(const MapLightOptions& options)
{
    require_lamps_or_sun(options.lamps, options.sun);
    for (const std::string& point : options.lamps.points)
        require_point(point);
    if (options.lights.empty())
        return;
    if (options.lamps.given() || asks_for_light(options.sun))
        throw UsageError(
            "give every light by --light, or one by --azimuth and --altitude, --time or --point, "
            "not both");
    for (const std::string& text : options.lights)
        for_light(text, [&] { return parse_spec(text, options.sun); });
}

std::vector<ChosenMapLight> choose_map_lights(const MapLightOptions& options, const InputOptions& input,
                                              const RunOptions& run, const HeightFile& file,
                                              const EarthCurvature& curvature, bool discs_count,
                                              Report& report)
{
    const Chooser chooser(input, run, file, curvature, discs_count, report);
    if (options.lamps.given())
        return chooser.lamps(options.lamps);
    if (options.lights.empty())
        return {chooser.sun(with_usual_light(options.sun, report))};
    std::vector<ChosenMapLight> lights;
    for (const std::string& text : options.lights)
        lights.push_back(for_light(text, [&] { return chooser.from(parse_spec(text, options.sun)); }));
    return lights;
}

std::string in_words(const ChosenMapLight& light, const HeightFile& file)
{
    std::string words;
    if (light.sun) {
        const DirectionalLight& sun = light.sun->light;
        words = fmt::format("azimuth={:.6g},altitude={:.6g}",
                            wrapped_to_circle(sun.azimuth + file.ground().grid_north).degrees(),
                            sun.altitude.degrees());
    } else {
        words = fmt::format("point={},reach={:g}", in_words(*light.lamp), light.reach_m);
    }
    words += fmt::format(",colour={},strength={:g}", text_of(light.colour), light.strength);
    return light.casts ? words : words + ",shadows=no";
}

} // namespace duskline::cli
