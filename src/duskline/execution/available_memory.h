#pragma once

#include <cstddef>
#include <string>

namespace duskline {

/// Bytes that this process can still take and use: the least of what the system has free, what the control
/// groups it lives in (containers) leave, and what is left of its address space limit (`ulimit -v`). All of
/// size_t where the system does not say. Linux.
std::size_t available_memory_bytes();

/// Throws UnsupportedOnThisMachine when `what`, of rows x columns cells of `bytes_per_cell` bytes, is more
/// than there is. Before allocating: systems promise more than they have, and end who believes them.
void require_memory(std::size_t rows, std::size_t columns, std::size_t bytes_per_cell,
                    const std::string& what);

} // namespace duskline
