#pragma once

#include <duskline/gl/buffer.h>
#include <duskline/gl/handle.h>

#include <cstddef>

namespace duskline::gl {

void delete_vertex_array(unsigned int name);

/// Where vertices come from. One without attributes serves shaders that make their own from gl_VertexID.
class VertexArray {
public:
    VertexArray();

    /// Attribute `location` is `components` (1 to 4) floats of each vertex, `offset` bytes from its beginning, in
    /// vertices `stride` bytes apart. The buffer must outlive it.
    void set_floats(unsigned int location, const Buffer& vertices, int components, std::size_t stride,
                    std::size_t offset = 0);

    /// Indices, 32 bits each. The buffer must outlive it.
    void set_indices(const Buffer& indices);

    /// What the numbers of vertices make.
    enum class Shape { points, lines, line_strip, triangles, triangle_strip };

    /// Draws with the current program into the current framebuffer.
    /// So many times; gl_InstanceID tells the shader which time it is.
    void draw(Shape shape, std::size_t first, std::size_t count, std::size_t instances = 1) const;
    void draw_indexed(Shape shape, std::size_t first_index, std::size_t count,
                      std::size_t instances = 1) const;

    unsigned int name() const { return vertex_array_.name(); }

private:
    Handle<delete_vertex_array> vertex_array_;
};

} // namespace duskline::gl
