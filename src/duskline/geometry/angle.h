#pragma once

#include <cmath>
#include <numbers>

namespace duskline {

/// A plane angle. Built from a named unit and read back in a named unit, so that degrees and radians
/// cannot be mixed up at a call site.
///
/// Degrees are what is stored: azimuths of 0, 45, 90, ... stay exact, and turning a terrain and its light
/// by a quarter changes no bit of the result.
class Angle {
public:
    constexpr Angle() = default;
    static constexpr Angle from_degrees(double degrees) { return Angle(degrees); }
    static constexpr Angle from_radians(double radians) { return Angle(radians * 180.0 / std::numbers::pi); }

    constexpr double degrees() const { return degrees_; }
    constexpr double radians() const { return degrees_ * std::numbers::pi / 180.0; }

    // clang-tidy 14 takes the zero that comparisons are rewritten with for a pointer.
    constexpr auto operator<=>(const Angle&) const = default; // NOLINT(modernize-use-nullptr)
    constexpr Angle operator-() const { return Angle(-degrees_); }
    constexpr Angle operator+(Angle other) const { return Angle(degrees_ + other.degrees_); }
    constexpr Angle operator-(Angle other) const { return Angle(degrees_ - other.degrees_); }

private:
    explicit constexpr Angle(double degrees) : degrees_(degrees) {}
    double degrees_ = 0.0;
};

/// Sine and cosine of one angle.
struct SineCosine {
    double sine;
    double cosine;
};

/// Sine and cosine, exact at every multiple of 90 degrees, and the same bits (up to sign and order) for
/// angles a quarter turn or a reflection apart. Any finite angle; NaN gives NaN.
inline SineCosine sine_cosine(Angle angle)
{
    int quarters = 0;
    const double rest = Angle::from_degrees(std::remquo(angle.degrees(), 90.0, &quarters)).radians();
    // sin and cos of 45 degrees differ in the last bit; a diagonal must not.
    const bool diagonal = std::abs(std::remainder(angle.degrees(), 90.0)) == 45.0;
    const double s = diagonal ? std::copysign(std::numbers::sqrt2 / 2.0, rest) : std::sin(rest);
    const double c = diagonal ? std::numbers::sqrt2 / 2.0 : std::cos(rest);
    switch (static_cast<unsigned>(quarters) & 3U) {
    case 0:
        return {s, c};
    case 1:
        return {c, -s};
    case 2:
        return {-s, -c};
    default:
        return {-c, s};
    }
}

inline double tangent(Angle angle)
{
    const auto [sine, cosine] = sine_cosine(angle);
    return sine / cosine;
}

/// The same direction in [0, 360) degrees.
inline Angle wrapped_to_circle(Angle angle)
{
    const double degrees = std::fmod(angle.degrees(), 360.0);
    const double positive = degrees < 0.0 ? degrees + 360.0 : degrees;
    return Angle::from_degrees(positive == 360.0 ? 0.0 : positive);
}

namespace angle_literals {

constexpr Angle operator""_deg(long double degrees)
{
    return Angle::from_degrees(static_cast<double>(degrees));
}
constexpr Angle operator""_deg(unsigned long long degrees)
{
    return Angle::from_degrees(static_cast<double>(degrees));
}

} // namespace angle_literals

} // namespace duskline
