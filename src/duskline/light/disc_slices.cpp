#include <duskline/light/disc_slices.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace duskline {

namespace {

// A horizon this steep is straight up: between two samples there is none.
constexpr double kSteepestTangent = 1e9;

constexpr std::size_t kFewestGroups = 3;
constexpr std::size_t kMostGroups = 27;
constexpr double kGroupWidth_deg = 5.0;
constexpr std::size_t kChordsPerSlice = 48;

double tangent_of_sine(double sine)
{
    const double cosine = std::sqrt(std::max(0.0, 1.0 - sine * sine));
    return cosine * kSteepestTangent <= sine ? kSteepestTangent : sine / cosine;
}

double sine_of_tangent(double tangent)
{
    return tangent / std::sqrt(1.0 + tangent * tangent);
}

// The cap of the sphere that is the disc.
class Cap {
public:
    explicit Cap(const DirectionalLight& light)
        : centre_(sine_cosine(light.altitude)),
          radius_(sine_cosine(Angle::from_degrees(light.angular_diameter.degrees() / 2.0))),
          radius_deg_(light.angular_diameter.degrees() / 2.0), altitude_deg_(light.altitude.degrees())
    {}

    bool holds_zenith() const { return altitude_deg_ + radius_deg_ >= 90.0; }
    bool is_above_horizontal() const { return altitude_deg_ >= radius_deg_; }
    bool is_below_horizontal() const { return altitude_deg_ <= -radius_deg_; }

    // Radians from the middle to the outermost azimuth.
    double half_width() const
    {
        return holds_zenith() ? std::numbers::pi : std::asin(std::min(1.0, radius_.sine / centre_.cosine));
    }

    double solid_angle() const
    {
        const double s = std::sin(Angle::from_degrees(radius_deg_).radians() / 2.0);
        return 4.0 * std::numbers::pi * s * s;
    }

    // The altitudes above the horizontal on the meridian `offset` radians beside the middle; sines.
    //
    // A point at altitude a there is inside when sin a0 sin a + cos a0 cos(offset) cos a >= cos r: a cosine about
    // its peak, on either side of which the chord reaches equally far.
    DiscSlice::Chord chord(double offset) const
    {
        const double along = centre_.cosine * std::cos(offset);
        const double across = centre_.cosine * std::sin(offset);
        const double peak = std::hypot(centre_.sine, along);
        const double reach_squared = radius_.sine * radius_.sine - across * across;
        if (!(reach_squared > 0.0) || !(peak > 0.0))
            return {0.0, 0.0, 0.0};
        const double middle = std::atan2(centre_.sine, along);
        const double reach = std::asin(std::min(1.0, std::sqrt(reach_squared) / peak));
        const double lowest = std::clamp(middle - reach, 0.0, std::numbers::pi / 2.0);
        const double highest = std::clamp(middle + reach, lowest, std::numbers::pi / 2.0);
        return {std::sin(lowest), std::sin(highest), 0.0};
    }

private:
    SineCosine centre_;
    SineCosine radius_;
    double radius_deg_;
    double altitude_deg_;
};

// Chords over all of a disc, and how far beside its middle each stands.
struct Chords {
    std::vector<DiscSlice::Chord> chords;
    std::vector<double> offsets;
    double share = 0.0; // of the disc, together
};

double share_of(const DiscSlice::Chord& chord)
{
    return chord.share_per_sine * (chord.highest_sine - chord.lowest_sine);
}

// Chords stand closer towards both ends, where their lengths change fastest.
Chords chords_of(const Cap& cap, std::size_t count)
{
    const double half_width = cap.half_width();
    const double solid_angle = cap.solid_angle();
    Chords result;
    for (std::size_t i = 0; i < count; ++i) {
        const double turn =
            ((static_cast<double>(i) + 0.5) / static_cast<double>(count) - 0.5) * std::numbers::pi;
        const double width = half_width * std::cos(turn) * std::numbers::pi / static_cast<double>(count);
        DiscSlice::Chord chord = cap.chord(half_width * std::sin(turn));
        chord.share_per_sine = width / solid_angle;
        result.chords.push_back(chord);
        result.offsets.push_back(half_width * std::sin(turn));
        result.share += share_of(chord);
    }
    return result;
}

// What the sum of chords is off by is put right.
void scale_to(Chords& chords, double share)
{
    for (DiscSlice::Chord& chord : chords.chords)
        chord.share_per_sine *= share / chords.share;
    chords.share = share;
}

// The chords before which slices of equal share begin, and where the last one ends.
std::vector<std::size_t> equal_shares(const Chords& chords, std::size_t slices)
{
    std::vector<std::size_t> first{0};
    double passed = 0.0;
    for (std::size_t i = 0; i < chords.chords.size(); ++i) {
        const double share = share_of(chords.chords[i]);
        const double begins = chords.share * static_cast<double>(first.size()) / static_cast<double>(slices);
        if (passed + share / 2.0 >= begins && first.size() < slices && i > first.back())
            first.push_back(i);
        passed += share;
    }
    assert(first.size() == slices);
    first.push_back(chords.chords.size());
    return first;
}

// Where half of the chords' share lies on either side, about.
double middle_of(const Chords& chords, std::size_t first, std::size_t last)
{
    double sum = 0.0;
    double weight = 0.0;
    for (std::size_t i = first; i < last; ++i) {
        sum += chords.offsets[i] * share_of(chords.chords[i]);
        weight += share_of(chords.chords[i]);
    }
    return weight > 0.0 ? sum / weight : (chords.offsets[first] + chords.offsets[last - 1]) / 2.0;
}

std::size_t group_count(const Cap& cap)
{
    const double width_deg = 2.0 * Angle::from_radians(cap.half_width()).degrees();
    const auto wanted = static_cast<std::size_t>(std::ceil(width_deg / kGroupWidth_deg));
    return std::clamp(wanted | 1U, kFewestGroups, kMostGroups); // odd: one looks along the middle
}

} // namespace

