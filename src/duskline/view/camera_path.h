#pragma once

#include <duskline/terrain/height_field.h>
#include <duskline/view/camera.h>

#include <vector>

namespace duskline {

/// A flight: where the camera is at equal steps of time.
struct CameraPath {
    std::vector<Camera> poses;
};

/// The camera at a share of the flight, 0 at the first pose and 1 at the last: positions on the smooth curve through
/// the poses (E. Catmull and R. Rom, A class of local interpolating splines, 1974), directions likewise, headings the
/// short way round. A path of one pose stands still. Throws InvalidInput for a path without any.
Camera pose_at(const CameraPath& path, double share);

/// A flight over a terrain for its picture: from a view of the whole down to the ground, around over hills and valleys
/// and up again. The same for the same terrain.
CameraPath usual_flight(const HeightField& field, double aspect);

} // namespace duskline
