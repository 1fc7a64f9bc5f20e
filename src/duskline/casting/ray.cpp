// Shadows by marching rays: the definition, in double precision. The march itself is in ray_march.h, where
// the fast ray finds it too.

#include <duskline/casting/lamp_march.h>
#include <duskline/casting/ray.h>
#include <duskline/casting/ray_cells.h>
#include <duskline/casting/ray_march.h>

namespace duskline {

ShadowMask cast_by_ray(const HeightField& field, const DirectionalLight& light, const Execution& execution)
{
    require_valid(field);
    require_valid(light);
    if (const auto answer = uniform_answer(light))
        return uniform_mask(field, *answer);

    const RayMarch march(field, light, height_range(field));
    return mask_by_rays(field, execution, [&](std::size_t row, std::size_t column, double ground_m) {
        return march.shadow_height_m(march.surface().start_at(row, column), ground_m, ground_m);
    });
}

ShadowField shadow_heights_by_ray(const HeightField& field, const DirectionalLight& light,
                                  const Execution& execution)
{
    require_valid(field);
    require_valid(light);
    if (const auto answer = uniform_answer(light))
        return uniform_shadow_heights(field, *answer);

    const RayMarch march(field, light, height_range(field));
    return shadow_heights_by_rays(field, execution, [&](std::size_t row, std::size_t column) {
        return march.shadow_height_m(march.surface().start_at(row, column), kNothing, kNeverEnough);
    });
}

ShadowMask cast_by_ray(const HeightField& field, const PointLight& light, const Execution& execution)
{
    require_valid(field);
    require_valid(light);
    if (const auto answer = uniform_answer(field, light))
        return uniform_mask(field, *answer);

    const LampMarch march(field, light, height_range(field));
    return mask_by_rays(field, execution, [&](std::size_t row, std::size_t column, double ground_m) {
        return shadow_height_m(march.ray_from(row, column), ground_m, ground_m);
    });
}

ShadowField shadow_heights_by_ray(const HeightField& field, const PointLight& light,
                                  const Execution& execution)
{
    require_valid(field);
    require_valid(light);
    if (const auto answer = uniform_answer(field, light))
        return uniform_shadow_heights(field, *answer);

    const LampMarch march(field, light, height_range(field));
    return shadow_heights_by_rays(field, execution, [&](std::size_t row, std::size_t column) {
        return shadow_height_m(march.ray_from(row, column), kNothing, kNeverEnough);
    });
}

} // namespace duskline
