// Ground that moves, for shadows that have to follow it.
//
//      crater                           waves                            landscape
//         _           _  rim                front ->                     at rest ---> mountains ---> at rest
//      __/ \         / \__              ___/\  /\  /\______
//           \_     _/                         \/  \/                     every cell, all the time
//             `---'                     a train of four waves
//      a fifth as deep as wide          runs out from the middle
//
// The crater has the proportions of small ones on the Moon: from rim to floor a fifth of its width, the rim a twenty-fifth
// above the ground around, which falls with the third power of the distance. R. J. Pike, Depth/diameter relations of
// fresh lunar craters, Geophysical Research Letters 1, 1974; T. R. McGetchin, M. Settle and J. W. Head, Radial thickness
// variation in impact crater ejecta, Earth and Planetary Science Letters 20, 1973. Here it ends at three radii.

#include <duskline/execution/for_rows.h>
#include <duskline/geometry/vector.h>
#include <duskline/terrain/ground_motion.h>
#include <duskline/terrain/require_same_size.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace duskline {

namespace {

constexpr std::size_t kRowsPerPiece = 16;

// Where between two beginnings a time lies, 0 to below 1.
double phase(double seconds, double period_s)
{
    const double periods = seconds / period_s;
    return periods - std::floor(periods);
}

// 0 up to 0, 1 from 1 on, without a bend.
double eased(double x)
{
    const double t = std::clamp(x, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// A grid in metres around its middle.
class Plan {
public:
    explicit Plan(const HeightField& field)
        : rows_(field.rows()), columns_(field.columns()), cell_size_m_(field.cell_size_m)
    {
        require_valid(field);
    }

    double shorter_side_m() const
    {
        return std::min(static_cast<double>(rows_) * cell_size_m_.y,
                        static_cast<double>(columns_) * cell_size_m_.x);
    }
    double middle_to_corner_m() const
    {
        return std::hypot(middle(rows_) * cell_size_m_.y, middle(columns_) * cell_size_m_.x);
    }

    double north_m(std::size_t row) const
    {
        return (middle(rows_) - static_cast<double>(row)) * cell_size_m_.y;
    }
    double east_m(std::size_t column) const
    {
        return (static_cast<double>(column) - middle(columns_)) * cell_size_m_.x;
    }

    CellRectangle all() const { return {0, 0, rows_, columns_}; }

    // The cells within a distance of the middle, and perhaps a few more.
    CellRectangle within(double radius_m) const
    {
        if (!(radius_m > 0.0))
            return {};
        const auto [first_row, rows] = span(rows_, radius_m / cell_size_m_.y);
        const auto [first_column, columns] = span(columns_, radius_m / cell_size_m_.x);
        return rows == 0 || columns == 0 ? CellRectangle{}
                                         : CellRectangle{first_row, first_column, rows, columns};
    }

private:
    static double middle(std::size_t count) { return (static_cast<double>(count) - 1.0) / 2.0; }

    // First and count.
    static std::array<std::size_t, 2> span(std::size_t count, double reach)
    {
        const double first = std::max(0.0, std::floor(middle(count) - reach));
        const double last = std::min(static_cast<double>(count) - 1.0, std::ceil(middle(count) + reach));
        if (!(first <= last))
            return {0, 0};
        return {static_cast<std::size_t>(first), static_cast<std::size_t>(last - first) + 1};
    }

    std::size_t rows_;
    std::size_t columns_;
    CellSize cell_size_m_;
};

// Ground raised by an amount that the distance from the middle decides.
template <typename RaisedBy>
void raise_row(const Plan& plan, std::size_t row, std::size_t first_column, std::span<const float> at_rest_m,
               std::span<float> heights_m, const RaisedBy& raised_by_m)
{
    const double north_m = plan.north_m(row);
    for (std::size_t x = 0; x < heights_m.size(); ++x) {
        const double east_m = plan.east_m(first_column + x);
        heights_m[x] =
            at_rest_m[x] + static_cast<float>(raised_by_m(std::sqrt(east_m * east_m + north_m * north_m)));
    }
}

class GrowingCrater : public GroundMotion {
public:
    static constexpr double kPeriod_s = 16.0;

    explicit GrowingCrater(const HeightField& at_rest)
        : plan_(at_rest), widest_m_(kRadiusOverSide * plan_.shorter_side_m())
    {}

    CellRectangle reach(double seconds) const override
    {
        return plan_.within(kEjectaEnds * radius_m(seconds));
    }

    void fill_row(std::size_t row, std::size_t first_column, double seconds, std::span<const float> at_rest_m,
                  std::span<float> heights_m) const override
    {
        const double radius_m = this->radius_m(seconds);
        raise_row(plan_, row, first_column, at_rest_m, heights_m, [=](double distance_m) {
            return distance_m < kEjectaEnds * radius_m ? radius_m * profile(distance_m / radius_m) : 0.0;
        });
    }

private:
    static constexpr double kRadiusOverSide = 0.12;
    static constexpr double kGrowingShare = 0.75; // of the period; then the ground closes again
    static constexpr double kRim = 0.08;          // in radii
    static constexpr double kRimToFloor = 0.4;
    static constexpr double kEjectaEnds = 3.0;

    double radius_m(double seconds) const
    {
        const double p = phase(seconds, kPeriod_s);
        return widest_m_ * std::min(eased(p / kGrowingShare), eased((1.0 - p) / (1.0 - kGrowingShare)));
    }

    // Height over the ground before at a distance, both in radii.
    static double profile(double distance)
    {
        if (distance < 1.0)
            return kRim - kRimToFloor * (1.0 - distance * distance);
        constexpr double end = 1.0 / (kEjectaEnds * kEjectaEnds * kEjectaEnds);
        return kRim * (1.0 / (distance * distance * distance) - end) / (1.0 - end);
    }

    Plan plan_;
    double widest_m_;
};

class Waves : public GroundMotion {
public:
    static constexpr double kPeriod_s = 12.0;

    explicit Waves(const HeightField& at_rest)
        : plan_(at_rest), train_m_(kTrainOverSide * plan_.shorter_side_m())
    {}

    CellRectangle reach(double seconds) const override { return plan_.within(front_m(seconds)); }

    void fill_row(std::size_t row, std::size_t first_column, double seconds, std::span<const float> at_rest_m,
                  std::span<float> heights_m) const override
    {
        const double front_m = this->front_m(seconds);
        raise_row(plan_, row, first_column, at_rest_m, heights_m, [&](double distance_m) {
            const double behind = (front_m - distance_m) / train_m_;
            if (!(behind > 0.0 && behind < 1.0))
                return 0.0;
            const double swell = std::sin(std::numbers::pi * behind);
            return kHeightOverTrain * train_m_ * swell * swell
                   * std::sin(2.0 * std::numbers::pi * kWaves * behind);
        });
    }

private:
    static constexpr double kTrainOverSide = 0.4;
    static constexpr double kWaves = 4.0;
    static constexpr double kHeightOverTrain = 0.0125; // slopes of up to 17 degrees

    // The train has just left the farthest corner when the period ends.
    double front_m(double seconds) const
    {
        return phase(seconds, kPeriod_s) * (plan_.middle_to_corner_m() + train_m_);
    }

    Plan plan_;
    double train_m_;
};

class TurningLandscape : public GroundMotion {
public:
    static constexpr double kPeriod_s = 20.0;

    TurningLandscape(const HeightField& at_rest, const Execution& execution)
        : plan_(at_rest), other_(other_landscape(at_rest, plan_, execution))
    {}

    CellRectangle reach(double seconds) const override
    {
        return turned(seconds) > 0.0f ? plan_.all() : CellRectangle{};
    }

    void fill_row(std::size_t row, std::size_t first_column, double seconds, std::span<const float> at_rest_m,
                  std::span<float> heights_m) const override
    {
        const float turned = this->turned(seconds);
        const auto other_m = other_.heights_m.row(row).subspan(first_column, heights_m.size());
        for (std::size_t x = 0; x < heights_m.size(); ++x)
            heights_m[x] = at_rest_m[x] + turned * (other_m[x] - at_rest_m[x]);
    }

private:
    static constexpr double kFeatureOverSide = 0.4;
    static constexpr double kReliefShare = 0.6; // there are more summits than most terrains have
    static constexpr double kLeastReliefOverSide = 0.01;

    static Terrain other_landscape(const HeightField& at_rest, const Plan& plan, const Execution& execution)
    {
        MountainsOptions options{.grid = {at_rest.rows(), at_rest.columns(), at_rest.cell_size_m}};
        options.seed = 2008;
        const HeightRange range = height_range(at_rest);
        const bool has_data = range.lowest_m <= range.highest_m;
        options.lowest_m = has_data ? static_cast<double>(range.lowest_m) : 0.0;
        const double relief_m = has_data ? static_cast<double>(range.highest_m) - options.lowest_m : 0.0;
        options.height_m = std::max(kReliefShare * relief_m, kLeastReliefOverSide * plan.shorter_side_m());
        options.feature_m =
            std::max(kFeatureOverSide * plan.shorter_side_m(), at_rest.cell_size_m.x); // of empty grids too
        return make_mountains(options, execution);
    }

    static float turned(double seconds)
    {
        const double p = phase(seconds, kPeriod_s);
        return static_cast<float>(eased(2.0 * std::min(p, 1.0 - p)));
    }

    Plan plan_;
    Terrain other_;
};

template <typename Motion>
std::unique_ptr<GroundMotion> make(const HeightField& at_rest, const Execution&)
{
    return std::make_unique<Motion>(at_rest);
}

template <>
std::unique_ptr<GroundMotion> make<TurningLandscape>(const HeightField& at_rest, const Execution& execution)
{
    return std::make_unique<TurningLandscape>(at_rest, execution);
}

constexpr std::array kMotions = {
    GroundMotionKind{"crater", "a crater that grows in the middle, and closes", GrowingCrater::kPeriod_s,
                     true, make<GrowingCrater>},
    GroundMotionKind{"waves", "four waves that run out from the middle", Waves::kPeriod_s, true, make<Waves>},
    GroundMotionKind{"landscape", "the whole terrain turns into other mountains, and back",
                     TurningLandscape::kPeriod_s, false, make<TurningLandscape>},
};

} // namespace

std::span<const GroundMotionKind> ground_motions()
{
    return kMotions;
}

const GroundMotionKind& ground_motion_named(std::string_view name)
{
    const auto found = std::ranges::find(kMotions, name, &GroundMotionKind::name);
    if (found != kMotions.end())
        return *found;
    std::string names;
    for (const GroundMotionKind& kind : kMotions)
        names += (names.empty() ? "" : ", ") + std::string(kind.name);
    throw InvalidInput("no motion of the ground is called '" + std::string(name) + "'; there are: " + names);
}

CellRectangle move_ground(const GroundMotion& motion, const HeightField& at_rest, double from_s, double to_s,
                          GridView<float> heights_m, const Execution& execution)
{
    for (const double seconds : {from_s, to_s})
        if (!std::isfinite(seconds))
            throw InvalidInput("the ground can be moved to finite seconds only, got "
                               + std::to_string(seconds));
    require_same_size("moved heights", heights_m, at_rest);
    const CellRectangle moved = united(motion.reach(from_s), motion.reach(to_s));
    for_rows(moved.rows, kRowsPerPiece, execution, [&](std::size_t first, std::size_t last) {
        for (std::size_t row = moved.first_row + first; row < moved.first_row + last; ++row)
            motion.fill_row(row, moved.first_column, to_s,
                            at_rest.heights_m.row(row).subspan(moved.first_column, moved.columns),
                            heights_m.row(row).subspan(moved.first_column, moved.columns));
    });
    return moved;
}

} // namespace duskline
