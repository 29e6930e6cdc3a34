#include "core/process/guardian.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <dirent.h>
#include <fcntl.h>
#include <fstream>
#include <poll.h>
#include <stdexcept>
#include <string>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

namespace goalmouth {
namespace {

using Clock = std::chrono::steady_clock;

constexpr char watch_group = '+';
constexpr char forget_group = '-';
constexpr char all_is_well = '.';

struct Word {
    char what;
    pid_t group;
};

/// Reads what the launcher says until it falls silent. True if it took its leave.
bool listen(int line, std::set<pid_t>& groups) {
    for (;;) {
        Word word{};
        const ssize_t count = ::recv(line, &word, sizeof word, 0);
        if (count < 0 && errno == EINTR) continue;
        if (count != sizeof word) return false;
        if (word.what == all_is_well) return true;
        if (word.what == watch_group) groups.insert(word.group);
        if (word.what == forget_group) groups.erase(word.group);
    }
}

bool any_lives(const std::set<pid_t>& groups) {
    const auto living = living_groups();
    for (const pid_t group : groups) {
        if (living.contains(group)) return true;
    }
    return false;
}

void end_groups(const std::set<pid_t>& groups, double grace) {
    for (const pid_t group : groups) ::kill(-group, SIGTERM);
    const auto deadline = Clock::now() + std::chrono::duration<double>(grace);
    while (any_lives(groups) && Clock::now() < deadline) ::poll(nullptr, 0, 20);
    const auto living = living_groups();
    for (const pid_t group : groups) {
        if (living.contains(group)) ::kill(-group, SIGKILL);
    }
    // A killed process lets go of its shared memory only once it is gone.
    for (int tries = 0; tries < 100 && any_lives(groups); ++tries) ::poll(nullptr, 0, 10);
}

/// Keeps only the line: an inherited pipe would stay open as long as this process lives.
void leave_everything(int line) {
    ::setsid();  // out of reach of the terminal's Ctrl-C and hang-up
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE}) std::signal(signal, SIG_IGN);
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    ::prctl(PR_SET_NAME, "guardian");
    const int nothing = ::open("/dev/null", O_RDWR);
    for (const int standard : {0, 1, 2}) ::dup2(nothing, standard);
    const int kept = 3;
    if (line != kept) ::dup2(line, kept);
    ::close_range(kept + 1, ~0U, 0);
}

}  // namespace

std::set<pid_t> living_groups() {
    std::set<pid_t> groups;
    DIR* const processes = ::opendir("/proc");
    if (!processes) return groups;
    while (const dirent* entry = ::readdir(processes)) {
        if (entry->d_name[0] < '0' || entry->d_name[0] > '9') continue;
        std::ifstream file("/proc/" + std::string(entry->d_name) + "/stat");
        std::string text;
        std::getline(file, text, '\0');
        // PID (NAME) STATE PARENT GROUP …; NAME may hold anything, brackets too.
        const auto bracket = text.rfind(')');
        char state = 'Z';
        pid_t parent = 0;
        pid_t group = 0;
        if (bracket == std::string::npos ||
            std::sscanf(text.c_str() + bracket + 1, " %c %d %d", &state, &parent, &group) != 3) {
            continue;
        }
        if (state != 'Z' && state != 'X') groups.insert(group);
    }
    ::closedir(processes);
    return groups;
}

Guardian::Guardian(double grace, std::function<void()> errand) : grace_(grace), errand_(std::move(errand)) {
    fork_it();
}

Guardian::~Guardian() {
    end();
}

void Guardian::fork_it() {
    std::array<int, 2> ends{-1, -1};
    if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) {
        throw std::runtime_error(std::string("cannot start the guardian: ") + std::strerror(errno));
    }
    const pid_t pid = ::fork();
    if (pid < 0) {
        const int error = errno;
        ::close(ends[0]);
        ::close(ends[1]);
        throw std::runtime_error(std::string("cannot start the guardian: ") + std::strerror(error));
    }
    if (pid == 0) {
        leave_everything(ends[1]);
        std::set<pid_t> groups;
        if (!listen(3, groups)) {
            end_groups(groups, grace_);
            ::alarm(5);  // the errand runs in a copy of a program that may have been anywhere
            if (errand_) errand_();
        }
        ::_exit(0);
    }
    ::close(ends[1]);
    line_ = ends[0];
    pid_ = pid;
    for (const pid_t group : groups_) tell(watch_group, group);
}

void Guardian::tell(char what, pid_t group) const {
    const Word word{what, group};
    while (::send(line_, &word, sizeof word, MSG_NOSIGNAL) < 0 && errno == EINTR) {
    }
}

void Guardian::watch(pid_t group) {
    groups_.insert(group);
    tell(watch_group, group);
}

void Guardian::forget(pid_t group) {
    groups_.erase(group);
    tell(forget_group, group);
}

bool Guardian::keep_alive() {
    int status = 0;
    if (pid_ > 0 && ::waitpid(pid_, &status, WNOHANG) == 0) return false;
    ::close(line_);
    line_ = -1;
    pid_ = 0;
    fork_it();
    return true;
}

void Guardian::end() {
    if (line_ >= 0) {
        tell(all_is_well, 0);
        ::close(line_);
        line_ = -1;
    }
    if (pid_ > 0) {
        int status = 0;
        while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
        }
        pid_ = 0;
    }
}

}  // namespace goalmouth
