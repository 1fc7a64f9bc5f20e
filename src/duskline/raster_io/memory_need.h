#pragma once

#include <cstddef>
#include <string>

namespace duskline {

/// Throws UnsupportedOnThisMachine when `what`, of rows x columns cells of `bytes_per_cell` bytes, is more
/// than `available_memory_bytes`. For before allocating: systems promise more than they have, and end who
/// believes them.
void require_memory(std::size_t rows, std::size_t columns, double bytes_per_cell, const std::string& what);

} // namespace duskline
