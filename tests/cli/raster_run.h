#pragma once

#include "command_line.h"
#include "raster_io/made_raster.h"

#include <duskline/geometry/grid.h>

#include <map>
#include <string>
#include <vector>

namespace duskline::cli_test {

/// A raster as some other program would read it: in the order of the file.
struct ReadRaster {
    std::size_t rows = 0;
    std::size_t columns = 0;
    std::vector<float> values;
    double no_data = 0.0;
    std::string description;
    std::map<std::string, std::string> tags;
    std::array<double, 6> geotransform{};
    std::string crs_name;

    float operator()(std::size_t row, std::size_t column) const { return values[row * columns + column]; }
};

/// Throws std::runtime_error when it cannot be read.
ReadRaster read_raster(const std::string& path);

/// A command-line test with elevation files of its own.
class RasterRun : public CommandLineTest {
protected:
    /// Writes a raster to the test's folder.
    void make(const raster_test::MadeRaster& raster, const std::string& name = "dem.tif") const
    {
        raster_test::write(raster, path(name).string());
    }

    /// Hills with a shadow anywhere, the same every time, holes included; 10 m cells.
    static raster_test::MadeRaster hills(std::size_t rows, std::size_t columns);

    ReadRaster read(const std::string& name) const { return read_raster(path(name).string()); }
};

} // namespace duskline::cli_test
