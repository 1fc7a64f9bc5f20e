// Preloaded into a program under test: sends it a signal when it has moved the n-th file in place, so that a run can be
// stopped between two files without a look at the clock.
//
//   DUSKLINE_TEST_SUFFIX    which files count: how the names they are moved to end
//   DUSKLINE_TEST_COUNT     how many of them are moved before the signal
//   DUSKLINE_TEST_SIGNAL    its number

#include <dlfcn.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <string_view>

namespace {

std::atomic<int> moved{0};

void count(const char* name)
{
    const char* suffix = std::getenv("DUSKLINE_TEST_SUFFIX");
    const char* at = std::getenv("DUSKLINE_TEST_COUNT");
    const char* signal = std::getenv("DUSKLINE_TEST_SIGNAL");
    if (suffix == nullptr || at == nullptr || signal == nullptr || !std::string_view(name).ends_with(suffix))
        return;
    if (++moved == std::atoi(at))
        kill(getpid(), std::atoi(signal));
}

template <typename Function>
Function next_one_called(const char* name)
{
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

} // namespace

extern "C" {

int rename(const char* from, const char* to) noexcept
{
    const int result = next_one_called<int (*)(const char*, const char*)>("rename")(from, to);
    if (result == 0)
        count(to);
    return result;
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) noexcept
{
    const int result = next_one_called<int (*)(int, const char*, int, const char*, unsigned)>("renameat2")(
        from_folder, from, to_folder, to, flags);
    if (result == 0)
        count(to);
    return result;
}
}
