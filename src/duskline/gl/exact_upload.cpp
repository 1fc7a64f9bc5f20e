#include <duskline/casting/visible_fraction.h>
#include <duskline/gl/exact_upload.h>

namespace duskline::gl {

ExactUpload::ExactUpload(const TerrainTextures& terrain)
    : shadows_(terrain.field()), upload_(terrain.field().rows(), terrain.field().columns()),
      texture_(upload_.new_texture())
{}

void ExactUpload::cast(const DirectionalLight& light)
{
    upload_.upload(shadows_.cast(light), texture_);
}

void ExactUpload::heights_changed(const CellRectangle& rectangle)
{
    shadows_.heights_changed(rectangle);
    upload_.upload(shadows_.mask(), texture_);
}

SoftExactUpload::SoftExactUpload(const TerrainTextures& terrain)
    : field_(terrain.field()), upload_(terrain.field().rows(), terrain.field().columns()),
      texture_(upload_.new_texture())
{}

void SoftExactUpload::cast(const DirectionalLight& light)
{
    upload_.upload(visible_fraction(field_, light, caster_named("exact")), texture_);
    light_ = light;
}

} // namespace duskline::gl
