#include <duskline/casting/gradual_shadows.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace duskline {

namespace {

// Between two looks at the clock: some 0.05 ms. Columns fewer than a cache line holds are slow to turn.
constexpr std::size_t kCellsAtATime = 65'536;
constexpr std::size_t kLeastLines = 16;

} // namespace

GradualShadows::GradualShadows(const HeightField& field)
    : field_(field), finished_(field.rows(), field.columns(), Lit::unknown),
      next_(field.rows(), field.columns()), front_(0, 0, {})
{
    require_valid(field);
}

void GradualShadows::begin(const DirectionalLight& light)
{
    require_valid(light);
    next_light_ = light;
    frame_ = uniform_answer(light) ? LightFrame{} : light_frame(light, field_.cell_size_m);
    const auto heights = in_light_order(field_.heights_m, frame_);
    front_ = StriderFront(heights.lines, heights.cells, frame_);
    lines_ = heights.lines;
    lines_left_ = lines_;
}

void GradualShadows::restart()
{
    if (is_busy())
        begin(DirectionalLight(next_light_));
    else if (finished_light_)
        begin(DirectionalLight(*finished_light_));
}

bool GradualShadows::advance(std::size_t lines, const Execution& execution)
{
    lines = std::min(lines, lines_left_);
    if (lines == 0)
        return false;
    answer_lines(lines_ - lines_left_, lines, execution);
    lines_left_ -= lines;
    if (execution.progress
        && !execution.progress(1.0 - static_cast<double>(lines_left_) / static_cast<double>(lines_))) {
        cancel();
        throw Cancelled();
    }
    if (is_busy())
        return false;
    std::swap(finished_, next_);
    finished_light_ = next_light_;
    return true;
}

bool GradualShadows::advance_for(Clock::duration budget, const Execution& execution,
                                 const std::function<Clock::time_point()>& now)
{
    const std::size_t cells = std::max<std::size_t>(lines_ == 0 ? 0 : next_.size() / lines_, 1);
    const std::size_t lines = std::max(kCellsAtATime / cells, kLeastLines);
    const Clock::time_point end = now() + budget;
    while (is_busy()) {
        if (advance(lines, execution))
            return true;
        if (now() >= end)
            return false;
    }
    return false;
}

void GradualShadows::answer_lines(std::size_t first, std::size_t count, const Execution& execution)
{
    if (const auto answer = uniform_answer(next_light_)) { // lines are rows
        for (std::size_t y = first; y < first + count; ++y)
            std::ranges::transform(field_.heights_m.row(y), next_.row(y).begin(), [&](float height_m) {
                return std::isnan(height_m) ? Lit::unknown : *answer;
            });
        return;
    }
    front_.advance(in_light_order(field_.heights_m, frame_).part(first, count),
                   in_light_order(next_.view(), frame_).part(first, count), {.threads = execution.threads});
}

} // namespace duskline
