#include <duskline/gl/picture_uniforms.h>
#include <duskline/gl/scene_objects.h>
#include <duskline/gl/terrain_shadow.h>

#include <epoxy/gl.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace duskline::gl {

namespace {

constexpr unsigned int kHeightsUnit = 0;

struct Corner {
    std::array<float, 3> place;
    std::array<float, 3> normal;
    std::array<float, 3> colour;
};

// As scene_object.vert.glsl has it.
struct Placed {
    std::array<float, 4> place;
    std::array<float, 4> size;
};

using Colour3 = std::array<float, 3>;

class Modelling {
public:
    // Counter-clockwise from outside.
    void triangle(Vector3 a, Vector3 b, Vector3 c, Colour3 colour)
    {
        const Vector3 u = b - a;
        const Vector3 v = c - a;
        const Vector3 normal{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
        for (const Vector3& place : {a, b, c})
            corners_.push_back({as_floats(place), as_floats(normalized(normal)), colour});
    }

    void quadrangle(Vector3 a, Vector3 b, Vector3 c, Vector3 d, Colour3 colour)
    {
        triangle(a, b, c, colour);
        triangle(a, c, d, colour);
    }

    void box(Vector3 low, Vector3 high, Colour3 colour)
    {
        const auto at = [&](int x, int y, int z) {
            return Vector3{x != 0 ? high.x : low.x, y != 0 ? high.y : low.y, z != 0 ? high.z : low.z};
        };
        quadrangle(at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1), colour);
        quadrangle(at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1), colour);
        quadrangle(at(1, 1, 0), at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), colour);
        quadrangle(at(0, 1, 0), at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), colour);
        quadrangle(at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1), colour);
        quadrangle(at(0, 1, 0), at(1, 1, 0), at(1, 0, 0), at(0, 0, 0), colour);
    }

    // Round an upright axis from one height to a point at another.
    void cone(double radius, double from, double to, int sides, Colour3 colour)
    {
        const auto on_circle = [&](int side) {
            const double around = 2.0 * std::numbers::pi * side / sides;
            return Vector3{radius * std::cos(around), radius * std::sin(around), from};
        };
        for (int side = 0; side < sides; ++side)
            triangle(on_circle(side), on_circle(side + 1), {0.0, 0.0, to}, colour);
    }

    std::vector<Corner>& corners() { return corners_; }

private:
    std::vector<Corner> corners_;
};

void model_tree(Modelling& modelling)
{
    modelling.box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.2}, {0.20f, 0.13f, 0.08f});
    modelling.cone(0.5, 0.15, 0.7, 7, {0.10f, 0.22f, 0.07f});
    modelling.cone(0.36, 0.45, 1.0, 7, {0.13f, 0.26f, 0.08f});
}

// Reaches under the ground, for slopes.
void model_tower(Modelling& modelling)
{
    modelling.box({-0.5, -0.5, -0.15}, {0.5, 0.5, 1.0}, {0.70f, 0.36f, 0.24f});
}

void model_aircraft(Modelling& modelling)
{
    const Colour3 white = {0.85f, 0.85f, 0.88f};
    modelling.box({-0.045, -0.45, -0.045}, {0.045, 0.5, 0.045}, white);
    modelling.box({-0.5, -0.03, -0.012}, {0.5, 0.13, 0.012}, white);
    modelling.box({-0.18, -0.45, -0.010}, {0.18, -0.35, 0.010}, white);
    modelling.box({-0.012, -0.45, 0.0}, {0.012, -0.34, 0.16}, {0.65f, 0.10f, 0.10f});
}

std::array<float, 4> size_of(double width_m, double height_m, Angle turn)
{
    const SineCosine direction = sine_cosine(turn);
    return {static_cast<float>(width_m), static_cast<float>(height_m), static_cast<float>(direction.cosine),
            static_cast<float>(direction.sine)};
}

Buffer placed(const std::vector<StandingObject>& objects)
{
    std::vector<Placed> places;
    places.reserve(objects.size());
    for (const StandingObject& object : objects)
        places.push_back({{static_cast<float>(object.column), static_cast<float>(object.row), 0.0f, 1.0f},
                          size_of(object.width_m, object.height_m, object.turn)});
    Buffer buffer;
    buffer.upload(places);
    return buffer;
}

Texture one_texel(float height_m)
{
    Texture texture(TextureFormat::r32f, 1, 1);
    texture.upload(Grid<float>(1, 1, height_m));
    return texture;
}

} // namespace

