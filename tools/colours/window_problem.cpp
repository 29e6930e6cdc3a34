#include "tools/colours/teach_window.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include <opencv2/highgui/highgui_c.h>

namespace goalmouth {

namespace {

using Clock = std::chrono::steady_clock;

/// Connects to the display, quietly, and ends.
[[noreturn]] void try_display() {
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
    if (const int null = ::open("/dev/null", O_WRONLY | O_CLOEXEC); null >= 0) {
        ::dup2(null, STDOUT_FILENO);
        ::dup2(null, STDERR_FILENO);
    }
    for (const int number : {SIGABRT, SIGINT, SIGTERM}) std::signal(number, SIG_DFL);
    try {
        cvInitSystem(0, nullptr);
    } catch (...) {
        ::_exit(1);
    }
    ::_exit(0);
}

/// Whether the child ended well; a display that does not answer is as good as none.
bool ends_well(pid_t child) {
    constexpr auto limit = std::chrono::seconds(20);
    const auto deadline = Clock::now() + limit;
    int status = 0;
    for (;;) {
        const pid_t ended = ::waitpid(child, &status, WNOHANG);
        if (ended == child) return WIFEXITED(status) && WEXITSTATUS(status) == 0;
        if (ended < 0 && errno != EINTR) return false;
        if (Clock::now() >= deadline) break;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ::kill(child, SIGKILL);
    ::waitpid(child, &status, 0);
    return false;
}

std::string display() {
    for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY"}) {
        const char* value = std::getenv(name);
        if (value != nullptr && *value != '\0') return std::string(name) + "=" + value;
    }
    return {};
}

}  // namespace

std::string window_problem() {
    const pid_t child = ::fork();
    if (child < 0) return "no process can be started";
    if (child == 0) try_display();
    if (ends_well(child)) return {};
    const std::string where = display();
    return where.empty() ? "DISPLAY is not set" : where + " does not let us in";
}

}  // namespace goalmouth
