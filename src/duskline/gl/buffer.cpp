#include <duskline/gl/buffer.h>

#include <epoxy/gl.h>

namespace duskline::gl {

void delete_buffer(unsigned int name)
{
    glDeleteBuffers(1, &name);
}

namespace {

Handle<delete_buffer> new_buffer()
{
    GLuint name = 0;
    glGenBuffers(1, &name);
    return Handle<delete_buffer>(name);
}

// The target for copies, which nothing drawn depends on.
class BoundForCopy {
public:
    explicit BoundForCopy(const Buffer& buffer)
    {
        glGetIntegerv(GL_COPY_WRITE_BUFFER_BINDING, &before_);
        glBindBuffer(GL_COPY_WRITE_BUFFER, buffer.name());
    }
    BoundForCopy(const BoundForCopy&) = delete;
    BoundForCopy& operator=(const BoundForCopy&) = delete;
    ~BoundForCopy() { glBindBuffer(GL_COPY_WRITE_BUFFER, static_cast<GLuint>(before_)); }

private:
    GLint before_ = 0;
};

} // namespace

Buffer::Buffer() : buffer_(new_buffer()) {}

Buffer::Buffer(std::size_t bytes) : Buffer()
{
    const BoundForCopy bound(*this);
    glBufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(bytes), nullptr, GL_DYNAMIC_DRAW);
    bytes_ = bytes;
}

void Buffer::upload_bytes(std::span<const std::byte> bytes)
{
    const BoundForCopy bound(*this);
    glBufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(bytes.size()), bytes.data(), GL_DYNAMIC_DRAW);
    bytes_ = bytes.size();
}

void Buffer::download_bytes(std::span<std::byte> bytes) const
{
    const BoundForCopy bound(*this);
    glGetBufferSubData(GL_COPY_WRITE_BUFFER, 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

void Buffer::bind_as_uniforms(unsigned int binding) const
{
    glBindBufferBase(GL_UNIFORM_BUFFER, binding, name());
}

void Buffer::bind_as_storage(unsigned int binding) const
{
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, name());
}

} // namespace duskline::gl
