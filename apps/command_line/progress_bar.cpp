#include "progress_bar.h"

#include "interruption.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace duskline::cli {
namespace {

constexpr int kTicks = 40; // a number at every fourth, dots between

} // namespace

ProgressBar::ProgressBar(const RunOptions& options) : visible_(!options.quiet && isatty(STDERR_FILENO) == 1)
{}

ProgressBar::~ProgressBar()
{
    if (ticks_drawn_ >= 0 && ticks_drawn_ < kTicks)
        std::fputc('\n', stderr);
}

ProgressCallback ProgressBar::part(double from, double to)
{
    return [this, from, to](double done) {
        advance_to(from + (to - from) * done);
        return !interrupted();
    };
}

void ProgressBar::advance_to(double done)
{
    if (!visible_)
        return;
    const int ticks = static_cast<int>(std::clamp(done, 0.0, 1.0) * kTicks);
    for (; ticks_drawn_ < ticks; ++ticks_drawn_) {
        const int tick = ticks_drawn_ + 1;
        if (tick % 4 == 0)
            std::fprintf(stderr, "%d", tick * 100 / kTicks);
        else
            std::fputc('.', stderr);
        if (tick == kTicks)
            std::fputs(" - done.\n", stderr);
    }
    std::fflush(stderr);
}

} // namespace duskline::cli
