#pragma once

#include <duskline/casting/shadow_mask.h>
#include <duskline/casting/visible_fraction.h>
#include <duskline/gl/texture.h>

#include <cstdint>

namespace duskline::gl {

/// Brings masks that were found on the processor to the card, a byte a cell (r8): 0 in shadow, 1 in the light and for no
/// data, so that the ground beside that is lit. Memory: a byte a cell, whatever number of textures there are.
class MaskUpload {
public:
    MaskUpload(std::size_t rows, std::size_t columns);

    /// A texture of that size, all in the light. Throws InvalidInput when the context has none.
    Texture new_texture();

    /// Replaces all of such a texture. Throws InvalidInput for another size. Cost: a pass over the cells, and a byte a cell
    /// to the card.
    void upload(const ShadowMask& mask, Texture& into);
    void upload(const VisibleFraction& fraction, Texture& into);

private:
    template <typename Value, typename ToByte>
    void upload_as(const Grid<Value>& values, const ToByte& to_byte, Texture& into);

    Grid<std::uint8_t> bytes_;
};

} // namespace duskline::gl
