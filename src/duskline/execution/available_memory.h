#pragma once

#include <cstddef>

namespace duskline {

/// Bytes that this process can still take and use: the least of what the system has free, what the control
/// groups it lives in (containers) leave, and what is left of its address space limit (`ulimit -v`). All of
/// size_t where the system does not say. Linux.
std::size_t available_memory_bytes();

} // namespace duskline
