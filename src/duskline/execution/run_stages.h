#pragma once

#include <duskline/execution/progress.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace duskline {

/// One step that every item goes through, called with the item's number.
using Stage = std::function<void(std::size_t item)>;

/// Takes items 0 to count - 1 through all stages. Every stage meets the items in order, one at a time; while
/// one stage has an item, the others may have the next and the last, so that reading, computing and writing
/// overlap. An item begins only when at most `in_flight` (at least 1) are under way, itself included: item i
/// may keep its things in slot i % in_flight.
///
/// With one thread the stages take turns. Reports progress when an item has left the last stage. Throws
/// Cancelled when the callback returned false, and the first exception of any stage; stages that are at work
/// then finish their item, and no more begin.
void run_stages(std::size_t count, std::size_t in_flight, const std::vector<Stage>& stages,
                const Execution& execution = {});

} // namespace duskline
