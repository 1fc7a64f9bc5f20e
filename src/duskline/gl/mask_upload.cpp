#include <duskline/execution/for_rows.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/mask_upload.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace duskline::gl {

namespace {

constexpr std::size_t kRowsPerPiece = 64;

} // namespace

MaskUpload::MaskUpload(std::size_t rows, std::size_t columns) : bytes_(rows, columns) {}

Texture MaskUpload::new_texture()
{
    Texture texture(TextureFormat::r8, bytes_.columns(), bytes_.rows());
    std::ranges::fill(bytes_.values(), std::uint8_t{255});
    texture.upload(bytes_);
    texture.set_filter(Texture::Filter::linear);
    return texture;
}

void MaskUpload::upload(const ShadowMask& mask, Texture& into)
{
    upload_as(
        mask, [](Lit lit) { return static_cast<std::uint8_t>(lit == Lit::no ? 0 : 255); }, into);
}

void MaskUpload::upload(const VisibleFraction& fraction, Texture& into)
{
    const auto to_byte = [](float part) {
        return static_cast<std::uint8_t>(std::isnan(part) ? 255.0f : 255.0f * part + 0.5f);
    };
    upload_as(fraction, to_byte, into);
}

template <typename Value, typename ToByte>
void MaskUpload::upload_as(const Grid<Value>& values, const ToByte& to_byte, Texture& into)
{
    const auto is_size = [&](std::size_t rows, std::size_t columns) {
        return rows == bytes_.rows() && columns == bytes_.columns();
    };
    if (!is_size(values.rows(), values.columns()) || !is_size(into.height(), into.width()))
        throw InvalidInput("a mask and its texture must have " + std::to_string(bytes_.rows()) + " x "
                           + std::to_string(bytes_.columns()) + " cells");
    for_rows(values.rows(), kRowsPerPiece, {}, [&](std::size_t first, std::size_t last) {
        for (std::size_t row = first; row < last; ++row)
            std::ranges::transform(values.row(row), bytes_.row(row).begin(), to_byte);
    });
    into.upload(bytes_);
}

} // namespace duskline::gl
