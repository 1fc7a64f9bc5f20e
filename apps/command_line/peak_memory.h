#pragma once

#include <cstddef>
#include <optional>

namespace duskline::cli {

/// How much memory something takes: the pages of this process that were resident at once while it ran, beyond
/// those that were when it began. Heap that was freed before counts as not resident; what is freed on the way
/// counts as long as it was there. Allocated memory that nobody touched does not count, nor do files in the
/// system's cache. Pages, so right to some dozen KiB. Linux.
class PeakMemory {
public:
    /// From here on. One at a time: there is one peak per process, and this resets it.
    PeakMemory();

    /// Up to here. Empty where the system does not say or its peak cannot be reset.
    std::optional<std::size_t> bytes() const;

private:
    std::optional<std::size_t> before_;
};

} // namespace duskline::cli
