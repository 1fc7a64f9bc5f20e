#pragma once

#include <duskline/execution/progress.h>
#include <duskline/geometry/grid.h>
#include <duskline/raster_io/file_errors.h>
#include <duskline/raster_io/read_height_field.h>
#include <duskline/terrain/height_field.h>
#include <duskline/terrain/normals.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace duskline {

/// A terrain as a mesh with a colour at every vertex.
struct PlyMesh {
    HeightField field; ///< metres; a vertex for every cell with data
    const NormalField& normals;
    GridView<const std::array<std::uint8_t, 3>> colours; ///< red, green and blue
    double base_m = 0.0;                                 ///< added to heights; see HeightFile::read
    std::vector<std::string> comments = {};              ///< one line each, for the file's head
};

/// Writes a binary PLY file (little endian), which mesh viewers and modellers read.
///
/// Vertices come row by row: x east and y north of the grid's centre and z up, metres, as floats; the unit normal nx,
/// ny, nz; red, green, blue. Each square of four cells with data is two triangles, counter-clockwise seen from above,
/// cut along its south-west to north-east diagonal; cells without data leave holes.
///
/// The file appears whole or not at all, as a raster's does (RasterWriter). Throws InvalidInput for sizes that differ
/// and for more than 2^31 - 1 vertices, which is what viewers count; OutputError as RasterWriter; Cancelled. 27 bytes
/// a vertex and 13 a triangle, 53 a cell.
void write_ply(const std::string& path, const HeightFile& like, const PlyMesh& mesh, bool overwrite = false,
               const ProgressCallback& progress = {});

/// Throws OutputError, before any work, when `write_ply` could not write there.
void require_writable_ply(const std::string& path, const HeightFile& like, bool overwrite);

} // namespace duskline
