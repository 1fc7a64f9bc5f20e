#include <duskline/gl/vertex_array.h>

#include <epoxy/gl.h>

#include <array>
#include <cstdint>

namespace duskline::gl {

void delete_vertex_array(unsigned int name)
{
    glDeleteVertexArrays(1, &name);
}

namespace {

Handle<delete_vertex_array> new_vertex_array()
{
    GLuint name = 0;
    glGenVertexArrays(1, &name);
    return Handle<delete_vertex_array>(name);
}

class BoundVertexArray {
public:
    explicit BoundVertexArray(const VertexArray& vertex_array)
    {
        glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &before_);
        glBindVertexArray(vertex_array.name());
    }
    BoundVertexArray(const BoundVertexArray&) = delete;
    BoundVertexArray& operator=(const BoundVertexArray&) = delete;
    ~BoundVertexArray() { glBindVertexArray(static_cast<GLuint>(before_)); }

private:
    GLint before_ = 0;
};

GLenum mode_of(VertexArray::Shape shape)
{
    constexpr std::array<GLenum, 5> modes = {GL_POINTS, GL_LINES, GL_LINE_STRIP, GL_TRIANGLES,
                                             GL_TRIANGLE_STRIP};
    return modes[static_cast<std::size_t>(shape)];
}

} // namespace

VertexArray::VertexArray() : vertex_array_(new_vertex_array()) {}

void VertexArray::set_floats(unsigned int location, const Buffer& vertices, int components,
                             std::size_t stride, std::size_t offset)
{
    const BoundVertexArray bound(*this);
    glBindVertexBuffer(location, vertices.name(), static_cast<GLintptr>(offset),
                       static_cast<GLsizei>(stride));
    glVertexAttribFormat(location, components, GL_FLOAT, GL_FALSE, 0);
    glVertexAttribBinding(location, location);
    glEnableVertexAttribArray(location);
}

void VertexArray::set_indices(const Buffer& indices)
{
    const BoundVertexArray bound(*this);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.name()); // part of the vertex array
}

void VertexArray::draw(Shape shape, std::size_t first, std::size_t count, std::size_t instances) const
{
    const BoundVertexArray bound(*this);
    glDrawArraysInstanced(mode_of(shape), static_cast<GLint>(first), static_cast<GLsizei>(count),
                          static_cast<GLsizei>(instances));
}

void VertexArray::draw_indexed(Shape shape, std::size_t first_index, std::size_t count,
                               std::size_t instances) const
{
    const BoundVertexArray bound(*this);
    // NOLINTNEXTLINE(performance-no-int-to-ptr): OpenGL takes the offset as a pointer
    const auto* offset = reinterpret_cast<const void*>(first_index * sizeof(std::uint32_t));
    glDrawElementsInstanced(mode_of(shape), static_cast<GLsizei>(count), GL_UNSIGNED_INT, offset,
                            static_cast<GLsizei>(instances));
}

} // namespace duskline::gl
