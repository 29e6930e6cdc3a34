#pragma once

#include <chrono>
#include <sys/types.h>
#include <thread>

namespace goalmouth::bench {

using Clock = std::chrono::steady_clock;

/// Sleeps until then, to the fraction of a millisecond.
void sleep_until(Clock::time_point when);

/// CPU time of a thread of this process, of the calling thread, and of another process; [s], 0 where it is
/// gone.
double thread_cpu_seconds(std::thread& thread);
double own_cpu_seconds();
double process_cpu_seconds(pid_t pid);

/// Memory of a process [MiB], of what it shares with others its share; 0 where it is gone.
double process_memory(pid_t pid);

}  // namespace goalmouth::bench
