#include "raster_tags.h"

#include <fmt/format.h>

namespace duskline::cli {

void add_tag(RasterTags& tags, std::string key, std::string value)
{
    tags.emplace_back(std::move(key), std::move(value));
}

RasterTags light_tags(const ChosenLight& chosen, const HeightFile& file)
{
    const Angle from_map_north = wrapped_to_circle(chosen.light.azimuth + file.ground().grid_north);
    RasterTags tags;
    add_tag(tags, "SOFTWARE", "duskline " DUSKLINE_VERSION);
    add_tag(tags, "LIGHT_AZIMUTH", fmt::format("{:.6g}", from_map_north.degrees()));
    add_tag(tags, "LIGHT_ALTITUDE", fmt::format("{:.6g}", chosen.light.altitude.degrees()));
    if (!chosen.time)
        return tags;
    add_tag(tags, "LIGHT_TIME_UTC", to_iso8601({chosen.time->utc}));
    if (chosen.place)
        add_tag(tags, "LIGHT_PLACE", in_words(*chosen.place));
    if (chosen.sun) {
        add_tag(tags, "LIGHT_AZIMUTH_TRUE", fmt::format("{:.6g}", chosen.sun->azimuth.degrees()));
        add_tag(tags, "REFRACTION", fmt::format("{:.4f}", chosen.sun->refraction.degrees()));
    }
    return tags;
}

RasterTags lamp_tags(const std::vector<ChosenLamp>& lamps)
{
    std::string points;
    for (const ChosenLamp& lamp : lamps)
        points += (points.empty() ? "" : "; ") + in_words(lamp);
    RasterTags tags;
    add_tag(tags, "SOFTWARE", "duskline " DUSKLINE_VERSION);
    add_tag(tags, "LIGHT_POINTS", std::move(points));
    return tags;
}

void add_height_tags(RasterTags& tags, const HeightFile& file, const EarthCurvature& curvature)
{
    const HeightFileFacts& facts = file.facts();
    add_tag(tags, "CELL_SIZE_M",
            fmt::format("{:.9g} {:.9g}", facts.ground.cell_size_m.x, facts.ground.cell_size_m.y));
    add_tag(tags, "HEIGHT_UNIT", facts.height_unit);
    add_tag(tags, "Z_FACTOR", fmt::format("{:g}", facts.z_factor));
    add_tag(tags, "CURVATURE", fmt::format("{:.6g}", curvature.coefficient));
    if (curvature.coefficient != 0.0)
        add_tag(tags, "RADIUS_M", fmt::format("{:.0f}", curvature.radius_m));
}

void add_assumptions(RasterTags& tags, const Report& report)
{
    std::string assumptions;
    for (const char* kind : {"notes", "warnings"})
        for (const auto& text : report.json().at(kind))
            assumptions += (assumptions.empty() ? "" : "; ") + text.get<std::string>();
    if (!assumptions.empty())
        add_tag(tags, "ASSUMPTIONS", std::move(assumptions));
}

} // namespace duskline::cli