DiscSlice::DiscSlice(Angle azimuth, const Chord* first, const Chord* last) : azimuth_(azimuth)
{
    lowest_sine_ = 1.0;
    double highest_sine = 0.0;
    for (const Chord* chord = first; chord != last; ++chord) {
        lowest_sine_ = std::min(lowest_sine_, chord->lowest_sine);
        highest_sine = std::max(highest_sine, chord->highest_sine);
    }
    highest_sine = std::max(highest_sine, lowest_sine_);
    lowest_tangent_ = tangent_of_sine(lowest_sine_);
    highest_tangent_ = tangent_of_sine(highest_sine);
    const double step = (highest_sine - lowest_sine_) / static_cast<double>(kSteps);
    steps_per_sine_ = step > 0.0 ? 1.0 / step : 0.0;
    for (std::size_t i = 0; i <= kSteps; ++i) {
        const double horizon = lowest_sine_ + step * static_cast<double>(i);
        for (const Chord* chord = first; chord != last; ++chord)
            above_[i] += chord->share_per_sine
                         * std::max(0.0, chord->highest_sine - std::max(horizon, chord->lowest_sine));
    }
    above_.back() = 0.0;
}

double DiscSlice::above(double horizon_tangent) const
{
    if (horizon_tangent <= lowest_tangent_)
        return whole();
    if (horizon_tangent >= highest_tangent_)
        return 0.0;
    const double steps = (sine_of_tangent(horizon_tangent) - lowest_sine_) * steps_per_sine_;
    const auto step = std::min(static_cast<std::size_t>(std::max(steps, 0.0)), kSteps - 1);
    return std::lerp(above_[step], above_[step + 1], std::clamp(steps - static_cast<double>(step), 0.0, 1.0));
}

DiscSlices disc_slices(const DirectionalLight& light)
{
    require_valid(light);
    assert(light.angular_diameter.degrees() > 0.0);
    const Cap cap(light);
    DiscSlices result;
    result.all_around = cap.holds_zenith();
    if (cap.is_below_horizontal())
        return result;
    const std::size_t slices = DiscGroup::kParts * group_count(cap);
    Chords chords = chords_of(cap, kChordsPerSlice * slices);
    if (cap.is_above_horizontal())
        scale_to(chords, 1.0);
    result.above_horizontal = chords.share;

    const auto firsts = equal_shares(chords, slices);
    const auto slice = [&](std::size_t first, std::size_t last, double offset) {
        return DiscSlice(light.azimuth + Angle::from_radians(offset), &chords.chords[firsts[first]],
                         &chords.chords[0] + firsts[last]);
    };
    // What stands left of the middle stands right of it too, to the bit.
    const auto offset = [&](std::size_t i) {
        const std::size_t mirrored = slices - 1 - i;
        if (i == mirrored)
            return 0.0;
        return i < mirrored ? middle_of(chords, firsts[i], firsts[i + 1])
                            : -middle_of(chords, firsts[mirrored], firsts[mirrored + 1]);
    };
    const auto part = [&](std::size_t i) { return slice(i, i + 1, offset(i)); };
    static_assert(DiscGroup::kParts == 5);
    for (std::size_t i = 0; i < slices; i += 5)
        result.groups.push_back(
            {slice(i, i + 5, offset(i + 2)), {part(i), part(i + 1), part(i + 2), part(i + 3), part(i + 4)}});
    return result;
}

} // namespace duskline
