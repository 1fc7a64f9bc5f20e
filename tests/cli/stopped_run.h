#pragma once

#include "raster_run.h"

#include <string>

namespace duskline::cli_test {

/// When to stop a program: after it has moved `count` files in place whose names end with `suffix`.
struct StopAt {
    std::string suffix;
    int count = 1;
    int signal = 0;
};

/// A raster test whose program can be stopped between two files, at the same place every time.
class StoppedRun : public RasterRun {
protected:
    Finished run_until(const StopAt& stop, const Arguments& arguments) const
    {
        Arguments command = {"env",
                             "ASAN_OPTIONS=verify_asan_link_order=0",
                             "LD_PRELOAD=" DUSKLINE_SIGNAL_AT_RENAME,
                             "DUSKLINE_TEST_SUFFIX=" + stop.suffix,
                             "DUSKLINE_TEST_COUNT=" + std::to_string(stop.count),
                             "DUSKLINE_TEST_SIGNAL=" + std::to_string(stop.signal),
                             DUSKLINE_COMMAND};
        command.insert(command.end(), arguments.begin(), arguments.end());
        return run_program(command);
    }
};

} // namespace duskline::cli_test
