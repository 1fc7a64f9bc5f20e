#pragma once

#include "changing_ground.h"
#include "shadow_map_settings.h"
#include "viewer_lamps.h"

#include <duskline/light/date_time.h>
#include <duskline/view/camera_path.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace duskline::viewer {

/// Where the light comes from: angles, or the sun at a time.
struct ViewerLight {
    double azimuth_deg = 300.0; ///< clockwise from the map's north
    double altitude_deg = 20.0;
    std::optional<DateTime> time; ///< then the angles are what the sun has at that time
};

/// Everything that can be set while looking, and nothing that follows from the files.
struct ViewerState {
    Camera camera;
    ViewerLight light;
    std::string technique = "exact";
    bool soft = false;           ///< edges as wide as the sun's disc makes them, where the technique has them
    std::size_t light_maps = 24; ///< of a day, or of the compass, where the technique makes them; 2 to 96
    window::ShadowMapSettings shadow_map; ///< of the technique of that name
    bool difference = false;              ///< mark what differs from the exact shadows
    std::string animation{kNoMotion};     ///< of the ground
    double animation_s = 0.0;             ///< its second, and that of whatever else moves by itself
    double animation_speed = 1.0;         ///< seconds of it in a second
    bool objects = false;                 ///< trees, towers, an aircraft and clouds
    std::vector<ViewerLamp> lamps;        ///< at most kMostLamps
    double clock_s_per_s = 600.0;         ///< how fast the clock runs
    float ambient = 0.28f;                ///< 0 to below 1
    float exposure = 1.0f;                ///< above 0
    float exaggeration = 1.0f;            ///< of slopes when they are shaded; above 0
    double pixel_error = 1.5;             ///< of the mesh; above 0
};

/// Reads a state from a JSON file; what the file does not say stays as in `otherwise`. Throws InputError, with the
/// file, the key and what would be right.
ViewerState read_state(const std::string& path, const ViewerState& otherwise);

/// Writes it. Throws OutputError.
void write_state(const std::string& path, const ViewerState& state);

/// The same for flights: {"poses": [camera, ...]}.
CameraPath read_flight(const std::string& path);
void write_flight(const std::string& path, const CameraPath& flight);

} // namespace duskline::viewer
