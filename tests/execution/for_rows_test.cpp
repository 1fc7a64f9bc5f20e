#include <duskline/execution/for_rows.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace duskline {
namespace {

TEST(ForRows, EveryRowIsVisitedOnceWhateverThePiecesAndThreads)
{
    for (const std::size_t count : {0U, 1U, 7U, 100U})
        for (const std::size_t piece : {0U, 1U, 3U, 100U, 1000U})
            for (const std::size_t threads : {0U, 1U, 2U, 5U}) {
                std::vector<int> visits(count);
                for_rows(count, piece, {.threads = threads}, [&](std::size_t first, std::size_t last) {
                    EXPECT_LT(first, last);
                    EXPECT_LE(last - first, std::max<std::size_t>(piece, 1));
                    for (std::size_t i = first; i < last; ++i)
                        ++visits[i];
                });
                EXPECT_EQ(visits, std::vector<int>(count, 1))
                    << count << " rows in pieces of " << piece << " on " << threads << " threads";
            }
}

TEST(ForRows, MoreThreadsThanProcessorsAreGivenInSilence)
{
    const std::size_t threads = std::thread::hardware_concurrency() + 2;
    std::atomic<std::size_t> waiting = 0;
    testing::internal::CaptureStderr();
    // Every piece waits until all have begun: fewer threads would never get there.
    for_rows(threads, 1, {.threads = threads}, [&](std::size_t, std::size_t) {
        ++waiting;
        while (waiting < threads)
            std::this_thread::yield();
    });
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ForRows, ProgressComesOneCallAtATimeNeverFallsAndEndsAtOne)
{
    for (const std::size_t threads : {1U, 4U}) {
        std::atomic<int> inside = 0;
        double last = 0.0;
        const auto progress = [&](double done) {
            EXPECT_EQ(++inside, 1);
            EXPECT_GT(done, last);
            last = done;
            --inside;
            return true;
        };
        for_rows(50, 3, {.threads = threads, .progress = progress}, [](std::size_t, std::size_t) {});
        EXPECT_EQ(last, 1.0);
    }
}

TEST(ForRows, AFalseFromProgressStopsTheWork)
{
    for (const std::size_t threads : {1U, 4U}) {
        std::atomic<std::size_t> begun = 0;
        const auto progress = [](double) { return false; };
        const auto work = [&](std::size_t, std::size_t) { ++begun; };
        EXPECT_THROW(for_rows(100000, 1, {.threads = threads, .progress = progress}, work), Cancelled);
        EXPECT_LT(begun, 100000U);
    }
}

TEST(ForRows, WhatTheWorkThrowsReachesTheCaller)
{
    for (const std::size_t threads : {1U, 4U}) {
        const auto work = [](std::size_t first, std::size_t) {
            if (first == 5)
                throw std::out_of_range("row 5");
        };
        EXPECT_THROW(for_rows(10, 1, {.threads = threads}, work), std::out_of_range);
    }
}

TEST(ForRows, WorkMayAskForMoreWork)
{
    std::atomic<std::size_t> cells = 0;
    for_rows(20, 1, {.threads = 3}, [&](std::size_t, std::size_t) {
        for_rows(10, 2, {.threads = 2}, [&](std::size_t first, std::size_t last) { cells += last - first; });
    });
    EXPECT_EQ(cells, 200U);
}

} // namespace
} // namespace duskline
