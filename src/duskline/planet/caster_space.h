#pragma once

#include <duskline/planet/oriented_box.h>
#include <duskline/planet/planet_patch.h>
#include <duskline/planet/planet_quadtree.h>
#include <duskline/view/lamp_face.h>
#include <duskline/view/shadow_box.h>

#include <vector>

namespace duskline {

/// The part of space that a shadow box and its casters take.
OrientedBox space_of(const ShadowBox& box);

/// What may cast shadows into a shadow box, of the quadtree's casters (PlanetQuadtree::casters), no finer than its texels are
/// worth.
std::vector<PlanetPatch> casters_of(const PlanetQuadtree& quadtree, const ShadowBox& box);

/// A box round all that a face of a lamp may see.
OrientedBox space_of(const LampFace& face);

/// False only for what stands beside the face's view, or beyond its range.
bool may_cast_into(const LampFace& face, const OrientedBox& casters);

/// What may cast shadows into a face: of the quadtree's casters in its space those that it may see.
std::vector<PlanetPatch> casters_of(const PlanetQuadtree& quadtree, const LampFace& face);

} // namespace duskline
