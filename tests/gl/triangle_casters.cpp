#include "gl/triangle_casters.h"

#include <duskline/gl/buffer.h>
#include <duskline/gl/vertex_array.h>

#include <vector>

namespace duskline::gl {
namespace {

constexpr const char* kShader = R"(#version 430 core
layout(location = 0) in vec3 position;
uniform mat4 to_clip;
void main() { gl_Position = to_clip * vec4(position, 1.0); }
)";

Program casters_program()
{
    ShaderSources own;
    own.add("casters.vert.glsl", kShader);
    return {own, {{"casters.vert.glsl"}}};
}

} // namespace

TriangleCasters::TriangleCasters() : program_(casters_program()) {}

void TriangleCasters::draw(std::span<const Triangle> triangles, const Matrix4& to_clip,
                           const Vector3& origin_m) const
{
    std::vector<float> corners;
    for (const Triangle& triangle : triangles)
        for (const Vector3& corner : triangle) {
            const Vector3 p = corner - origin_m;
            corners.insert(corners.end(),
                           {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
        }
    Buffer buffer;
    buffer.upload(corners);
    VertexArray vertices;
    vertices.set_floats(0, buffer, 3, 3 * sizeof(float));
    program_.use();
    program_.set_matrix("to_clip", to_clip);
    vertices.draw(VertexArray::Shape::triangles, 0, corners.size() / 3);
}

} // namespace duskline::gl
