// Compiles the kernels once per SIMD level, and chooses among them when the program runs.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "duskline/casting/kernels/kernels.cpp"
#include <hwy/foreach_target.h>
// after foreach_target.h
#include <duskline/casting/kernels/bracket_line-inl.h>
#include <duskline/casting/kernels/lamp_line-inl.h>
#include <duskline/casting/kernels/silhouettes-inl.h>
#include <duskline/casting/kernels/sweep_lines-inl.h>
#include <duskline/casting/kernels/transpose-inl.h>

HWY_BEFORE_NAMESPACE();
namespace duskline::kernels {
namespace HWY_NAMESPACE {

Kernels kernels_called(std::string_view isa)
{
    return {isa,
            sweep_mask,
            sweep_shadow_heights,
            bracket_line,
            heights_over,
            bracket_lamp_line,
            rising_lines_across,
            mark_silhouettes,
            search_next_silhouettes,
            highest_magnitude,
            transpose_floats,
            transpose_bytes};
}

} // namespace HWY_NAMESPACE
} // namespace duskline::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

#include <duskline/geometry/invalid_input.h>

#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

namespace duskline::kernels {

BeamShift beam_shift(double lateral, std::size_t v)
{
    constexpr double snap = 1e-6;
    const double shift = std::abs(lateral) * static_cast<double>(v);
    const double whole = std::floor(shift + snap);
    const double fraction = shift - whole;
    return {static_cast<std::ptrdiff_t>(whole), fraction < snap ? 0.0f : static_cast<float>(fraction)};
}

static std::vector<Kernels> find_runnable_kernels()
{
    const auto supported = hwy::SupportedTargets();
    std::vector<Kernels> found;
#if HWY_TARGETS & HWY_AVX3
    if (supported & HWY_AVX3)
        found.push_back(N_AVX3::kernels_called("avx512"));
#endif
#if HWY_TARGETS & HWY_AVX2
    if (supported & HWY_AVX2)
        found.push_back(N_AVX2::kernels_called("avx2"));
#endif
#if HWY_TARGETS & HWY_SSE4
    if (supported & HWY_SSE4)
        found.push_back(N_SSE4::kernels_called("sse4"));
#endif
#if HWY_TARGETS & HWY_SSSE3
    if (supported & HWY_SSSE3)
        found.push_back(N_SSSE3::kernels_called("ssse3"));
#endif
    // What the compiler may use on every processor of the kind built for: plain code on x86.
    found.push_back(HWY_NAMESPACE::kernels_called("scalar"));
    return found;
}

std::span<const Kernels> runnable_kernels()
{
    static const std::vector<Kernels> found = find_runnable_kernels();
    return found;
}

const Kernels& kernels_named(std::string_view isa)
{
    const auto runnable = runnable_kernels();
    const auto found = std::ranges::find(runnable, isa, &Kernels::isa);
    if (found != runnable.end())
        return *found;
    std::string names;
    for (const Kernels& kernels : runnable)
        names += (names.empty() ? "" : ", ") + std::string(kernels.isa);
    throw InvalidInput("no SIMD level '" + std::string(isa) + "' on this processor; there are: " + names);
}

static const Kernels& choose_kernels()
{
    const char* wanted = std::getenv("DUSKLINE_KERNELS");
    if (wanted == nullptr || *wanted == '\0')
        return runnable_kernels().front();
    try {
        return kernels_named(wanted);
    } catch (const InvalidInput& error) {
        throw InvalidInput(std::string("DUSKLINE_KERNELS: ") + error.what());
    }
}

const Kernels& active_kernels()
{
    static const Kernels& chosen = choose_kernels();
    return chosen;
}

} // namespace duskline::kernels

#endif // HWY_ONCE
