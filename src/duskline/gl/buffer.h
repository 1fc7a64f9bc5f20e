#pragma once

#include <duskline/gl/handle.h>

#include <cstddef>
#include <span>
#include <vector>

namespace duskline::gl {

void delete_buffer(unsigned int name);

/// Bytes on the graphics card: vertices, indices, uniform blocks, shader storage.
class Buffer {
public:
    /// No bytes yet.
    Buffer();
    /// `bytes` bytes, not set.
    explicit Buffer(std::size_t bytes);

    /// Replaces everything; the buffer takes the size of the values. T must be trivially copyable.
    template <typename T>
    void upload(std::span<const T> values)
    {
        upload_bytes(std::as_bytes(values));
    }
    template <typename T>
    void upload(const std::vector<T>& values)
    {
        upload(std::span<const T>(values));
    }
    /// A uniform block, laid out as std140 wants it.
    template <typename T>
    void upload_block(const T& block)
    {
        upload_bytes(std::as_bytes(std::span<const T, 1>(&block, 1)));
    }

    /// The values that are there now; waits for what is being drawn. A last part of a value is left out.
    template <typename T>
    std::vector<T> download() const
    {
        std::vector<T> values(bytes_ / sizeof(T));
        download_bytes(std::as_writable_bytes(std::span<T>(values)));
        return values;
    }

    /// For `layout(std140, binding = ...) uniform` and `layout(std430, binding = ...) buffer` of that number.
    void bind_as_uniforms(unsigned int binding) const;
    void bind_as_storage(unsigned int binding) const;

    std::size_t bytes() const { return bytes_; }
    unsigned int name() const { return buffer_.name(); }

private:
    void upload_bytes(std::span<const std::byte> bytes);
    void download_bytes(std::span<std::byte> bytes) const;

    Handle<delete_buffer> buffer_;
    std::size_t bytes_ = 0;
};

} // namespace duskline::gl
