// How a bracket's kernel lists what it leaves to its caller: cells, or units, with what is open about them.

#if defined(DUSKLINE_OPEN_CELLS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef DUSKLINE_OPEN_CELLS_INL_H_
#undef DUSKLINE_OPEN_CELLS_INL_H_
#else
#define DUSKLINE_OPEN_CELLS_INL_H_
#endif

#include <duskline/casting/kernels/kernels.h>

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace duskline::kernels {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Appends the lanes whose flags are not 0 to `open`, which holds `found`; the first lane is number i. Returns how many
// it holds now.
template <class D>
HWY_INLINE std::size_t list_open(D di, hn::Vec<D> flags, std::size_t i, OpenCell* open, std::size_t found)
{
    HWY_ALIGN std::int32_t of_lane[hn::MaxLanes(hn::ScalableTag<std::int32_t>())];
    hn::Store(flags, di, of_lane);
    for (std::size_t lane = 0; lane < hn::Lanes(di); ++lane)
        if (of_lane[lane] != 0)
            open[found++] = {static_cast<std::uint32_t>(i + lane), static_cast<std::uint32_t>(of_lane[lane])};
    return found;
}

} // namespace HWY_NAMESPACE
} // namespace duskline::kernels
HWY_AFTER_NAMESPACE();

#endif // include guard per target
