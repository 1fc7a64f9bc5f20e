#pragma once

#include <duskline/casting/strider.h>
#include <duskline/light/directional_light.h>

#include <chrono>
#include <functional>
#include <optional>

namespace duskline {

/// The shadows of one terrain under a light that moves slowly, made over several frames, a part in each: the mask of
/// `cast_by_strider`, byte for byte.
///
///     GradualShadows shadows(terrain);
///     for (;;) { // every frame
///         if (!shadows.is_busy())
///             shadows.begin(sun_now());
///         if (shadows.advance_for(500us))
///             upload(shadows.mask());
///         draw();
///     }
///
/// Two masks take turns: the finished one stays as it is and can be read while the next is made.
///
/// Keeps a view of the heights: they must outlive it, and a change of them is to be told by `restart`. Not to be
/// used by two threads at a time. Memory: two bytes per cell.
class GradualShadows {
public:
    using Clock = std::chrono::steady_clock;

    /// Throws InvalidInput for cell sizes out of range. The first mask is all `unknown`.
    explicit GradualShadows(const HeightField& field);

    /// Begins a mask of that light; one that is under way is given up. Throws InvalidInput for angles out of range,
    /// with everything as it was.
    void begin(const DirectionalLight& light);

    /// To be called when heights have changed: begins the mask under way from the start, or, if none is, that of the
    /// finished mask's light. Does nothing before the first light.
    void restart();

    /// Gives up the mask under way.
    void cancel() { lines_left_ = 0; }

    bool is_busy() const { return lines_left_ > 0; }
    /// Lines (rows or columns) of the mask under way that are still to come; 0 when none is.
    std::size_t lines_left() const { return lines_left_; }

    /// Goes on by at most so many lines. True when that finished the mask, which `mask` is from now on.
    ///
    /// Reports as progress what is done of the mask. When told to stop it gives up the mask and throws Cancelled.
    bool advance(std::size_t lines, const Execution& execution = {});

    /// Goes on, some 65,000 cells at a time, until the budget is spent or the mask is finished; at least once. `now`
    /// says what time it is.
    bool advance_for(Clock::duration budget, const Execution& execution = {},
                     const std::function<Clock::time_point()>& now = Clock::now);

    /// The last mask that was finished, which stays until the next one is; `unknown` everywhere before the first.
    const ShadowMask& mask() const { return finished_; }

    /// The light of that mask; none before the first.
    const std::optional<DirectionalLight>& light() const { return finished_light_; }

private:
    void answer_lines(std::size_t first, std::size_t count, const Execution& execution);

    HeightField field_;
    ShadowMask finished_;
    std::optional<DirectionalLight> finished_light_;

    ShadowMask next_;
    DirectionalLight next_light_;
    LightFrame frame_;
    StriderFront front_;
    std::size_t lines_ = 0;
    std::size_t lines_left_ = 0;
};

} // namespace duskline
