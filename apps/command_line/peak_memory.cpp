#include "peak_memory.h"

#include <fcntl.h>
#include <unistd.h>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <fstream>
#include <string>

namespace duskline::cli {
namespace {

// A size in /proc/self/status by its name there: "VmRSS:      1234 kB".
std::optional<std::size_t> status_bytes(const std::string& name)
{
    std::ifstream file("/proc/self/status");
    for (std::string word; file >> word;) {
        std::size_t kibibytes = 0;
        if (word == name + ":" && file >> kibibytes)
            return kibibytes * 1024;
    }
    return std::nullopt;
}

// Lets the peak of resident memory count anew from what is resident now: proc(5), clear_refs.
bool reset_peak()
{
    const int file = open("/proc/self/clear_refs", O_WRONLY | O_CLOEXEC);
    if (file < 0)
        return false;
    const bool written = write(file, "5", 1) == 1;
    close(file);
    return written;
}

void give_back_freed_memory()
{
#if defined(__GLIBC__)
    malloc_trim(0);
#endif
}

} // namespace

PeakMemory::PeakMemory()
{
    give_back_freed_memory();
    if (reset_peak())
        before_ = status_bytes("VmRSS");
}

std::optional<std::size_t> PeakMemory::bytes() const
{
    const auto peak = status_bytes("VmHWM");
    if (!before_ || !peak)
        return std::nullopt;
    return *peak > *before_ ? *peak - *before_ : 0;
}

} // namespace duskline::cli
