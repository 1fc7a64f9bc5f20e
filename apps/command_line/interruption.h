#pragma once

namespace duskline::cli {

/// From now on SIGINT (Ctrl-C) and SIGTERM are remembered, so that work can stop at its next progress report
/// and clean up. A second signal ends the program at once.
void watch_for_interruption();

bool interrupted();

/// 128 + the signal's number; 1 when there was none.
int exit_code_of_interruption();

/// Throws Cancelled when a signal has come. For places between two pieces of work that report progress.
void stop_if_interrupted();

} // namespace duskline::cli
