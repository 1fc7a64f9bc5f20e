#include <duskline/execution/for_rows.h>
#include <duskline/execution/run_stages.h>

#include <algorithm>
#include <cassert>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

namespace duskline {

namespace {

void report(std::size_t done, std::size_t count, const ProgressCallback& progress)
{
    if (progress && !progress(static_cast<double>(done) / static_cast<double>(count)))
        throw Cancelled();
}

// Who may go on, told by how many items each stage has finished.
class Belt {
public:
    Belt(std::size_t count, std::size_t in_flight, std::size_t stages)
        : count_(count), in_flight_(in_flight), finished_(stages, 0)
    {}

    // Blocks until `stage` may take its next item; false when there is none, or someone failed.
    bool wait_for_item(std::size_t stage)
    {
        std::unique_lock lock(mutex_);
        const std::size_t item = finished_[stage];
        moved_.wait(lock, [&] { return failure_ || item == count_ || is_ready(stage, item); });
        return !failure_ && item < count_;
    }

    void finish_item(std::size_t stage)
    {
        const std::scoped_lock lock(mutex_);
        ++finished_[stage];
        moved_.notify_all();
    }

    void fail(std::exception_ptr failure)
    {
        const std::scoped_lock lock(mutex_);
        if (!failure_)
            failure_ = std::move(failure);
        moved_.notify_all();
    }

    void rethrow_failure() const
    {
        if (failure_)
            std::rethrow_exception(failure_);
    }

private:
    bool is_ready(std::size_t stage, std::size_t item) const
    {
        return stage == 0 ? item < finished_.back() + in_flight_ : item < finished_[stage - 1];
    }

    const std::size_t count_;
    const std::size_t in_flight_;
    std::mutex mutex_;
    std::condition_variable moved_;
    std::vector<std::size_t> finished_;
    std::exception_ptr failure_;
};

} // namespace

void run_stages(std::size_t count, std::size_t in_flight, const std::vector<Stage>& stages,
                const Execution& execution)
{
    assert(!stages.empty());
    in_flight = std::max<std::size_t>(in_flight, 1);
    if (thread_count(execution) == 1 || in_flight == 1 || stages.size() == 1) {
        for (std::size_t item = 0; item < count; ++item) {
            for (const Stage& stage : stages)
                stage(item);
            report(item + 1, count, execution.progress);
        }
        return;
    }

    Belt belt(count, in_flight, stages.size());
    const auto work = [&](std::size_t stage) {
        try {
            for (std::size_t item = 0; belt.wait_for_item(stage); ++item) {
                stages[stage](item);
                if (stage + 1 == stages.size())
                    report(item + 1, count, execution.progress);
                belt.finish_item(stage);
            }
        } catch (...) {
            belt.fail(std::current_exception());
        }
    };
    {
        std::vector<std::jthread> threads;
        for (std::size_t stage = 1; stage < stages.size(); ++stage)
            threads.emplace_back(work, stage);
        work(0);
    }
    belt.rethrow_failure();
}

} // namespace duskline
