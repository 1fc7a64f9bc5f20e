#pragma once

#include <duskline/geometry/grid.h>
#include <duskline/raster_io/file_errors.h>

#include <array>
#include <cstdint>
#include <string>

namespace duskline {

/// Writes a picture that lies nowhere on a map, such as a screenshot: sRGB and opacity, row 0 on top; without opacity
/// where all of it is opaque. The format is that of the extension: PNG, JPEG, TIFF or any other that GDAL writes
/// colours to. The file appears whole or not at all.
///
/// Throws InvalidInput for an extension that says no such format; OutputError when the file is there and may not be
/// replaced (`overwrite`), or cannot be written.
void write_picture(const std::string& path, GridView<const std::array<std::uint8_t, 4>> picture,
                   bool overwrite = false);

/// The same for a grey one.
void write_picture(const std::string& path, GridView<const std::uint8_t> picture, bool overwrite = false);

} // namespace duskline
