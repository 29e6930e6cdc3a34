#pragma once

#include <cstddef>
#include <functional>

namespace goalmouth {

/// Calls work(worker, item) for every item in 0 … count−1 on up to `jobs` threads, worker being the thread's
/// number from 0; items begin in order. No further item begins once `stop` (where given) says so or one has
/// thrown; of several errors that of the lowest item leaves.
void for_each_in_parallel(std::size_t count, int jobs,
                          const std::function<void(std::size_t worker, std::size_t item)>& work,
                          const std::function<bool()>& stop = {});

}  // namespace goalmouth
