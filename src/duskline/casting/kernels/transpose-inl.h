// Turning rows into columns, a square block at a time in registers. Walking columns of a grid whose rows are a
// power of two apart costs several times more: all cells of a column fall into the same few cache sets.

#if defined(DUSKLINE_TRANSPOSE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef DUSKLINE_TRANSPOSE_INL_H_
#undef DUSKLINE_TRANSPOSE_INL_H_
#else
#define DUSKLINE_TRANSPOSE_INL_H_
#endif

#include <duskline/casting/kernels/kernels.h>

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace duskline::kernels {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

// A register holds one value: nothing to turn in it, but a small block still keeps to few cache lines.
template <typename T>
struct PlainBlock {
    static constexpr std::size_t kSide = 8;

    static HWY_INLINE void transpose(const T* from, std::ptrdiff_t from_stride, T* to,
                                     std::ptrdiff_t to_stride)
    {
        for (std::ptrdiff_t y = 0; y < 8; ++y)
            for (std::ptrdiff_t x = 0; x < 8; ++x)
                to[x * to_stride + y] = from[y * from_stride + x];
    }
};
using FloatBlock = PlainBlock<float>;
using ByteBlock = PlainBlock<std::uint8_t>;

#else

// A square of blocks, each of four rows of four values in one 128-bit part of a register: every one of them turned.
template <class D>
HWY_INLINE void turn_fours(D d, hn::Vec<D>& row0, hn::Vec<D>& row1, hn::Vec<D>& row2, hn::Vec<D>& row3)
{
    const hn::Repartition<double, D> pairs;
    const auto low01 = hn::BitCast(pairs, hn::InterleaveLower(d, row0, row1));
    const auto low23 = hn::BitCast(pairs, hn::InterleaveLower(d, row2, row3));
    const auto high01 = hn::BitCast(pairs, hn::InterleaveUpper(d, row0, row1));
    const auto high23 = hn::BitCast(pairs, hn::InterleaveUpper(d, row2, row3));
    row0 = hn::BitCast(d, hn::InterleaveLower(pairs, low01, low23));
    row1 = hn::BitCast(d, hn::InterleaveUpper(pairs, low01, low23));
    row2 = hn::BitCast(d, hn::InterleaveLower(pairs, high01, high23));
    row3 = hn::BitCast(d, hn::InterleaveUpper(pairs, high01, high23));
}

#if HWY_MAX_BYTES >= 32

// 8 x 8 floats: the lower half of a register holds rows 0 .. 3, the upper half rows 4 .. 7.
struct FloatBlock {
    static constexpr std::size_t kSide = 8;

    static HWY_INLINE void transpose(const float* from, std::ptrdiff_t from_stride, float* to,
                                     std::ptrdiff_t to_stride)
    {
        four_columns(from, from_stride, to, to_stride);
        four_columns(from + 4, from_stride, to + 4 * to_stride, to_stride);
    }

private:
    static HWY_INLINE void four_columns(const float* from, std::ptrdiff_t from_stride, float* to,
                                        std::ptrdiff_t to_stride)
    {
        const hn::FixedTag<float, 8> d;
        const hn::Half<decltype(d)> half;
        const auto rows = [&](std::ptrdiff_t y) {
            return hn::Combine(d, hn::LoadU(half, from + (y + 4) * from_stride),
                               hn::LoadU(half, from + y * from_stride));
        };
        auto row0 = rows(0);
        auto row1 = rows(1);
        auto row2 = rows(2);
        auto row3 = rows(3);
        turn_fours(d, row0, row1, row2, row3);
        hn::StoreU(row0, d, to);
        hn::StoreU(row1, d, to + to_stride);
        hn::StoreU(row2, d, to + 2 * to_stride);
        hn::StoreU(row3, d, to + 3 * to_stride);
    }
};

#else

// 4 x 4 floats.
struct FloatBlock {
    static constexpr std::size_t kSide = 4;

    static HWY_INLINE void transpose(const float* from, std::ptrdiff_t from_stride, float* to,
                                     std::ptrdiff_t to_stride)
    {
        const hn::FixedTag<float, 4> d;
        auto row0 = hn::LoadU(d, from);
        auto row1 = hn::LoadU(d, from + from_stride);
        auto row2 = hn::LoadU(d, from + 2 * from_stride);
        auto row3 = hn::LoadU(d, from + 3 * from_stride);
        turn_fours(d, row0, row1, row2, row3);
        hn::StoreU(row0, d, to);
        hn::StoreU(row1, d, to + to_stride);
        hn::StoreU(row2, d, to + 2 * to_stride);
        hn::StoreU(row3, d, to + 3 * to_stride);
    }
};

#endif // HWY_MAX_BYTES

// 16 x 16 bytes: four rounds that interleave row i with row i + 8 leave the columns.
struct ByteBlock {
    static constexpr std::size_t kSide = 16;

    static HWY_INLINE void transpose(const std::uint8_t* from, std::ptrdiff_t from_stride, std::uint8_t* to,
                                     std::ptrdiff_t to_stride)
    {
        const hn::FixedTag<std::uint8_t, 16> d;
        hn::Vec<decltype(d)> a[16];
        hn::Vec<decltype(d)> b[16];
        for (std::ptrdiff_t i = 0; i < 16; ++i)
            a[i] = hn::LoadU(d, from + i * from_stride);
        interleave(a, b);
        interleave(b, a);
        interleave(a, b);
        interleave(b, a);
        for (std::ptrdiff_t i = 0; i < 16; ++i)
            hn::StoreU(a[i], d, to + i * to_stride);
    }

private:
    template <class V>
    static HWY_INLINE void interleave(const V (&in)[16], V (&out)[16])
    {
        const hn::FixedTag<std::uint8_t, 16> d;
        for (std::size_t i = 0; i < 8; ++i) {
            out[2 * i] = hn::InterleaveLower(d, in[i], in[i + 8]);
            out[2 * i + 1] = hn::InterleaveUpper(d, in[i], in[i + 8]);
        }
    }
};

#endif // HWY_SCALAR

template <class Block, typename T>
HWY_INLINE void transpose(const T* from, std::ptrdiff_t from_stride, std::size_t rows, std::size_t columns,
                          T* to, std::ptrdiff_t to_stride, RowsFirst rows_first)
{
    constexpr std::size_t side = Block::kSide;
    const std::size_t whole_rows = rows - rows % side;
    const std::size_t whole_columns = columns - columns % side;
    const auto block = [&](std::size_t row, std::size_t column) {
        const auto y = static_cast<std::ptrdiff_t>(row);
        const auto x = static_cast<std::ptrdiff_t>(column);
        Block::transpose(from + y * from_stride + x, from_stride, to + x * to_stride + y, to_stride);
    };
    if (rows_first == RowsFirst::read) {
        for (std::size_t y = 0; y < whole_rows; y += side)
            for (std::size_t x = 0; x < whole_columns; x += side)
                block(y, x);
    } else {
        for (std::size_t x = 0; x < whole_columns; x += side)
            for (std::size_t y = 0; y < whole_rows; y += side)
                block(y, x);
    }
    const auto one_by_one = [&](std::size_t first_row, std::size_t first_column, std::size_t last_column) {
        for (std::size_t row = first_row; row < rows; ++row)
            for (std::size_t column = first_column; column < last_column; ++column) {
                const auto y = static_cast<std::ptrdiff_t>(row);
                const auto x = static_cast<std::ptrdiff_t>(column);
                to[x * to_stride + y] = from[y * from_stride + x];
            }
    };
    one_by_one(0, whole_columns, columns);
    one_by_one(whole_rows, 0, whole_columns);
}

inline void transpose_floats(const float* from, std::ptrdiff_t from_stride, std::size_t rows,
                             std::size_t columns, float* to, std::ptrdiff_t to_stride, RowsFirst rows_first)
{
    transpose<FloatBlock>(from, from_stride, rows, columns, to, to_stride, rows_first);
}

inline void transpose_bytes(const std::uint8_t* from, std::ptrdiff_t from_stride, std::size_t rows,
                            std::size_t columns, std::uint8_t* to, std::ptrdiff_t to_stride,
                            RowsFirst rows_first)
{
    transpose<ByteBlock>(from, from_stride, rows, columns, to, to_stride, rows_first);
}

} // namespace HWY_NAMESPACE
} // namespace duskline::kernels
HWY_AFTER_NAMESPACE();

#endif // include guard per target