SceneObjects::SceneObjects(const ShaderSources& sources, const TerrainTextures& terrain, Scenery scenery)
    : sources_(sources), terrain_(terrain), scenery_(std::move(scenery)),
      object_program_(sources, {.stages = {"scene_object.vert.glsl", "scene_object.frag.glsl"}}),
      cloud_program_(sources, {.stages = {"cloud_layer.vert.glsl", "cloud_layer.frag.glsl"}}),
      nothing_shades_(one_texel(-std::numeric_limits<float>::infinity())), trees_(placed(scenery_.trees)),
      towers_(placed(scenery_.towers))
{
    Modelling modelling;
    const auto modelled = [&modelling](void (*model)(Modelling&)) {
        const std::size_t first = modelling.corners().size();
        model(modelling);
        return Shape{first, modelling.corners().size() - first};
    };
    tree_ = modelled(model_tree);
    tower_ = modelled(model_tower);
    aircraft_ = modelled(model_aircraft);
    corners_.upload(modelling.corners());
    for (const unsigned int part : {0U, 1U, 2U})
        shapes_.set_floats(part, corners_, 3, sizeof(Corner), part * sizeof(std::array<float, 3>));
}

void SceneObjects::set_view(const Program& program, const TerrainView& view, const DepthRange& depth,
                            const TerrainLight& light) const
{
    const HeightField& field = terrain_.field();
    const double aspect = static_cast<double>(view.width) / static_cast<double>(view.height);
    program.set("mesh_heights_m", static_cast<int>(kHeightsUnit));
    set_eye(program, view.camera, field.cell_size_m);
    set_light(program, light, field);
    program.set_matrix("eye_to_clip", eye_to_clip(view.camera, aspect, depth));
}

void SceneObjects::draw(const TerrainView& view, const DepthRange& depth, const TerrainLight& light,
                        const Texture* shadow_heights, double seconds)
{
    GridPlacement from_eye = placement_in_metres(terrain_.field().cell_size_m);
    from_eye.origin = view.camera.position_m * -1.0;
    const Texture& shadow = shadow_heights != nullptr ? *shadow_heights : nothing_shades_;
    bind_terrain_shadow(shadow, terrain_shadow_block(from_eye, shadow, light.light), shadow_block_);
    terrain_.mesh_heights().bind(kHeightsUnit);

    glEnable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    object_program_.use();
    set_view(object_program_, view, depth, light);
    draw_shape(tree_, trees_);
    draw_shape(tower_, towers_);
    if (scenery_.aircraft)
        draw_aircraft(*scenery_.aircraft, seconds);
    if (scenery_.clouds) {
        cloud_program_.use();
        set_view(cloud_program_, view, depth, light);
        draw_clouds(*scenery_.clouds, seconds);
    }
    glDisable(GL_DEPTH_TEST);
}

void SceneObjects::draw_shape(const Shape& shape, const Buffer& places) const
{
    const std::size_t count = places.bytes() / sizeof(Placed);
    if (count == 0)
        return;
    places.bind_as_storage(0);
    shapes_.draw(VertexArray::Shape::triangles, shape.first_corner, shape.corners, count);
}

void SceneObjects::draw_aircraft(const CirclingAircraft& aircraft, double seconds) const
{
    const GridPoint at = place_of(aircraft, terrain_.field().cell_size_m, seconds);
    Buffer buffer;
    buffer.upload(std::vector<Placed>{
        {{static_cast<float>(at.column), static_cast<float>(at.row), static_cast<float>(at.height_m), 0.0f},
         size_of(aircraft.span_m, aircraft.span_m, heading_of(aircraft, seconds))}});
    draw_shape(aircraft_, buffer);
}

// Over what is there, and not in the way of anything.
void SceneObjects::draw_clouds(const CloudLayer& clouds, double seconds) const
{
    const HeightField& field = terrain_.field();
    cloud_program_.set("last_cell", std::array<float, 2>{static_cast<float>(field.columns()) - 1.0f,
                                                         static_cast<float>(field.rows()) - 1.0f});
    cloud_program_.set("layer_m", static_cast<float>(clouds.height_m));
    cloud_program_.set("feature_m", static_cast<float>(clouds.feature_m));
    cloud_program_.set("cover", static_cast<float>(clouds.cover));
    cloud_program_.set("drifted_m", static_cast<float>(clouds.drift_m_per_s * seconds));
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glDepthMask(GL_FALSE);
    no_vertices_.draw(VertexArray::Shape::triangle_strip, 0, 4);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
}

bool SceneObjects::reload_if_changed()
{
    const bool objects = object_program_.reload_if_changed(sources_);
    return cloud_program_.reload_if_changed(sources_) || objects;
}

} // namespace duskline::gl
