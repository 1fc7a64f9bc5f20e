#pragma once

#include <duskline/geometry/angle.h>
#include <duskline/planet/cube_face.h>

namespace duskline {

/// Parallel light about a planet, by its axis: the line through the centre that runs along the light.
///
///                     rho                      rho     distance from the axis
///        .----------o----------> light         theta   angle at the centre from the sun's direction, 0 to pi
///       /    theta /|                          turn    about the axis, 0 to 1, from `across` towards `aside`
///      |          + |                -> sun
///       \           |                          A ray keeps rho and turn all its way, and theta falls.
///        `----------'
///
/// So the ground q shades a point p of the same turn when it is nearer to the sun (a smaller theta) and farther from the axis.
struct LightAxis {
    Vector3 to_sun; ///< unit vectors at right angles, in the planet's frame
    Vector3 across;
    Vector3 aside;

    /// Of `raised`: how much higher than the sun's middle the light stands over every horizon, as the upper edge of its disc
    /// does; below 0 for the lower edge. In each half-plane that light has an axis of its own, turned by that angle.
    double raised_sine = 0.0;
    double raised_cosine = 1.0;

    /// How far a point is from the axis of the raised light, when it is `away` from this axis and `along` it.
    double from_raised_axis(double along, double away) const
    {
        return away * raised_cosine - along * raised_sine;
    }
};

/// For a vector towards the sun of any length. The frame is a function of the direction alone. Throws InvalidInput
/// unless it is finite and longer than 0, and the light is raised by less than 5 degrees, up or down.
LightAxis light_axis(const Vector3& to_sun, Angle raised = {});

/// The unit vector away from the axis at that turn. Turns that are fractions of a power of two keep their bits however
/// they are counted.
Vector3 outward_at(const LightAxis& axis, double turn);

/// The turn of a direction that is not on the axis, in [0, 1).
double turn_of(const LightAxis& axis, const Vector3& direction);

/// A vector as a face of the cube sees it: along the face's axis, and along two of its sides.
struct FaceVector {
    double ahead = 0.0;
    double x = 0.0;
    double y = 0.0;
};

/// Which of a face's coordinates counts lines, and which places on them.
enum class LinesAlong : unsigned char {
    u, ///< x is u, y is v: lines are rows
    v, ///< x is v, y is u: lines are columns
};

FaceVector on_face(const Vector3& vector, std::uint32_t face, LinesAlong lines);

/// The half-plane of one turn where it crosses a face: a straight line, by the gnomonic projection, of which the part with
/// `axis_part` above 0 counts.
struct BeamLine {
    double offset;      ///< on the line x = (offset + y dx) / dy
    double dx;          ///< (dx, dy): where light moves to
    double dy;          ///<
    FaceVector outward; ///< of the beam

    BeamLine(const FaceVector& to_sun, const FaceVector& outward_of_beam);

    double x_at(double y) const { return (offset + y * dx) / dy; }
    /// How far (1, x, y), a point of the line, is from the axis.
    double axis_part(double x, double y) const { return outward.ahead + outward.x * x + outward.y * y; }
};

} // namespace duskline
