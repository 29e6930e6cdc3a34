#include "tests/support/small_shared_memory.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

namespace goalmouth::test {
namespace {

constexpr int not_permitted = 77;

bool write_file(const char* path, const std::string& text) {
    const int fd = open(path, O_WRONLY | O_CLOEXEC);
    const bool written = fd >= 0 && write(fd, text.data(), text.size()) == static_cast<ssize_t>(text.size());
    close(fd);
    return written;
}

std::string options(int megabytes) {
    return "size=" + std::to_string(megabytes) + "m";
}

/// Mounts of this process's own, as root or, where the kernel lets users, in a user namespace.
bool enter_mount_namespace() {
    if (unshare(CLONE_NEWNS) == 0) return true;
    const std::string user = std::to_string(geteuid());
    const std::string group = std::to_string(getegid());
    return unshare(CLONE_NEWUSER | CLONE_NEWNS) == 0 && write_file("/proc/self/setgroups", "deny") &&
           write_file("/proc/self/uid_map", user + " " + user + " 1") &&
           write_file("/proc/self/gid_map", group + " " + group + " 1");
}

bool mount_small(int megabytes) {
    return enter_mount_namespace() && mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
           mount("tmpfs", "/dev/shm", "tmpfs", 0, options(megabytes).c_str()) == 0;
}

int run(const std::function<void()>& body) {
    try {
        body();
    } catch (const std::exception& error) {
        ADD_FAILURE() << "threw: " << error.what();
    }
    return testing::Test::HasFailure() ? 1 : 0;
}

}  // namespace

std::string with_small_shared_memory(int megabytes, const std::function<void()>& body) {
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child == 0) {
        const int code = mount_small(megabytes) ? run(body) : not_permitted;
        std::fflush(nullptr);
        _exit(code);
    }
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) != child) return "no child process";
    if (WIFEXITED(status) && WEXITSTATUS(status) == not_permitted)
        return "a mount namespace is not permitted (neither as this user nor in a user namespace)";
    EXPECT_TRUE(WIFEXITED(status)) << "ended by signal " << WTERMSIG(status);
    EXPECT_EQ(WEXITSTATUS(status), 0) << "the expectations above";
    return "";
}

void resize_shared_memory(int megabytes) {
    ASSERT_EQ(mount(nullptr, "/dev/shm", nullptr, MS_REMOUNT, options(megabytes).c_str()), 0)
        << std::strerror(errno);
}

}  // namespace goalmouth::test
