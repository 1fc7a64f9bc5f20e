#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace duskline::raster_test {

/// A small raster to be written with GDAL, for tests of reading.
struct MadeRaster {
    std::size_t rows = 4;
    std::size_t columns = 6;
    std::string type = "Float32"; ///< GDAL's name
    std::string format = "GTiff";
    std::optional<std::array<double, 6>> geotransform =
        std::array{500000.0, 10.0, 0.0, 4000000.0, 0.0, -10.0};
    std::string crs = "EPSG:32633"; ///< anything GDAL understands; empty: none
    std::optional<double> no_data = {};
    double scale = 1.0;
    double offset = 0.0;
    std::string unit = {};
    std::vector<std::string> colours =
        {}; ///< one per band: red, green, blue, alpha, grey, palette; empty: one band
    std::vector<std::string> creation_options = {};

    /// The stored number of a cell of band `band` (from 1), rows and columns in the file's order.
    std::function<double(std::size_t band, std::size_t row, std::size_t column)> value =
        [](std::size_t, std::size_t row, std::size_t column) {
            return static_cast<double>(100 * row + column);
        };
};

void write(const MadeRaster& raster, const std::string& path);

/// A test with a folder of its own, which goes away afterwards.
class FolderTest : public ::testing::Test {
protected:
    FolderTest();
    ~FolderTest() override;

    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    std::vector<std::string> files() const; ///< names, sorted, hidden ones too

    /// Writes the raster and returns its path.
    std::string made(const MadeRaster& raster, const std::string& name = "heights.tif") const;

private:
    std::filesystem::path folder_;
};

/// A file of the data that is shared among developers; empty when it is not there.
std::string shared_data(const std::string& name);

} // namespace duskline::raster_test

/// Skips a test whose real elevation model is not at hand.
#define DUSKLINE_NEED_SHARED_DATA(name)                                                                      \
    if (duskline::raster_test::shared_data(name).empty())                                                    \
    GTEST_SKIP() << "there is no " << (name) << " in the shared elevation data"
