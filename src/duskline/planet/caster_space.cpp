#include <duskline/planet/caster_space.h>

#include <algorithm>

namespace duskline {

OrientedBox space_of(const ShadowBox& box)
{
    const double half_m = box.side_m / 2.0;
    return {box.centre_m + box.axes.towards_light * (box.caster_reach_m / 2.0),
            {box.axes.right, box.axes.up, box.axes.towards_light},
            {half_m, half_m, half_m + box.caster_reach_m / 2.0}};
}

std::vector<PlanetPatch> casters_of(const PlanetQuadtree& quadtree, const ShadowBox& box)
{
    return quadtree.casters(space_of(box), box.texel_m);
}

OrientedBox space_of(const LampFace& face)
{
    const double half_m = face.half_width * face.range_m;
    return {face.lamp_m + face.axes.forward * (face.range_m / 2.0),
            {face.axes.right, face.axes.up, face.axes.forward},
            {half_m, half_m, face.range_m / 2.0}};
}

bool may_cast_into(const LampFace& face, const OrientedBox& casters)
{
    return distance_m(face.lamp_m, casters) < face.range_m
           && std::ranges::all_of(sides_of(face), [&](const Vector3& inwards) {
                  return dot(inwards, casters.centre_m - face.lamp_m) + reach_m(casters, inwards) >= 0.0;
              });
}

std::vector<PlanetPatch> casters_of(const PlanetQuadtree& quadtree, const LampFace& face)
{
    std::vector<PlanetPatch> casters = quadtree.casters(space_of(face));
    std::erase_if(casters, [&](const PlanetPatch& patch) {
        const HeightRange heights = quadtree.heights_of(patch.tile).range;
        return !may_cast_into(face, box_around(quadtree.terrain().globe(), patch.tile, heights));
    });
    return casters;
}

} // namespace duskline
