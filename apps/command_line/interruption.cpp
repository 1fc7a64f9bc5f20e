#include "interruption.h"

#include <duskline/execution/progress.h>

#include <csignal>

namespace duskline::cli {
namespace {

// A signal handler has no other way to say that it was called.
volatile std::sig_atomic_t signal_received = 0;

void remember_signal(int number)
{
    signal_received = number;
}

} // namespace

void watch_for_interruption()
{
    struct sigaction action = {};
    action.sa_handler = remember_signal;
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    // A file larger than the user's limit (ulimit -f) is an output that cannot be written, not a crash.
    std::signal(SIGXFSZ, SIG_IGN);
}

bool interrupted()
{
    return signal_received != 0;
}

int exit_code_of_interruption()
{
    return interrupted() ? 128 + static_cast<int>(signal_received) : 1;
}

void stop_if_interrupted()
{
    if (interrupted())
        throw Cancelled();
}

} // namespace duskline::cli
