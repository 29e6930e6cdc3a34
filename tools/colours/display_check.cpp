#include "tools/colours/display_check.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <opencv2/highgui/highgui_c.h>

namespace goalmouth {

namespace {

/// Connects to the display, quietly, says so, and stays until the other end of the socket is closed.
[[noreturn]] void try_display(int socket) {
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
    if (const int null = ::open("/dev/null", O_WRONLY | O_CLOEXEC); null >= 0) {
        ::dup2(null, STDOUT_FILENO);
        ::dup2(null, STDERR_FILENO);
    }
    try {
        cvInitSystem(0, nullptr);
        char byte = 1;
        if (::send(socket, &byte, 1, MSG_NOSIGNAL) == 1) {
            while (::recv(socket, &byte, 1, 0) < 0 && errno == EINTR) {
            }
        }
    } catch (...) {
        ::_exit(1);
    }
    ::_exit(0);
}

/// A display that does not answer is as good as none.
bool answers(int socket) {
    constexpr int patience = 20'000;  // ms
    pollfd poll_socket{socket, POLLIN, 0};
    int ready = 0;
    do {
        ready = ::poll(&poll_socket, 1, patience);
    } while (ready < 0 && errno == EINTR);
    char byte = 0;
    return ready == 1 && ::recv(socket, &byte, 1, 0) == 1;
}

std::string display() {
    for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY"}) {
        const char* value = std::getenv(name);
        if (value != nullptr && *value != '\0') return std::string(name) + "=" + value;
    }
    return {};
}

}  // namespace

DisplayCheck::DisplayCheck() {
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
        problem_ = "no socket can be made";
        return;
    }
    child_ = ::fork();
    if (child_ == 0) {
        ::close(ends[0]);
        try_display(ends[1]);
    }
    ::close(ends[1]);
    socket_ = ends[0];
    if (child_ > 0 && answers(socket_)) return;
    const std::string where = display();
    problem_ = child_ < 0      ? "no process can be started"
               : where.empty() ? "DISPLAY is not set"
                               : where + " does not let us in";
    if (child_ > 0) ::kill(child_, SIGKILL);
}

DisplayCheck::~DisplayCheck() {
    if (socket_ >= 0) ::close(socket_);
    if (child_ > 0) {
        while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
        }
    }
}

}  // namespace goalmouth
