// A race on purpose: pieces add to one number. Built with the thread sanitizer only, where the test fails unless
// it is reported: tools/tsan.supp must not hide the mistakes of our own work.

#include <duskline/execution/for_rows.h>

#include <iostream>
#include <thread>

int main()
{
    std::size_t rows = 0;
    duskline::for_rows(1000, 1, {.threads = 4}, [&](std::size_t first, std::size_t last) {
        std::this_thread::yield();
        rows += last - first;
    });
    std::cout << rows << " rows counted\n";
}
