#include "tools/evaluate/report/gnuplot.h"

#include "core/process/configuration.h"
#include "tools/evaluate/report/clean_text.h"
#include "tools/evaluate/report/figure.h"
#include "tools/goalmouth/output.h"
#include "tools/goalmouth/temporary_folder.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <spawn.h>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

extern char** environ;

namespace goalmouth {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr const char* script_name = "figure.gp";
constexpr const char* log_name = "gnuplot.log";
constexpr const char* missing =
    "the figures are drawn by gnuplot, which is not installed: sudo apt-get install gnuplot-nox";

/// What posix_spawn is told; freed with the object.
class SpawnSettings {
  public:
    SpawnSettings() {
        posix_spawn_file_actions_init(&actions);
        posix_spawnattr_init(&attributes);
    }
    ~SpawnSettings() {
        posix_spawn_file_actions_destroy(&actions);
        posix_spawnattr_destroy(&attributes);
    }
    SpawnSettings(const SpawnSettings&) = delete;
    SpawnSettings& operator=(const SpawnSettings&) = delete;

    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
};

/// In a process group of its own: Ctrl-C ends the evaluation in good order, not the figure it is drawing.
pid_t start(const fs::path& folder) {
    SpawnSettings settings;
    posix_spawn_file_actions_addchdir_np(&settings.actions, folder.c_str());
    posix_spawn_file_actions_addopen(&settings.actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&settings.actions, STDOUT_FILENO, log_name, O_WRONLY | O_CREAT | O_TRUNC,
                                     0644);
    posix_spawn_file_actions_adddup2(&settings.actions, STDOUT_FILENO, STDERR_FILENO);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&settings.attributes, &none);
    posix_spawnattr_setpgroup(&settings.attributes, 0);
    posix_spawnattr_setflags(&settings.attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);

    std::string program = "gnuplot";
    std::string defaults = "-d";
    std::string script = script_name;
    std::array<char*, 4> arguments{program.data(), defaults.data(), script.data(), nullptr};
    pid_t pid = 0;
    const int problem = posix_spawnp(&pid, program.c_str(), &settings.actions, &settings.attributes,
                                     arguments.data(), environ);
    if (problem == ENOENT || problem == EACCES) throw ConfigurationError(missing);
    if (problem != 0)
        throw ConfigurationError(fmt::format("gnuplot cannot be started: {}", std::strerror(problem)));
    return pid;
}

/// Its wait status, or nothing after `longest`: then it is ended.
std::optional<int> wait_for(pid_t pid, std::chrono::milliseconds longest) {
    const auto end = Clock::now() + longest;
    for (;;) {
        int status = 0;
        const pid_t ended = waitpid(pid, &status, WNOHANG);
        if (ended == pid) return status;
        if (ended < 0 && errno != EINTR) return 0;  // reaped by somebody else: its files tell
        if (Clock::now() >= end) {
            ::kill(pid, SIGKILL);
            waitpid(pid, &status, 0);
            return std::nullopt;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(3));
    }
}

/// The end of what it said, on one line.
std::string last_words(const fs::path& log) {
    constexpr std::size_t longest = 400;
    std::ifstream in(log, std::ios::binary);
    std::string said = clean_text({std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()});
    std::string line;
    for (const char c : said) {
        const char printed = c == '\n' || c == '\t' ? ' ' : c;
        if (printed != ' ' || (!line.empty() && line.back() != ' ')) line += printed;
    }
    while (!line.empty() && line.back() == ' ') line.pop_back();
    if (line.size() > longest) line = clean_text("… " + line.substr(line.size() - longest));
    return line.empty() ? "it said nothing" : line;
}

}  // namespace

void run_gnuplot(const std::string& script, const fs::path& folder, std::chrono::milliseconds longest) {
    write_text(folder / script_name, script, "");
    const std::optional<int> status = wait_for(start(folder), longest);
    if (!status)
        throw ConfigurationError(fmt::format("gnuplot did not end within {:.1f} s",
                                             static_cast<double>(longest.count()) / 1000.0));
    if (WIFEXITED(*status) && WEXITSTATUS(*status) == 127) throw ConfigurationError(missing);
    if (WIFSIGNALED(*status))
        throw ConfigurationError(fmt::format("gnuplot was ended by signal {}: {}", WTERMSIG(*status),
                                             last_words(folder / log_name)));
    if (WEXITSTATUS(*status) != 0)
        throw ConfigurationError("gnuplot failed: " + last_words(folder / log_name));
}

void expect_gnuplot(const std::string& option) {
    const TemporaryFolder folder(fs::temp_directory_path(), "goalmouth-", option);
    try {
        run_gnuplot("set terminal svg noenhanced\nset terminal pngcairo noenhanced fontscale 2\n",
                    folder.path());
    } catch (const ConfigurationError& error) {
        throw ConfigurationError((option.empty() ? "" : option + ": ") + error.what());
    }
}

}  // namespace goalmouth
