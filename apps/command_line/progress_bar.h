#pragma once

#include "run_options.h"

#include <duskline/execution/progress.h>

namespace duskline::cli {

/// `0...10...20...` up to `100 - done.` on stderr, as GDAL draws it; silent when stderr is no terminal or
/// with -q. Its callbacks also stop the work when the user interrupts it.
class ProgressBar {
public:
    explicit ProgressBar(const RunOptions& options);
    /// Leaves an unfinished bar, so that what follows starts on a line of its own.
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    /// Progress of a piece of the work that takes the whole from `from` to `to`, both in [0, 1]. Pieces come
    /// one after the other. The bar must outlive the callback.
    ProgressCallback part(double from, double to);

private:
    void advance_to(double done);

    bool visible_;
    int ticks_drawn_ = -1;
};

} // namespace duskline::cli
