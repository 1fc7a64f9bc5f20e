#include <duskline/execution/for_rows.h>
#include <duskline/products/shadow_classes.h>
#include <duskline/terrain/normals.h>
#include <duskline/terrain/require_same_size.h>

#include <vector>

namespace duskline {

namespace {

ShadowClass class_of(Lit lit, bool looks_away)
{
    if (lit == Lit::unknown)
        return ShadowClass::unknown;
    if (lit == Lit::yes)
        return ShadowClass::lit;
    return looks_away ? ShadowClass::self_shaded : ShadowClass::cast;
}

} // namespace

ShadowClasses shadow_classes(const HeightField& field, const ShadowMask& mask, const DirectionalLight& light,
                             const Execution& execution)
{
    require_valid(field);
    require_valid(light);
    require_same_size("the mask", mask, field);
    const Vector3 towards = direction_towards(light);
    ShadowClasses classes(field.rows(), field.columns());
    for_rows(field.rows(), 16, execution, [&](std::size_t first, std::size_t last) {
        std::vector<float> dz_dx(field.columns());
        std::vector<float> dz_dy(field.columns());
        for (std::size_t row = first; row < last; ++row) {
            slopes_of_row(field, row, dz_dx, dz_dy);
            for (std::size_t x = 0; x < field.columns(); ++x) {
                // The normal is (-dz_dx, -dz_dy, 1), but for its length.
                const bool looks_away = towards.z - towards.x * dz_dx[x] - towards.y * dz_dy[x] <= 0.0;
                classes(row, x) = class_of(mask(row, x), looks_away);
            }
        }
    });
    return classes;
}

} // namespace duskline
