#include <duskline/execution/available_memory.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/raster_io/memory_need.h>
#include <duskline/raster_io/plain_number.h>

namespace duskline {

namespace {

std::string gibibytes(double bytes)
{
    return plain_number(bytes / 1024.0 / 1024.0 / 1024.0, bytes < 1e9 ? 3 : 1) + " GiB";
}

} // namespace

void require_memory(std::size_t rows, std::size_t columns, double bytes_per_cell, const std::string& what)
{
    const auto available = static_cast<double>(available_memory_bytes());
    const double needed = static_cast<double>(rows) * static_cast<double>(columns) * bytes_per_cell;
    if (needed <= available)
        return;
    throw UnsupportedOnThisMachine(
        what + " (" + std::to_string(rows) + " rows x " + std::to_string(columns) + " columns) needs "
        + gibibytes(needed) + " of memory, " + gibibytes(available)
        + " are free; cut out a part (gdal_translate -srcwin) or take larger cells "
          "(gdal_translate -r average -outsize 25% 25%)");
}

} // namespace duskline
