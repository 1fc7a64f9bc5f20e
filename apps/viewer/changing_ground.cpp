#include "changing_ground.h"

#include <algorithm>

namespace duskline::viewer {
namespace {

Terrain copied(const Terrain& terrain)
{
    return {terrain.heights_m.copy(), terrain.cell_size_m};
}

} // namespace

void require_motion(std::string_view name)
{
    if (name != kNoMotion)
        ground_motion_named(name);
}

ChangingGround::ChangingGround(Terrain at_rest, Tint tint, Picture texture,
                               std::optional<CurvedEarth> curvature, const Execution& execution)
    : execution_{.threads = execution.threads}, at_rest_(std::move(at_rest)), moved_(copied(at_rest_)),
      seen_(copied(at_rest_)), still_(at_rest_), level_(moved_), tint_(std::move(tint)),
      texture_(std::move(texture)), curvature_(std::move(curvature)),
      picture_(level_.rows(), level_.columns())
{
    change_motion(kNoMotion);
    bring_up_to_date({0, 0, level_.rows(), level_.columns()});
}

CellRectangle ChangingGround::move_to(std::string_view motion, double seconds)
{
    CellRectangle changed;
    const auto move = [&](double to_s) {
        if (motion_ && to_s != seconds_)
            changed = united(changed, move_ground(*motion_, at_rest_, seconds_, to_s, moved_.heights_m.view(),
                                                  execution_));
        seconds_ = to_s;
    };
    if (motion != motion_name_) {
        require_motion(motion);
        move(0.0);
        change_motion(motion);
    }
    move(seconds);
    bring_up_to_date(changed);
    return changed;
}

void ChangingGround::change_motion(std::string_view motion)
{
    const GroundMotionKind* kind = motion == kNoMotion ? nullptr : &ground_motion_named(motion);
    motion_ = kind != nullptr ? kind->make(at_rest_, execution_) : nullptr;
    motion_name_ = motion;
    const bool carries_water = kind != nullptr && kind->carries_water;
    colours_.emplace(level_, carries_water ? still_ : level_, tint_, texture_.view(), execution_);
}

CellRectangle ChangingGround::stroke(const GridPoint& at, const Brush& brush)
{
    const CellRectangle changed =
        duskline::stroke(at_rest_.heights_m.view(), at_rest_.cell_size_m, at, brush);
    for (std::size_t row = changed.first_row; row < changed.first_row + changed.rows; ++row) {
        const auto at_rest_m = at_rest_.heights_m.row(row).subspan(changed.first_column, changed.columns);
        const auto moved_m = moved_.heights_m.row(row).subspan(changed.first_column, changed.columns);
        if (motion_)
            motion_->fill_row(row, changed.first_column, seconds_, at_rest_m, moved_m);
        else
            std::ranges::copy(at_rest_m, moved_m.begin());
    }
    bring_up_to_date(changed);
    return changed;
}

void ChangingGround::bring_up_to_date(const CellRectangle& changed)
{
    if (changed.rows == 0 || changed.columns == 0)
        return;
    const auto [first_row, first_column, rows, columns] = changed;
    const auto seen_m = seen_.heights_m.view().window(first_row, first_column, rows, columns);
    for (std::size_t row = 0; row < rows; ++row)
        std::ranges::copy(moved_.heights_m.row(first_row + row).subspan(first_column, columns),
                          seen_m.row(row).begin());
    if (curvature_)
        curvature_->lower(seen_m, first_row, first_column);
    paint_ground(*colours_, repainted(changed), picture_.view(), execution_);
}

} // namespace duskline::viewer
