#include "tests/bench/graph_bench.h"

#include "core/messaging/message_size.h"
#include "core/process/configuration.h"
#include "core/process/graph.h"
#include "core/process/launcher.h"
#include "tests/bench/graph/one_process_way.h"
#include "tests/bench/graph/process_way.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <optional>
#include <stdexcept>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

namespace goalmouth::bench {
namespace {

constexpr double most_seconds_to_compare = 60.0;
constexpr int enough_buffer = 32 << 20;  // bytes: eight frames of two megapixels

/// Seconds of all ways together.
class ProgressSum {
  public:
    ProgressSum(const GraphBenchOptions& options, const GraphBenchProgress& progress, double wanted)
        : options_(options), progress_(progress), wanted_(wanted) {}

    /// For the way that begins now.
    KeepGoing way(const std::string& what, double seconds) {
        done_ = std::exchange(next_, next_ + seconds);
        return [this, what, seconds](double passed) {
            if (progress_) progress_(what, done_ + std::min(passed, seconds), wanted_);
            return !options_.stop || !options_.stop();
        };
    }

  private:
    const GraphBenchOptions& options_;
    const GraphBenchProgress& progress_;
    double wanted_;
    double done_ = 0.0;
    double next_ = 0.0;
};

/// What the kernel grants a socket that asks for so many bytes, in its own reckoning.
int granted_receive_buffer(int asked) {
    const int fd = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (fd < 0) throw std::runtime_error(std::string("no UDP socket to be had: ") + std::strerror(errno));
    int granted = 0;
    socklen_t length = sizeof granted;
    ::setsockopt(fd, SOL_SOCKET, SO_RCVBUF, &asked, sizeof asked);
    ::getsockopt(fd, SOL_SOCKET, SO_RCVBUF, &granted, &length);
    ::close(fd);
    return granted;
}

/// "" or why not.
std::string enter_network() {
    try {
        provide_network(default_lcm_url, NetworkChoice::separate);
        return {};
    } catch (const ConfigurationError& error) {
        const std::string text = error.what();  // begins with an option that the benchmark does not have
        const std::string option = "--network: ";
        return "the process graph needs " + (text.starts_with(option) ? text.substr(option.size()) : text) +
               "; --only stages does without";
    }
}

/// The same, tried by a child, since there is no way back.
std::string try_network() {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error(std::string("pipe: ") + std::strerror(errno));
    const pid_t child = ::fork();
    if (child < 0) throw std::runtime_error(std::string("fork: ") + std::strerror(errno));
    if (child == 0) {
        const std::string problem = enter_network();
        const bool said =
            ::write(ends[1], problem.data(), problem.size()) == static_cast<ssize_t>(problem.size());
        ::_exit(said ? 0 : 1);
    }
    ::close(ends[1]);
    std::string problem;
    char bytes[512];
    for (ssize_t got = 0; (got = ::read(ends[0], bytes, sizeof bytes)) != 0;) {
        if (got > 0) problem.append(bytes, static_cast<std::size_t>(got));
        if (got < 0 && errno != EINTR) break;
    }
    ::close(ends[0]);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (problem.empty() && status != 0) problem = "the process graph needs a network of its own: that failed";
    return problem;
}

void check_programs(const GraphBenchOptions& options) {
    GraphBenchOptions tried = options;
    if (tried.frames_folder.empty()) tried.frames_folder = ".";  // before there are frames
    const GraphFileOnDisk file(graph_text(tried, Pixels::ring));
    load_graph(file.path().string());
}

void check_network(const std::string& problem) {
    if (!problem.empty()) throw ConfigurationError(problem);
}

}  // namespace

void check_graph_bench(const GraphBenchOptions& options) {
    check_programs(options);
    check_network(try_network());
}

GraphBenchResult run_graph_bench(const GraphBenchOptions& options, const GraphBenchProgress& progress) {
    check_programs(options);
    check_network(enter_network());
    const std::string url = default_lcm_url;

    GraphBenchResult result;
    result.width = options.width;
    result.height = options.height;
    result.frames_per_second = options.frames_per_second;
    result.largest_receive_buffer = static_cast<int>(receive_buffers().largest / 2);

    const int large_buffer = std::min(result.largest_receive_buffer, enough_buffer);
    const std::string large_url = url + "&recv_buf_size=" + std::to_string(large_buffer);
    const int usual = static_cast<int>(receive_buffers().usual);
    const int large = granted_receive_buffer(large_buffer);
    const auto title = [](int bytes) {
        return "pixels in LCM messages, buffer " + std::to_string(bytes) + " bytes";
    };

    const double compared = std::min(options.seconds, most_seconds_to_compare);
    const std::vector<ProcessWay> ways{
        {"graph", "5 processes, frames in shared memory", Pixels::ring, url, options.seconds, usual, ""},
        {"messages", title(usual), Pixels::messages, url, compared, usual,
         "the buffer that LCM gets unasked"},
        {"messages_large_buffer", title(large), Pixels::messages, large_url, compared, large,
         large_buffer == result.largest_receive_buffer ? "the largest buffer this system grants"
                                                       : "this system would grant a larger buffer still"}};
    ProgressSum sum(options, progress, options.seconds + 3 * compared);
    const auto keep = [&](std::optional<WayResult> way) {
        if (way) result.ways.push_back(std::move(*way));
        return way.has_value();
    };
    const auto run = [&](const ProcessWay& way) {
        return keep(run_processes(way, options, sum.way(way.title, way.seconds)));
    };
    const auto run_alone = [&] {
        return keep(
            run_in_one_process(compared, options, sum.way("the same modules in one process", compared)));
    };
    try {
        result.complete = run(ways[0]) && run_alone() && run(ways[1]) && run(ways[2]);
    } catch (const std::exception& error) {
        result.failure = error.what();
    }
    return result;
}

}  // namespace goalmouth::bench
