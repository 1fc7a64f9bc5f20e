#include "viewer_state.h"

#include "colour_text.h"
#include "exit_code.h"

#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/shadow_technique.h>
#include <duskline/raster_io/file_errors.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>

namespace duskline::viewer {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMost = std::numeric_limits<double>::max();

// One object of a file, read key by key with errors that say where.
class Reader {
public:
    Reader(const Json& json, std::string where) : json_(json), where_(std::move(where))
    {
        if (!json_.is_object())
            fail("must be an object");
    }

    // Leaves `value` as it is when the key is not there.
    template <typename Number>
    void number(const char* key, Number& value, double least, double most) const
    {
        const auto found = json_.find(key);
        if (found == json_.end())
            return;
        if (!found->is_number()
            || !(found->template get<double>() >= least && found->template get<double>() <= most))
            fail(fmt::format("'{}' must be a number from {:.6g} to {:.6g}, got {}", key, least, most,
                             found->dump()));
        value = found->template get<Number>();
    }

    void angle(const char* key, Angle& value, double least_deg, double most_deg) const
    {
        double degrees = value.degrees();
        number(key, degrees, least_deg, most_deg);
        value = Angle::from_degrees(degrees);
    }

    void flag(const char* key, bool& value) const
    {
        const auto found = json_.find(key);
        if (found == json_.end())
            return;
        if (!found->is_boolean())
            fail(fmt::format("'{}' must be true or false, got {}", key, found->dump()));
        value = found->get<bool>();
    }

    std::optional<std::string> text(const char* key) const
    {
        const auto found = json_.find(key);
        if (found == json_.end())
            return std::nullopt;
        if (!found->is_string())
            fail(fmt::format("'{}' must be a text, got {}", key, found->dump()));
        return found->get<std::string>();
    }

    std::optional<Reader> part(const char* key) const
    {
        const auto found = json_.find(key);
        if (found == json_.end())
            return std::nullopt;
        return Reader(*found, where_ + ": " + key);
    }

    const std::string& where() const { return where_; }

    [[noreturn]] void fail(const std::string& what) const { throw InputError(where_ + ": " + what); }

private:
    const Json& json_;
    std::string where_;
};

Json read_json(const std::string& path)
{
    std::ifstream file(path);
    if (!file)
        throw InputError(fmt::format("'{}' cannot be read", path));
    try {
        return Json::parse(file);
    } catch (const Json::parse_error& error) {
        throw InputError(fmt::format("'{}' is no JSON: error at byte {}", path, error.byte));
    }
}

// Written beside its place and moved there when complete.
void write_json(const std::string& path, const Json& json)
{
    const std::string unfinished = path + ".part";
    std::ofstream file(unfinished);
    file << json.dump(2) << '\n';
    file.close();
    std::error_code error;
    if (file)
        std::filesystem::rename(unfinished, path, error);
    if (!file || error) {
        std::filesystem::remove(unfinished, error);
        throw OutputError(fmt::format("cannot write '{}'", path));
    }
}

Json json_of(const Camera& camera)
{
    return {{"east_m", camera.position_m.x},       {"north_m", camera.position_m.y},
            {"height_m", camera.position_m.z},     {"heading_deg", camera.heading.degrees()},
            {"pitch_deg", camera.pitch.degrees()}, {"vertical_view_deg", camera.vertical_view.degrees()}};
}

void read_camera(const Reader& reader, Camera& camera)
{
    reader.number("east_m", camera.position_m.x, -kMost, kMost);
    reader.number("north_m", camera.position_m.y, -kMost, kMost);
    reader.number("height_m", camera.position_m.z, -kMost, kMost);
    reader.angle("heading_deg", camera.heading, -kMost, kMost);
    reader.angle("pitch_deg", camera.pitch, -90.0, 90.0);
    reader.angle("vertical_view_deg", camera.vertical_view, 1.0, 170.0);
}

void read_light(const Reader& reader, ViewerLight& light)
{
    reader.number("azimuth_deg", light.azimuth_deg, -kMost, kMost);
    reader.number("altitude_deg", light.altitude_deg, -90.0, 90.0);
    const auto time = reader.text("time");
    if (!time)
        return;
    try {
        light.time = parse_date_time(*time);
    } catch (const InvalidInput& error) {
        reader.fail(fmt::format("'time' {}", error.what()));
    }
}

std::string technique_of(const Reader& reader, const std::string& otherwise)
{
    std::string name = reader.text("technique").value_or(otherwise);
    try {
        gl::shadow_technique_named(name);
    } catch (const InvalidInput& error) {
        reader.fail(error.what());
    }
    return name;
}

window::ShadowMapSettings shadow_map_of(const Reader& reader, const window::ShadowMapSettings& otherwise)
{
    const auto text = reader.text("shadow_map");
    try {
        return text ? window::parse_shadow_map(*text) : otherwise;
    } catch (const InvalidInput& error) {
        reader.fail(error.what());
    }
}

std::string animation_of(const Reader& reader, const std::string& otherwise)
{
    std::string name = reader.text("animation").value_or(otherwise);
    try {
        require_motion(name);
    } catch (const InvalidInput& error) {
        reader.fail(error.what());
    }
    return name;
}

Json json_of(const ViewerLamp& lamp)
{
    const window::LampSettings& light = lamp.light;
    Json json = {{"on", light.on},
                 {"east_m", lamp.position_m.x},
                 {"north_m", lamp.position_m.y},
                 {"height_m", lamp.position_m.z},
                 {"strength", light.strength},
                 {"reach_m", light.reach_m},
                 {"range_m", light.range_m},
                 {"colour", cli::text_of(light.colour)}};
    if (light.beam)
        json["beam"] = {{"azimuth_deg", light.beam->azimuth.degrees()},
                        {"altitude_deg", light.beam->altitude.degrees()},
                        {"half_angle_deg", light.beam->half_angle.degrees()},
                        {"edge", light.soft_edge}};
    return json;
}

void read_beam(const Reader& reader, window::LampSettings& light)
{
    light = window::usual_searchlight({});
    reader.angle("azimuth_deg", light.beam->azimuth, -kMost, kMost);
    reader.angle("altitude_deg", light.beam->altitude, -90.0, 90.0);
    reader.angle("half_angle_deg", light.beam->half_angle, 0.5, 179.0);
    reader.number("edge", light.soft_edge, 0.0, 1.0);
}

Colour colour_of(const Reader& reader, const Colour& otherwise)
{
    const auto text = reader.text("colour");
    try {
        return text ? cli::parse_colour("'colour'", *text) : otherwise;
    } catch (const cli::UsageError& error) {
        reader.fail(error.what());
    }
}

ViewerLamp lamp_of(const Reader& reader)
{
    ViewerLamp lamp;
    window::LampSettings& light = lamp.light;
    if (const auto beam = reader.part("beam"))
        read_beam(*beam, light);
    reader.flag("on", light.on);
    reader.number("east_m", lamp.position_m.x, -kMost, kMost);
    reader.number("north_m", lamp.position_m.y, -kMost, kMost);
    reader.number("height_m", lamp.position_m.z, -kMost, kMost);
    reader.number("strength", light.strength, 1e-9, 1e6);
    reader.number("reach_m", light.reach_m, 0.01, 1e4);
    reader.number("range_m", light.range_m, 1.0, 1e7);
    light.colour = colour_of(reader, light.colour);
    return lamp;
}

std::vector<ViewerLamp> lamps_of(const Json& json, const Reader& reader,
                                 const std::vector<ViewerLamp>& otherwise)
{
    const auto found = json.find("lamps");
    if (found == json.end())
        return otherwise;
    if (!found->is_array() || found->size() > kMostLamps)
        reader.fail(fmt::format("'lamps' must be an array of at most {} lamps", kMostLamps));
    std::vector<ViewerLamp> lamps;
    for (const Json& lamp : *found)
        lamps.push_back(lamp_of(Reader(lamp, reader.where() + ": lamps")));
    return lamps;
}

} // namespace

