#include <duskline/execution/for_rows.h>
#include <duskline/gl/exact_upload.h>

#include <algorithm>

namespace duskline::gl {

namespace {

constexpr std::size_t kRowsPerPiece = 64;

} // namespace

ExactUpload::ExactUpload(const TerrainTextures& terrain)
    : shadows_(terrain.field()), bytes_(terrain.field().rows(), terrain.field().columns(), 255),
      texture_(TextureFormat::r8, terrain.field().columns(), terrain.field().rows())
{
    texture_.upload(bytes_);
}

void ExactUpload::cast(const DirectionalLight& light)
{
    shadows_.cast(light);
    upload();
}

void ExactUpload::heights_changed(const CellRectangle& rectangle)
{
    shadows_.heights_changed(rectangle);
    upload();
}

// Cells without data count as lit, so that the ground beside them is.
void ExactUpload::upload()
{
    const ShadowMask& mask = shadows_.mask();
    for_rows(mask.rows(), kRowsPerPiece, {}, [&](std::size_t first, std::size_t last) {
        for (std::size_t row = first; row < last; ++row)
            std::ranges::transform(mask.row(row), bytes_.row(row).begin(), [](Lit lit) {
                return static_cast<std::uint8_t>(lit == Lit::no ? 0 : 255);
            });
    });
    texture_.upload(bytes_);
}

} // namespace duskline::gl
