#include <duskline/execution/run_stages.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

namespace duskline {
namespace {

using ::testing::ElementsAre;

class RunStages : public ::testing::TestWithParam<std::size_t> {
protected:
    Execution execution() const { return {.threads = GetParam()}; }
};

INSTANTIATE_TEST_SUITE_P(Threads, RunStages, ::testing::Values(1U, 2U, 5U));

TEST_P(RunStages, EveryItemPassesEveryStageInOrder)
{
    std::vector<std::size_t> first;
    std::vector<std::size_t> second;
    std::vector<std::size_t> third;
    run_stages(5, 2,
               {[&](std::size_t i) { first.push_back(i); }, [&](std::size_t i) { second.push_back(i); },
                [&](std::size_t i) { third.push_back(i); }},
               execution());
    EXPECT_THAT(first, ElementsAre(0U, 1U, 2U, 3U, 4U));
    EXPECT_EQ(second, first);
    EXPECT_EQ(third, first);
}

TEST_P(RunStages, ASlotBelongsToOneItemAtATime)
{
    constexpr std::size_t in_flight = 3;
    std::vector<std::size_t> slots(in_flight, 0);
    std::vector<std::size_t> results;
    run_stages(100, in_flight,
               {[&](std::size_t i) { slots[i % in_flight] = i; },
                [&](std::size_t i) { slots[i % in_flight] += 1000; },
                [&](std::size_t i) { results.push_back(slots[i % in_flight]); }},
               execution());
    ASSERT_EQ(results.size(), 100U);
    for (std::size_t i = 0; i < results.size(); ++i)
        EXPECT_EQ(results[i], 1000 + i);
}

TEST_P(RunStages, NothingToDoIsDone)
{
    run_stages(0, 2, {[](std::size_t) { FAIL(); }, [](std::size_t) { FAIL(); }}, execution());
}

TEST_P(RunStages, TheFailureOfAnyStageReachesTheCaller)
{
    for (std::size_t failing = 0; failing < 3; ++failing) {
        std::atomic<std::size_t> last_seen = 0;
        std::vector<Stage> stages;
        for (std::size_t stage = 0; stage < 3; ++stage)
            stages.emplace_back([&, stage](std::size_t i) {
                if (stage == failing && i == 4)
                    throw std::runtime_error("stage failed");
                if (stage == 2)
                    last_seen = i;
            });
        EXPECT_THROW(run_stages(1000, 2, stages, execution()), std::runtime_error) << failing;
        EXPECT_LT(last_seen, 7U) << "no stage goes on for long";
    }
}

TEST_P(RunStages, ProgressEndsAtOneAndMayStop)
{
    std::vector<double> reported;
    Execution with_progress = execution();
    with_progress.progress = [&](double done) {
        reported.push_back(done);
        return true;
    };
    run_stages(4, 2, {[](std::size_t) {}, [](std::size_t) {}}, with_progress);
    EXPECT_THAT(reported, ElementsAre(0.25, 0.5, 0.75, 1.0));

    with_progress.progress = [](double done) { return done < 0.5; };
    std::atomic<std::size_t> begun = 0;
    EXPECT_THROW(run_stages(1000, 2, {[&](std::size_t) { ++begun; }, [](std::size_t) {}}, with_progress),
                 Cancelled);
    EXPECT_LT(begun, 505U);
}

TEST(RunStagesOverlap, StagesWorkOnDifferentItemsAtOnce)
{
    // The first stage waits in its second item until the second stage has met the first one.
    std::atomic<bool> second_stage_began = false;
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    run_stages(2, 2,
               {[&](std::size_t i) {
                    while (i == 1 && !second_stage_began && std::chrono::steady_clock::now() < give_up)
                        std::this_thread::yield();
                },
                [&](std::size_t) { second_stage_began = true; }},
               {.threads = 2});
    EXPECT_LT(std::chrono::steady_clock::now(), give_up);
}

} // namespace
} // namespace duskline
