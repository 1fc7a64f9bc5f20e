#include "day_manifest.h"

#include <fmt/format.h>

namespace duskline::cli {
namespace {

using nlohmann::ordered_json;

ordered_json index_or_null(std::size_t index, bool there)
{
    return there ? ordered_json(index) : ordered_json(nullptr);
}

// A map's weight is 0 at the first of these times, 1 at its own and 0 at the last.
ordered_json blend_of(const DaySuns& day, std::size_t map)
{
    const auto time_of = [&day](std::size_t i) { return day.suns[i].time->utc; };
    const auto told = [&day](UtcTime time) { return to_iso8601({time, day.utc_offset}); };
    const bool first = map == 0;
    const bool last = map + 1 == day.suns.size();
    return {{"previous", index_or_null(map - 1, !first)},
            {"next", index_or_null(map + 1, !last)},
            {"fades_in_from", told(first ? day.span.from : time_of(map - 1))},
            {"faded_out_by", told(last ? day.span.to : time_of(map + 1))}};
}

ordered_json sun_of(const ChosenLight& chosen, const HeightFile& file)
{
    return {{"azimuth_deg", wrapped_to_circle(chosen.light.azimuth + file.ground().grid_north).degrees()},
            {"altitude_deg", chosen.light.altitude.degrees()},
            {"diameter_deg", chosen.light.angular_diameter.degrees()}};
}

ordered_json map_of(const DayManifest& manifest, const DaySuns& day, const HeightFile& file, std::size_t map)
{
    const ChosenLight& chosen = day.suns[map];
    const bool bands = manifest.map_files.size() != day.suns.size();
    ordered_json entry = {{"index", map}, {"file", manifest.map_files[bands ? 0 : map]}};
    entry["band"] = bands ? map + 1 : 1;
    entry["time"] = to_iso8601(*chosen.time);
    entry["time_utc"] = to_iso8601({chosen.time->utc});
    entry["seconds"] = std::chrono::duration<double>(chosen.time->utc - day.span.from).count();
    entry["sun"] = sun_of(chosen, file);
    entry["blend"] = blend_of(day, map);
    if (manifest.atlas) {
        const MapAtlas& atlas = *manifest.atlas;
        const TilePlace place = tile_place(atlas.layout, map, atlas.tile_rows, atlas.tile_columns);
        entry["atlas"] = {{"x", place.column},
                          {"y", place.row},
                          {"width", atlas.tile_columns},
                          {"height", atlas.tile_rows}};
    }
    return entry;
}

} // namespace

nlohmann::ordered_json manifest_of(const DayManifest& manifest, const nlohmann::ordered_json& job,
                                   const DaySuns& day, const HeightFile& file)
{
    ordered_json files = manifest.map_files;
    if (manifest.atlas)
        files.push_back(manifest.atlas->file);
    for (const auto& extra : {manifest.sheet, manifest.animation})
        if (extra)
            files.push_back(*extra);
    ordered_json maps = ordered_json::array();
    for (std::size_t i = 0; i < day.suns.size(); ++i)
        maps.push_back(map_of(manifest, day, file, i));
    return {{"format", "duskline day 1"},
            {"software", "duskline " DUSKLINE_VERSION},
            {"input", file.facts().path},
            {"rows", file.rows()},
            {"columns", file.columns()},
            {"place",
             {{"longitude_deg", day.view.place.longitude.degrees()},
              {"latitude_deg", day.view.place.latitude.degrees()}}},
            {"encoding", manifest.encoding},
            {"from", to_iso8601({day.span.from, day.utc_offset})},
            {"to", to_iso8601({day.span.to, day.utc_offset})},
            {"dark_outside", day.dark_outside},
            {"blending",
             "at a time between two maps show first + weight (second - first), weight being the share of "
             "the time from the first to the second that has gone by"},
            {"maps", maps},
            {"files", files},
            {"job", job}};
}

} // namespace duskline::cli
