#include "planet_lamps.h"

#include <duskline/planet/caster_space.h>

#include <algorithm>

namespace duskline::planet_app {
namespace {

// How far the eye may move from where maps were drawn for, of its height over the ground.
constexpr double kMoved = 0.1;

bool same_place(const Vector3& a, const Vector3& b)
{
    return length(a - b) == 0.0;
}

OrientedBox box_round(const SceneLamp& lamp)
{
    return {lamp.position_m,
            {Vector3{1.0, 0.0, 0.0}, Vector3{0.0, 1.0, 0.0}, Vector3{0.0, 0.0, 1.0}},
            {lamp.range_m, lamp.range_m, lamp.range_m}};
}

} // namespace

std::vector<PlanetPatch> PlanetLamps::tiles_in_range(const std::vector<SceneLamp>& lamps) const
{
    std::vector<PlanetPatch> tiles;
    for (const SceneLamp& lamp : lamps)
        std::ranges::copy(quadtree_.casters(box_round(lamp)), std::back_inserter(tiles));
    return tiles;
}

bool PlanetLamps::mesh_has_turned(const PlanetCamera& camera, bool exact)
{
    const bool stands = same_place(camera.eye_m, last_eye_m_);
    last_eye_m_ = camera.eye_m;
    if (exact || stands)
        return !same_place(camera.eye_m, cast_for_eye_m_);
    return length(camera.eye_m - cast_for_eye_m_) > kMoved * clearance_m(camera, terrain_);
}

std::size_t PlanetLamps::update(const PlanetState& state, bool exact)
{
    std::vector<SceneLamp> lamps;
    for (const PlacedLamp& lamp : state.lamps)
        if (lamp.light.on)
            lamps.push_back(scene_lamp(terrain_, lamp));
    if (lamps.empty() && !maps_)
        return 0;
    if (!maps_)
        maps_.emplace();
    std::vector<PlanetPatch> casters = tiles_in_range(lamps);
    const bool turned = mesh_has_turned(state.camera, exact);
    if (turned || casters != cast_) {
        maps_->casters_changed();
        cast_for_eye_m_ = state.camera.eye_m;
    }
    cast_ = std::move(casters);
    // Of the eye for which the mesh in the other maps is.
    return maps_->update(lamps, [&](const LampFace& face) {
        const Vector3& eye_m = cast_for_eye_m_;
        renderer_.draw_depth(eye_m, face_to_clip(face, eye_m), casters_of(quadtree_, face));
    });
}

const gl::LampMaps* PlanetLamps::maps() const
{
    return maps_ && !maps_->lamps().empty() ? &*maps_ : nullptr;
}

} // namespace duskline::planet_app
