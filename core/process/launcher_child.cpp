#include "core/process/launcher_child.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <string_view>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

extern char** environ;

namespace goalmouth {
namespace {

constexpr std::size_t longest_line = 8192;

/// Between fork and exec: only calls that are safe there.
[[noreturn]] void become(char* const* argv, char* const* environment, int output, int gate, pid_t launcher) {
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    struct sigaction usual {};
    usual.sa_handler = SIG_DFL;
    for (int signal = 1; signal < NSIG; ++signal) ::sigaction(signal, &usual, nullptr);
    sigset_t none;
    sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
    ::dup2(nothing, 0);
    ::dup2(output, 1);
    ::dup2(output, 2);
    char go = 0;
    if (::getppid() != launcher || ::read(gate, &go, 1) != 1) ::_exit(1);
    ::execve(argv[0], argv, environment);
    const int error = errno;
    const ssize_t ignored = ::write(gate, &error, sizeof error);
    ::_exit(ignored < 0 ? 126 : 127);
}

/// Our environment with `changes` over it.
std::vector<std::string> environment_with(const std::vector<std::string>& changes) {
    std::vector<std::string> result = changes;
    for (char** entry = environ; *entry; ++entry) {
        const std::string_view text = *entry;
        const std::string name(text.substr(0, text.find('=') + 1));
        const bool changed = std::any_of(changes.begin(), changes.end(),
                                         [&](const auto& change) { return change.starts_with(name); });
        if (!changed) result.emplace_back(text);
    }
    return result;
}

std::vector<char*> pointers(const std::vector<std::string>& texts) {
    std::vector<char*> result;
    for (const auto& text : texts) result.push_back(const_cast<char*>(text.c_str()));
    result.push_back(nullptr);
    return result;
}

}  // namespace

Child::Child(Child&& other) noexcept {
    *this = std::move(other);
}

Child& Child::operator=(Child&& other) noexcept {
    std::swap(pid_, other.pid_);
    std::swap(pid_descriptor_, other.pid_descriptor_);
    std::swap(output_, other.output_);
    std::swap(partial_, other.partial_);
    return *this;
}

Child::~Child() {
    close_all();
}

void Child::close_all() {
    if (pid_descriptor_ >= 0) ::close(pid_descriptor_);
    if (output_ >= 0) ::close(output_);
    pid_descriptor_ = output_ = -1;
}

int Child::start(const std::vector<std::string>& command, const std::vector<std::string>& environment,
                 const std::function<void(pid_t)>& registered) {
    close_all();
    partial_.clear();
    pid_ = 0;
    const auto words = environment_with(environment);
    const auto argv = pointers(command);
    const auto envp = pointers(words);
    std::array<int, 2> output{-1, -1};
    std::array<int, 2> gate{-1, -1};  // go ahead, one way; why it could not be run, the other way
    if (::pipe2(output.data(), O_CLOEXEC) != 0) return errno;
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, gate.data()) != 0) {
        const int error = errno;
        ::close(output[0]);
        ::close(output[1]);
        return error;
    }
    const pid_t launcher = ::getpid();
    const pid_t pid = ::fork();
    if (pid == 0) {
        ::close(gate[0]);  // or its end of file would never come
        become(argv.data(), envp.data(), output[1], gate[1], launcher);
    }
    int error = pid < 0 ? errno : 0;
    ::close(output[1]);
    ::close(gate[1]);
    output_ = output[0];
    if (pid > 0) {
        ::setpgid(pid, pid);
        registered(pid);
        const ssize_t sent = ::send(gate[0], "g", 1, MSG_NOSIGNAL);
        ssize_t count = 0;
        while (sent == 1 && (count = ::recv(gate[0], &error, sizeof error, 0)) < 0 && errno == EINTR) {
        }
        if (count != sizeof error) error = 0;
        pid_ = pid;
        pid_descriptor_ = static_cast<int>(::syscall(SYS_pidfd_open, pid, 0));
        ::fcntl(output_, F_SETFL, O_NONBLOCK);
    }
    ::close(gate[0]);
    if (error != 0 && pid > 0) reap();
    if (error != 0) close_all();
    return error;
}

std::vector<std::string> Child::read_lines() {
    std::array<char, 16384> buffer{};
    std::vector<std::string> lines;
    // A bound: one that writes without end must not keep us here.
    for (int reads = 0; reads < 16 && output_ >= 0; ++reads) {
        const ssize_t count = ::read(output_, buffer.data(), buffer.size());
        if (count < 0 && errno == EINTR) continue;
        if (count == 0) {
            ::close(output_);
            output_ = -1;
        }
        if (count <= 0) break;
        partial_.append(buffer.data(), static_cast<std::size_t>(count));
        std::size_t start = 0;
        for (;;) {
            const auto end = partial_.find('\n', start);
            if (end == std::string::npos && partial_.size() - start < longest_line) break;
            const std::size_t length =
                std::min(end == std::string::npos ? longest_line : end - start, longest_line);
            lines.push_back(partial_.substr(start, length));
            start += length + (start + length == end ? 1 : 0);
        }
        partial_.erase(0, start);
    }
    return lines;
}

std::vector<std::string> Child::rest() {
    std::vector<std::string> lines = read_lines();
    if (!partial_.empty()) lines.push_back(std::move(partial_));
    partial_.clear();
    return lines;
}

bool Child::ended() const {
    siginfo_t info{};
    return pid_ > 0 && ::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           info.si_pid == pid_;
}

int Child::reap() {
    int status = 0;
    while (pid_ > 0 && ::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    pid_ = 0;
    close_all();
    return status;
}

}  // namespace goalmouth