ViewerState read_state(const std::string& path, const ViewerState& otherwise)
{
    ViewerState state = otherwise;
    const Json json = read_json(path);
    const Reader reader(json, "'" + path + "'");
    if (const auto camera = reader.part("camera"))
        read_camera(*camera, state.camera);
    if (const auto light = reader.part("light"))
        read_light(*light, state.light);
    state.technique = technique_of(reader, state.technique);
    state.shadow_map = shadow_map_of(reader, state.shadow_map);
    reader.flag("soft", state.soft);
    reader.number("light_maps", state.light_maps, 2, 96);
    reader.flag("difference", state.difference);
    state.animation = animation_of(reader, state.animation);
    reader.number("animation_s", state.animation_s, -1e9, 1e9);
    reader.number("animation_speed", state.animation_speed, 0.0, 100.0);
    reader.flag("objects", state.objects);
    state.lamps = lamps_of(json, reader, state.lamps);
    reader.number("clock_s_per_s", state.clock_s_per_s, -1e6, 1e6);
    reader.number("ambient", state.ambient, 0.0, 0.99);
    reader.number("exposure", state.exposure, 0.01, 100.0);
    reader.number("exaggeration", state.exaggeration, 0.01, 100.0);
    reader.number("pixel_error", state.pixel_error, 0.1, 100.0);
    return state;
}

void write_state(const std::string& path, const ViewerState& state)
{
    Json light = {{"azimuth_deg", state.light.azimuth_deg}, {"altitude_deg", state.light.altitude_deg}};
    if (state.light.time)
        light["time"] = to_iso8601(*state.light.time);
    Json lamps = Json::array();
    for (const ViewerLamp& lamp : state.lamps)
        lamps.push_back(json_of(lamp));
    write_json(path, {{"camera", json_of(state.camera)},
                      {"light", light},
                      {"technique", state.technique},
                      {"shadow_map", window::text_of(state.shadow_map)},
                      {"soft", state.soft},
                      {"light_maps", state.light_maps},
                      {"difference", state.difference},
                      {"animation", state.animation},
                      {"animation_s", state.animation_s},
                      {"animation_speed", state.animation_speed},
                      {"objects", state.objects},
                      {"lamps", lamps},
                      {"clock_s_per_s", state.clock_s_per_s},
                      {"ambient", state.ambient},
                      {"exposure", state.exposure},
                      {"exaggeration", state.exaggeration},
                      {"pixel_error", state.pixel_error}});
}

CameraPath read_flight(const std::string& path)
{
    const Json json = read_json(path);
    if (!json.is_object() || !json.contains("poses") || !json["poses"].is_array() || json["poses"].empty())
        throw InputError(fmt::format("'{}' must hold an array 'poses' of at least one camera", path));
    CameraPath flight;
    for (const Json& pose : json["poses"]) {
        Camera camera;
        read_camera(Reader(pose, fmt::format("'{}': pose {}", path, flight.poses.size() + 1)), camera);
        flight.poses.push_back(camera);
    }
    return flight;
}

void write_flight(const std::string& path, const CameraPath& flight)
{
    Json poses = Json::array();
    for (const Camera& camera : flight.poses)
        poses.push_back(json_of(camera));
    write_json(path, {{"poses", poses}});
}

} // namespace duskline::viewer
