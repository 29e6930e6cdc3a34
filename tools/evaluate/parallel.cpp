#include "tools/evaluate/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace goalmouth {

void for_each_in_parallel(std::size_t count, int jobs,
                          const std::function<void(std::size_t, std::size_t)>& work,
                          const std::function<bool()>& stop) {
    std::atomic<std::size_t> next{0};
    std::atomic<bool> failed{false};
    std::mutex mutex;
    std::exception_ptr error;
    std::size_t error_item = count;
    const auto worker = [&](std::size_t number) {
        while (!failed && !(stop && stop())) {
            const std::size_t item = next++;
            if (item >= count) return;
            try {
                work(number, item);
            } catch (...) {
                const std::lock_guard lock(mutex);
                failed = true;
                if (item < error_item) {
                    error_item = item;
                    error = std::current_exception();
                }
            }
        }
    };
    {
        std::vector<std::jthread> threads;
        const std::size_t wanted =
            std::min(count, static_cast<std::size_t>(std::max(1, jobs)));  // this thread is one of them
        for (std::size_t i = 1; i < wanted; ++i) threads.emplace_back(worker, i);
        worker(0);
    }
    if (error) std::rethrow_exception(error);
}

}  // namespace goalmouth
