#pragma once

#include <duskline/geometry/invalid_input.h>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <limits>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <type_traits>

namespace duskline {

/// A rectangle of values that live somewhere else: row 0 first, `row_stride` values from one row to the
/// next. Copying a view copies no values. The owner must outlive it.
template <typename T>
class GridView {
public:
    constexpr GridView() = default;
    constexpr GridView(T* data, std::size_t rows, std::size_t columns, std::size_t row_stride)
        : data_(data), rows_(rows), columns_(columns), row_stride_(row_stride)
    {
        assert(row_stride >= columns);
    }
    constexpr GridView(T* data, std::size_t rows, std::size_t columns)
        : GridView(data, rows, columns, columns)
    {}

    /// A writable view serves wherever a read-only one is wanted.
    constexpr operator GridView<const T>() const requires(!std::is_const_v<T>)
    {
        return {data_, rows_, columns_, row_stride_};
    }

    constexpr std::size_t rows() const { return rows_; }
    constexpr std::size_t columns() const { return columns_; }
    constexpr std::size_t row_stride() const { return row_stride_; }
    constexpr std::size_t size() const { return rows_ * columns_; }
    constexpr bool empty() const { return rows_ == 0 || columns_ == 0; }
    constexpr T* data() const { return data_; }

    constexpr std::span<T> row(std::size_t y) const
    {
        assert(y < rows_);
        return {data_ + y * row_stride_, columns_};
    }
    constexpr T& operator()(std::size_t y, std::size_t x) const
    {
        assert(y < rows_ && x < columns_);
        return data_[y * row_stride_ + x];
    }

    /// The rectangle of `row_count` x `column_count` values from (first_row, first_column) on, without a
    /// copy.
    constexpr GridView window(std::size_t first_row, std::size_t first_column, std::size_t row_count,
                              std::size_t column_count) const
    {
        assert(first_row + row_count <= rows_ && first_column + column_count <= columns_);
        return {data_ + first_row * row_stride_ + first_column, row_count, column_count, row_stride_};
    }

private:
    T* data_ = nullptr;
    std::size_t rows_ = 0;
    std::size_t columns_ = 0;
    std::size_t row_stride_ = 0;
};

/// A rectangle of values that owns its memory, row after row without gaps. Moves, and copies only when
/// asked (`copy`): a terrain is gigabytes. The first value begins a cache line (64 bytes).
template <typename T>
class Grid {
public:
    Grid() = default;

    /// `rows` x `columns` values, not set. Throws InvalidInput when their bytes cannot be counted in size_t,
    /// std::bad_alloc when there is no such memory.
    Grid(std::size_t rows, std::size_t columns)
        : values_(allocate(checked_size(rows, columns))), rows_(rows), columns_(columns)
    {}
    Grid(std::size_t rows, std::size_t columns, T value) : Grid(rows, columns)
    {
        std::fill_n(values_.get(), size(), value);
    }

    Grid copy() const
    {
        Grid other(rows_, columns_);
        std::copy_n(values_.get(), size(), other.values_.get());
        return other;
    }

    std::size_t rows() const { return rows_; }
    std::size_t columns() const { return columns_; }
    std::size_t size() const { return rows_ * columns_; }
    bool empty() const { return size() == 0; }
    T* data() { return values_.get(); }
    const T* data() const { return values_.get(); }

    std::span<T> row(std::size_t y) { return view().row(y); }
    std::span<const T> row(std::size_t y) const { return view().row(y); }
    T& operator()(std::size_t y, std::size_t x) { return view()(y, x); }
    const T& operator()(std::size_t y, std::size_t x) const { return view()(y, x); }
    std::span<T> values() { return {values_.get(), size()}; }
    std::span<const T> values() const { return {values_.get(), size()}; }

    GridView<T> view() { return {values_.get(), rows_, columns_}; }
    GridView<const T> view() const { return {values_.get(), rows_, columns_}; }

private:
    static_assert(std::is_trivially_destructible_v<T> && std::is_trivially_copyable_v<T>);
    static constexpr std::align_val_t kAlignment{64};

    struct Release {
        void operator()(T* values) const { ::operator delete(values, kAlignment); }
    };

    static T* allocate(std::size_t count)
    {
        return static_cast<T*>(::operator new(count * sizeof(T), kAlignment));
    }

    static std::size_t checked_size(std::size_t rows, std::size_t columns)
    {
        constexpr std::size_t most = std::numeric_limits<std::ptrdiff_t>::max() / sizeof(T);
        if (columns != 0 && rows > most / columns)
            throw InvalidInput("a grid of " + std::to_string(rows) + " x " + std::to_string(columns)
                               + " values is larger than memory can address");
        return rows * columns;
    }

    std::unique_ptr<T[], Release> values_;
    std::size_t rows_ = 0;
    std::size_t columns_ = 0;
};

} // namespace duskline
