#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/reversed_depth.h>

#include <epoxy/gl.h>

#include <array>

namespace duskline::gl {

void require_reversed_depth()
{
    if (epoxy_gl_version() < 45 && !epoxy_has_gl_extension("GL_ARB_clip_control"))
        throw UnsupportedOnThisMachine(
            "planets need OpenGL 4.5 or GL_ARB_clip_control, which this driver does not "
            "have; a newer one or Mesa's software renderer does");
}

ReversedDepth::ReversedDepth()
{
    require_reversed_depth();
    glGetIntegerv(GL_DEPTH_FUNC, &function_before_);
    tested_before_ = glIsEnabled(GL_DEPTH_TEST) == GL_TRUE;
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    constexpr float infinitely_far = 0.0f;
    glClearBufferfv(GL_DEPTH, 0, &infinitely_far);
}

ReversedDepth::~ReversedDepth()
{
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    glDepthFunc(static_cast<GLenum>(function_before_));
    if (!tested_before_)
        glDisable(GL_DEPTH_TEST);
}

Matrix4 eye_to_reversed_clip(const CameraAxes& axes, Angle vertical_view, double aspect, double nearest_m)
{
    const double upwards = 1.0 / tangent(Angle::from_degrees(vertical_view.degrees() / 2.0));
    const double sideways = upwards / aspect;
    const auto column = [&](double right, double up, double forward, double depth) {
        return std::array<float, 4>{static_cast<float>(sideways * right), static_cast<float>(upwards * up),
                                    static_cast<float>(depth), static_cast<float>(forward)};
    };
    const std::array<std::array<float, 4>, 4> columns = {column(axes.right.x, axes.up.x, axes.forward.x, 0.0),
                                                         column(axes.right.y, axes.up.y, axes.forward.y, 0.0),
                                                         column(axes.right.z, axes.up.z, axes.forward.z, 0.0),
                                                         column(0.0, 0.0, 0.0, nearest_m)};
    Matrix4 matrix = {};
    for (std::size_t i = 0; i < 16; ++i)
        matrix.at(i) = columns.at(i / 4).at(i % 4);
    return matrix;
}

} // namespace duskline::gl
