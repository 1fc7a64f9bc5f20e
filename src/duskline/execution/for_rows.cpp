#include <duskline/execution/for_rows.h>

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <mutex>
#include <optional>

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define DUSKLINE_THREAD_SANITIZER
#endif
#elif defined(__SANITIZE_THREAD__)
#define DUSKLINE_THREAD_SANITIZER
#endif
#ifdef DUSKLINE_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace duskline {

namespace {

// oneTBB comes without the thread sanitizer's instrumentation, which would take what the caller wrote before
// the tasks, or reads after them, for races. This tells it the order: all tasks begin after the fork and end
// before the join; among themselves they have none. The tags are addresses and hold nothing; in other builds
// there is nothing here at all.
#ifdef DUSKLINE_THREAD_SANITIZER
char fork_tag;
char join_tag;
void fork_tasks()
{
    __tsan_release(&fork_tag);
}
void join_tasks()
{
    __tsan_acquire(&join_tag);
}
struct TaskOrder {
    TaskOrder() { __tsan_acquire(&fork_tag); }
    ~TaskOrder() { __tsan_release(&join_tag); }
};
#else
void fork_tasks() {}
void join_tasks() {}
struct TaskOrder {};
#endif

// Counts finished pieces and passes their share on, one call at a time.
class PieceCounter {
public:
    PieceCounter(std::size_t count, const ProgressCallback& report) : count_(count), report_(report) {}

    void finished(std::size_t pieces)
    {
        if (!report_)
            return;
        const std::scoped_lock lock(mutex_);
        done_ += pieces;
        if (cancelled_ || !report_(static_cast<double>(done_) / static_cast<double>(count_))) {
            cancelled_ = true;
            throw Cancelled();
        }
    }

private:
    const std::size_t count_;
    const ProgressCallback& report_;
    std::mutex mutex_;
    std::size_t done_ = 0;
    bool cancelled_ = false;
};

} // namespace

std::size_t thread_count(const Execution& execution)
{
    const auto available = static_cast<std::size_t>(std::max(1, tbb::info::default_concurrency()));
    return execution.threads == 0 ? available : execution.threads;
}

void for_rows(std::size_t count, std::size_t piece, const Execution& execution,
              const std::function<void(std::size_t first, std::size_t last)>& work)
{
    if (count == 0)
        return;
    piece = std::max<std::size_t>(piece, 1);
    PieceCounter counter(count, execution.progress);
    const auto do_piece = [&](std::size_t first) {
        const std::size_t last = std::min(first + piece, count);
        work(first, last);
        counter.finished(last - first);
    };

    const std::size_t pieces = (count + piece - 1) / piece;
    const std::size_t threads = std::min(thread_count(execution), pieces);
    if (threads == 1) {
        for (std::size_t i = 0; i < pieces; ++i)
            do_piece(i * piece);
        return;
    }
    // Made before the fork and called by reference, so that its own fields are part of the order too.
    const auto do_task = [&](std::size_t i) {
        [[maybe_unused]] const TaskOrder order;
        do_piece(i * piece);
    };
    fork_tasks();
    // Unasked, oneTBB gives no more threads than processors, and says so on stderr.
    std::optional<tbb::global_control> more_than_processors;
    if (threads > static_cast<std::size_t>(tbb::info::default_concurrency()))
        more_than_processors.emplace(tbb::global_control::max_allowed_parallelism, threads);
    tbb::task_arena arena(static_cast<int>(threads));
    arena.execute([&] { tbb::parallel_for(std::size_t{0}, pieces, do_task, tbb::simple_partitioner()); });
    join_tasks();
}

} // namespace duskline
