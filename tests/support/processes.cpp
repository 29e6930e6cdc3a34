#include "tests/support/processes.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace goalmouth::test {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

fs::path program(const std::string& name) {
    return fs::path(GOALMOUTH_BINARY_DIR) / "bin" / name;
}

fs::path shipped_graph(const std::string& name) {
    return fs::path(GOALMOUTH_SOURCE_DIR) / "config" / "graphs" / (name + ".yaml");
}

bool have_programs(const std::vector<std::string>& names) {
    return std::all_of(names.begin(), names.end(),
                       [](const auto& name) { return fs::exists(program(name)); });
}

bool eventually(const std::function<bool()>& holds, std::chrono::seconds limit) {
    const auto deadline = Clock::now() + limit;
    while (!holds()) {
        if (Clock::now() >= deadline) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return true;
}

bool process_lives(pid_t pid) {
    std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
    std::string text;
    std::getline(file, text, '\0');
    const auto bracket = text.rfind(')');
    return bracket != std::string::npos && bracket + 2 < text.size() && text[bracket + 2] != 'Z' &&
           text[bracket + 2] != 'X';
}

std::vector<pid_t> marked_processes(const std::string& mark) {
    std::vector<pid_t> found;
    const std::string wanted = "GOALMOUTH_TEST=" + mark;
    for (const auto& entry : fs::directory_iterator("/proc")) {
        const std::string name = entry.path().filename();
        if (name.find_first_not_of("0123456789") != std::string::npos) continue;
        std::ifstream file(entry.path() / "environ");
        for (std::string variable; std::getline(file, variable, '\0');) {
            const pid_t pid = std::stoi(name);
            if (variable == wanted && process_lives(pid)) found.push_back(pid);
        }
    }
    return found;
}

std::vector<std::string> rings_of(const std::set<pid_t>& producers) {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator("/dev/shm")) {
        const std::string name = entry.path().filename();
        int user = 0;
        int producer = 0;
        if (std::sscanf(name.c_str(), "goalmouth-%d-%d-", &user, &producer) != 2) continue;
        if (producers.contains(producer)) found.push_back(name);
    }
    return found;
}

std::string new_mark() {
    static int count = 0;
    return std::to_string(::getpid()) + "-" + std::to_string(++count);
}

Running::Running(const std::vector<std::string>& command, const std::string& mark) {
    std::vector<char*> argv;
    for (const auto& word : command) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    pid_ = ::fork();
    if (pid_ == 0) {
        ::setpgid(0, 0);
        ::setenv("GOALMOUTH_TEST", mark.c_str(), 1);
        ::dup2(ends[1], 1);
        ::dup2(ends[1], 2);
        ::execvp(argv[0], argv.data());
        ::_exit(127);
    }
    ::setpgid(pid_, pid_);
    ::close(ends[1]);
    pipe_ = ends[0];
    ::fcntl(pipe_, F_SETFL, O_NONBLOCK);
}

Running::~Running() {
    if (!reaped_) {
        ::kill(-pid_, SIGKILL);
        ::waitpid(pid_, nullptr, 0);
    }
    ::close(pipe_);
}

void Running::signal(int number) const {
    ::kill(pid_, number);
}

const std::string& Running::output() {
    std::array<char, 4096> buffer{};
    for (ssize_t count = 0; (count = ::read(pipe_, buffer.data(), buffer.size())) > 0;) {
        output_.append(buffer.data(), static_cast<std::size_t>(count));
    }
    return output_;
}

int Running::wait(std::chrono::seconds limit) {
    int status = 0;
    const bool ended = eventually(
        [&] {
            output();
            return ::waitpid(pid_, &status, WNOHANG) == pid_;
        },
        limit);
    if (!ended) return -1;
    reaped_ = true;
    output();
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace goalmouth::test
