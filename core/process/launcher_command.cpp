#include "core/process/launcher_command.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace goalmouth {
namespace {

using Clock = std::chrono::steady_clock;

/// A pipe whose ends close by themselves and are not inherited unless spawned onto 0, 1 or 2.
struct Pipe {
    int read_end = -1;
    int write_end = -1;
    Pipe() {
        std::array<int, 2> ends{-1, -1};
        if (::pipe2(ends.data(), O_CLOEXEC) == 0) {
            read_end = ends[0];
            write_end = ends[1];
        }
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    ~Pipe() {
        close_end(read_end);
        close_end(write_end);
    }
    static void close_end(int& end) {
        if (end >= 0) ::close(end);
        end = -1;
    }
};

/// Blocks SIGPIPE in this thread, and swallows the one that a write to a closed pipe leaves behind.
class NoSigpipe {
  public:
    NoSigpipe() {
        sigemptyset(&pipe_);
        sigaddset(&pipe_, SIGPIPE);
        pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
    }
    NoSigpipe(const NoSigpipe&) = delete;
    NoSigpipe& operator=(const NoSigpipe&) = delete;
    ~NoSigpipe() {
        const timespec now{};
        while (sigtimedwait(&pipe_, nullptr, &now) > 0) {
        }
        pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }

  private:
    sigset_t pipe_{};
    sigset_t before_{};
};

int spawn(const std::vector<std::string>& command, const Pipe& in, const Pipe& out, const Pipe& err,
          pid_t& pid) {
    std::vector<char*> argv;
    for (const auto& word : command) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, in.read_end, 0);
    posix_spawn_file_actions_adddup2(&actions, out.write_end, 1);
    posix_spawn_file_actions_adddup2(&actions, err.write_end, 2);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t none;
    sigset_t pipe;
    sigemptyset(&none);
    sigemptyset(&pipe);
    sigaddset(&pipe, SIGPIPE);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &pipe);
    posix_spawnattr_setflags(&attributes,
                             POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    const int error = posix_spawnp(&pid, argv[0], &actions, &attributes, argv.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return error;
}

/// Reads what waits; closes the end once there is no more.
void read_some(int& end, std::string& text) {
    std::array<char, 4096> buffer{};
    const ssize_t count = ::read(end, buffer.data(), buffer.size());
    if (count > 0) {
        text.append(buffer.data(), static_cast<std::size_t>(count));
    } else if (count == 0 || (errno != EINTR && errno != EAGAIN)) {
        Pipe::close_end(end);
    }
}

}  // namespace

CommandResult run_command(const std::vector<std::string>& command, std::chrono::milliseconds limit,
                          const std::string& input) {
    CommandResult result;
    Pipe in;
    Pipe out;
    Pipe err;
    pid_t pid = 0;
    const NoSigpipe no_sigpipe;
    if (const int error = spawn(command, in, out, err, pid)) {
        result.error = command.at(0) + ": " + std::strerror(error);
        return result;
    }
    result.started = true;
    Pipe::close_end(in.read_end);
    Pipe::close_end(out.write_end);
    Pipe::close_end(err.write_end);
    ::fcntl(in.write_end, F_SETFL, O_NONBLOCK);

    const auto deadline = Clock::now() + limit;
    std::size_t sent = 0;
    while (out.read_end >= 0 || err.read_end >= 0) {
        if (sent == input.size()) Pipe::close_end(in.write_end);
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
        if (left.count() <= 0) {
            result.timed_out = true;
            break;
        }
        std::array<pollfd, 3> waits{
            {{out.read_end, POLLIN, 0}, {err.read_end, POLLIN, 0}, {in.write_end, POLLOUT, 0}}};
        if (::poll(waits.data(), waits.size(), static_cast<int>(left.count())) < 0) continue;
        if (waits[0].revents) read_some(out.read_end, result.output);
        if (waits[1].revents) read_some(err.read_end, result.error);
        if (waits[2].revents) {
            const ssize_t count = ::write(in.write_end, input.data() + sent, input.size() - sent);
            if (count > 0) sent += static_cast<std::size_t>(count);
            if (count < 0 && errno != EAGAIN && errno != EINTR) sent = input.size();
        }
    }
    // It may have closed its output and live on.
    while (::waitpid(pid, &result.status, WNOHANG) == 0) {
        if (result.timed_out || Clock::now() >= deadline) {
            result.timed_out = true;
            ::kill(-pid, SIGKILL);
            ::waitpid(pid, &result.status, 0);
            break;
        }
        ::poll(nullptr, 0, 2);
    }
    return result;
}

std::string end_text(int status) {
    if (WIFSIGNALED(status)) {
        const int number = WTERMSIG(status);
        const char* name = sigabbrev_np(number);
        return "killed by " + (name ? "SIG" + std::string(name) : std::string("signal")) + " (" +
               std::to_string(number) + ")" + (WCOREDUMP(status) ? ", core dumped" : "");
    }
    return "exit code " + std::to_string(WEXITSTATUS(status));
}

}  // namespace goalmouth
