#pragma once

#include <cstddef>
#include <functional>
#include <stdexcept>

namespace duskline {

/// Thrown out of a computation whose progress callback asked it to stop. Nothing of the result is kept.
class Cancelled : public std::runtime_error {
public:
    Cancelled() : std::runtime_error("cancelled") {}
};

/// Called now and then with the share of the work done, in [0, 1] and never falling; return false to stop.
/// Calls come from worker threads, one at a time. An exception thrown here ends the work and reaches the
/// caller.
using ProgressCallback = std::function<bool(double done)>;

/// How a computation may use the machine. A default one uses every core and reports nothing.
struct Execution {
    /// Threads to use at most; 0 means all. No result depends on it.
    std::size_t threads = 0;
    ProgressCallback progress = {};
};

/// The same, for a part of the work that takes its progress from one share to another. `execution` must outlive it.
inline Execution part_of(const Execution& execution, double from, double to)
{
    if (!execution.progress)
        return execution;
    return {.threads = execution.threads, .progress = [&execution, from, to](double done) {
                return execution.progress(from + (to - from) * done);
            }};
}

} // namespace duskline
