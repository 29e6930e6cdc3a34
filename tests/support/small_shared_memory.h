#pragma once

#include <functional>
#include <string>
#include <sys/types.h>

namespace goalmouth::test {

/// Runs `body` in a child process that has a /dev/shm of its own, of `megabytes`. Expectations that fail
/// there fail the calling test. Returns "" or why this system does not permit it (then skip the test).
std::string with_small_shared_memory(int megabytes, const std::function<void()>& body);

/// In such a process: another size for it.
void resize_shared_memory(int megabytes);

}  // namespace goalmouth::test
