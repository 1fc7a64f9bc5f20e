#pragma once

#include "progress_bar.h"

#include <duskline/casting/casters.h>
#include <duskline/products/mask_difference.h>

#include <cstddef>
#include <optional>
#include <variant>
#include <vector>

namespace duskline::cli {

/// A sun or a lamp.
using BenchLight = std::variant<DirectionalLight, PointLight>;

/// What to measure.
struct BenchPlan {
    std::vector<const Caster*> casters;   ///< that take the light
    std::optional<std::size_t> runs = {}; ///< of each caster, at least 1; else as many as fit in two seconds
    std::size_t threads = 0;              ///< 0: every core
};

/// Times of one thing, seconds, in the order they were taken; at least one.
class Times {
public:
    void add(double seconds) { seconds_.push_back(seconds); }
    std::size_t count() const { return seconds_.size(); }
    double best_s() const;
    double median_s() const;

private:
    std::vector<double> seconds_;
};

/// What came out for one caster.
struct CasterBench {
    const Caster* caster = nullptr;
    MaskDifference difference;             ///< from the truth
    std::optional<std::size_t> peak_bytes; ///< memory beyond the heights, the answer's included; PeakMemory
    Times times;
};

struct BenchResult {
    const Caster* truth = nullptr; ///< ray when it is measured, else fast-ray, which gives the same bits
    std::size_t shadow = 0;        ///< cells in shadow, by the truth
    std::size_t no_data = 0;
    Times memcpy_times; ///< of copying the heights, on one thread
    std::vector<CasterBench> casters;
};

/// Casts the light with every caster: first once, to see what differs from the truth and how much memory it
/// takes, then in rounds, in each of which the heights are copied and the casters take turns. A machine that
/// slows down slows all of them, so that their ratios stay.
///
/// A caster whose first cast takes longer than all its runs may, unless their number is given, is not cast
/// again: that one is its time. Throws Cancelled on an interruption, and what casters throw.
BenchResult bench_casters(const Terrain& terrain, const BenchLight& light, const BenchPlan& plan,
                          ProgressBar& bar);

} // namespace duskline::cli
