#pragma once

#include <duskline/geometry/vector.h>
#include <duskline/gl/program.h>
#include <duskline/terrain/height_field.h>
#include <duskline/view/camera.h>

#include <array>

namespace duskline::gl {

struct TerrainLight;

// What shaders of one picture are told of its view and its light, so that they agree.

std::array<float, 3> as_floats(const Vector3& v);

/// The size of cells, and the eye's place as whole ones, which shaders subtract exactly, and the rest.
void set_eye(const Program& program, const Camera& camera, CellSize cell_size_m);

/// For sky_colour.glsl.
void set_sky(const Program& program, const TerrainLight& light);

/// For what is lit, and for the haze before it, which is as thick as the terrain is large.
void set_light(const Program& program, const TerrainLight& light, const HeightField& field);

} // namespace duskline::gl
