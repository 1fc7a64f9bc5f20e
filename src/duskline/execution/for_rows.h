#pragma once

#include <duskline/execution/progress.h>

#include <cstddef>
#include <functional>

namespace duskline {

/// Threads that `execution` comes to on this machine, at least 1.
std::size_t thread_count(const Execution& execution);

/// Calls `work(first, last)` for pieces that together cover [0, count), each at most `piece` long, on up to
/// `execution.threads` threads, and returns when all are done. Pieces come in no fixed order, so work on one
/// must not depend on another.
///
/// Reports progress after each piece. Throws Cancelled when the callback returned false, and whatever `work`
/// threw; pieces not yet begun are then left out. The one place where the library starts threads.
void for_rows(std::size_t count, std::size_t piece, const Execution& execution,
              const std::function<void(std::size_t first, std::size_t last)>& work);

} // namespace duskline
