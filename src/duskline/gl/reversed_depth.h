#pragma once

#include <duskline/geometry/angle.h>
#include <duskline/view/camera.h>

namespace duskline::gl {

/// A depth buffer turned round: 1 at the nearest distance, 0 at infinity, and nothing cut off at a far end. In a
/// depth32f texture the relative error of a distance is then 2^-24 or less wherever it lies, from half a metre to the
/// horizon and the stars (E. Lapidous and G. Jiao, Optimal depth buffer for low-cost graphics hardware, 1999; N. Reed,
/// Depth precision visualized, 2015). Useless in the 24-bit depth of a window: draw into a Framebuffer and show that.

/// Throws UnsupportedOnThisMachine unless this context can: OpenGL 4.5 or GL_ARB_clip_control.
void require_reversed_depth();

/// While it lives, depth tests and matrices of `eye_to_reversed_clip` fit. Clears the depth of the current framebuffer
/// when it begins; when it goes, test and clip control are as before. Throws UnsupportedOnThisMachine.
class ReversedDepth {
public:
    ReversedDepth();
    ReversedDepth(const ReversedDepth&) = delete;
    ReversedDepth& operator=(const ReversedDepth&) = delete;
    ~ReversedDepth();

private:
    int function_before_ = 0;
    bool tested_before_ = false;
};

/// From places relative to the eye, in the frame of `axes`, metres, to clip space with reversed depth: `nearest_m` over
/// the distance ahead. `aspect` is width over height. `nearest_m` above 0.
Matrix4 eye_to_reversed_clip(const CameraAxes& axes, Angle vertical_view, double aspect, double nearest_m);

} // namespace duskline::gl
