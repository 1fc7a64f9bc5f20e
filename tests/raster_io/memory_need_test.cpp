#include <duskline/execution/available_memory.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/raster_io/memory_need.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <fstream>

namespace duskline {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(MemoryNeed, WhatFitsIsFine)
{
    EXPECT_NO_THROW(require_memory(1000, 1000, 4.0, "a small raster"));
    EXPECT_NO_THROW(require_memory(0, 1000, 4.0, "nothing"));
    EXPECT_GT(available_memory_bytes(), std::size_t{1} << 20U);
}

TEST(MemoryNeed, WhatDoesNotFitIsRefusedWithNumbersAndARemedy)
{
    try {
        require_memory(500000, 500000, 4.0, "'dem.vrt'");
        FAIL() << "nobody has a tebibyte";
    } catch (const UnsupportedOnThisMachine& error) {
        EXPECT_THAT(error.what(),
                    AllOf(HasSubstr("'dem.vrt' (500000 rows x 500000 columns)"), HasSubstr("931.3 GiB"),
                          HasSubstr("are free"), HasSubstr("gdal_translate")));
    }
    // Products of sizes beyond 2^64 bytes are large too.
    EXPECT_THROW(require_memory(std::size_t{1} << 40U, std::size_t{1} << 40U, 4.0, "'dem.vrt'"),
                 UnsupportedOnThisMachine);
}

TEST(MemoryNeed, TheLimitOfAddressesCounts)
{
    std::size_t used_pages = 0;
    std::ifstream("/proc/self/statm") >> used_pages;
    rlimit before = {};
    ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
    rlimit tight = before;
    tight.rlim_cur = used_pages * 4096 + (std::size_t{64} << 20U);
    ASSERT_EQ(setrlimit(RLIMIT_AS, &tight), 0);
    const std::size_t available = available_memory_bytes();
    EXPECT_THROW(require_memory(1024, 128 * 1024, 1.0, "a raster of 128 MiB"), UnsupportedOnThisMachine);
    EXPECT_NO_THROW(require_memory(1024, 1024, 1.0, "a raster of 1 MiB"));
    setrlimit(RLIMIT_AS, &before);
    EXPECT_LE(available, std::size_t{65} << 20U);
}

} // namespace
} // namespace duskline
