#pragma once

#include <duskline/products/colour.h>

#include <optional>
#include <string_view>
#include <vector>

namespace duskline {

/// Colours by height.
class Palette {
public:
    struct Entry {
        double height_m = 0.0;
        Colour colour;
        float opacity = 1.0f; ///< 0 to 1
    };

    /// One grey for every height.
    Palette();

    /// Entries in any order; where two have the same height, the one given later counts from that height
    /// on and the other up to it: a hard edge. Throws InvalidInput when there are none, or a height is NaN.
    explicit Palette(std::vector<Entry> entries);

    /// Linear in light between entries, the first and the last beyond them. No colour for a NaN height: the
    /// caller's affair.
    Entry at(float height_m) const;

    /// From the lowest up.
    const std::vector<Entry>& entries() const { return entries_; }

    /// The pixel for cells without data, where a palette names one.
    std::optional<Rgba8> no_data;

private:
    std::vector<Entry> entries_;
};

/// Reads the text of a palette as `gdaldem color-relief` does. One entry a line: a height, then red, green,
/// blue and perhaps opacity, 0 to 255 each, or a colour's name; separated by spaces, tabs, commas or colons.
/// The height may be a percentage of the way from the lowest to the highest ground, or `nv` for cells without
/// data. `#` begins a comment. Between entries colours are linear in sRGB, as gdaldem's are.
///
/// Throws InvalidInput, with the number of the line, for text that is none of this.
Palette palette_from_text(std::string_view text, double lowest_m, double highest_m);

} // namespace duskline
