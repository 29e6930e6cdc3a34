#include "core/messaging/lcm_bus.h"
#include "core/process/configuration.h"
#include "tools/goalmouth/checks.h"
#include "tools/goalmouth/demo_monitor.h"
#include "tools/goalmouth/demo_report.h"
#include "tools/goalmouth/network_option.h"
#include "tools/goalmouth/output.h"
#include "tools/goalmouth/verbs.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <iostream>
#include <sys/ioctl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

namespace goalmouth {
namespace {

using Clock = std::chrono::steady_clock;

struct DemoOptions {
    std::string graph;
    std::string images;
    std::string json;
    std::string pictures = "goalmouth-demo";
    std::string lcm_url;
    std::string network = "auto";
    std::vector<std::string> settings;
    double seconds = 30.0;
    bool headless = false;
};

/// What frames still in the graph need to come out of it.
constexpr std::chrono::seconds time_to_drain{2};

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// As much of a text as fits one line of the terminal: a longer one would wrap, and not be overwritten.
std::string fitting(const std::string& text) {
    winsize window{};
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) != 0 || window.ws_col == 0) return text;
    std::size_t end = 0;
    for (int columns = 0; end < text.size(); ++end) {
        const bool begins_letter = (static_cast<unsigned char>(text[end]) & 0xC0U) != 0x80U;  // UTF-8
        if (begins_letter && ++columns >= window.ws_col) break;
    }
    return text.substr(0, end);
}

/// One line that is rewritten in place on a terminal, and appears now and then elsewhere.
class StatusLine {
  public:
    explicit StatusLine(bool live) : live_(live) {}

    void show(const std::string& text) {
        if (live_) {
            std::cout << "\r\x1b[K" << fitting(text) << std::flush;
            shown_ = true;
        } else if (Clock::now() >= next_) {
            std::cout << text << std::endl;
            next_ = Clock::now() + std::chrono::seconds(5);
        }
    }
    void clear() {
        if (shown_) std::cout << "\r\x1b[K" << std::flush;
        shown_ = false;
    }

  private:
    bool live_;
    bool shown_ = false;
    Clock::time_point next_{};
};

std::string status_text(const DemoMonitor& monitor, const Launcher& launcher, double elapsed,
                        double seconds) {
    int alive = 0;
    const auto processes = launcher.processes();
    for (const auto& process : processes) alive += process.state == ProcessState::running ? 1 : 0;
    std::string text = fmt::format(
        "{:4.0f} of {:.0f} s   {} of {} processes   {:5.1f} frames/s   {:.2f} posts a frame", elapsed,
        seconds, alive, processes.size(), monitor.frames_per_second(), monitor.posts_per_frame());
    if (const auto& pose = monitor.pose()) {
        text += fmt::format("   pose {:+.2f} m {:+.2f} m {:+4.0f}°", pose->x, pose->y,
                            pose->theta * 180.0 / M_PI);
    }
    if (!monitor.errors().empty()) {
        const PoseError& error = monitor.errors().back();
        text += fmt::format("   off by {:.2f} m {:.0f}°", error.metres, error.radians * 180.0 / M_PI);
    }
    return text;
}

void report_event(const Launcher& launcher, const LauncherEvent& event, StatusLine& line) {
    using Kind = LauncherEvent::Kind;
    if (event.kind == Kind::started || event.kind == Kind::stopped) return;
    line.clear();
    const std::string who =
        event.process < 0 ? "demo" : launcher.graph().processes[static_cast<std::size_t>(event.process)].name;
    std::cout << who << ": " << event.text << std::endl;
}

Graph graph_for(const DemoOptions& options) {
    GraphOptions graph_options;
    graph_options.settings = options.settings;
    if (options.images.empty())
        return load_graph(options.graph.empty() ? "refined" : options.graph, graph_options);
    if (!std::filesystem::is_directory(options.images)) {
        throw ConfigurationError("--images: " + options.images + " is not a folder");
    }
    graph_options.settings.push_back("camera.path=" + std::filesystem::absolute(options.images).string());
    return load_graph(options.graph.empty() ? "images" : options.graph, graph_options);
}

int run_demo(const DemoOptions& options) {
    if (!options.json.empty()) expect_writable(options.json, "--json");
    make_output_folder(options.pictures, "--pictures");
    const Graph graph = graph_for(options);
    const std::string url = lcm_url_of(graph, options.lcm_url);
    const std::string network = provide_network(url, network_choice(options.network));
    if (!network.empty()) std::cout << network << std::endl;

    LauncherOptions launcher_options;
    launcher_options.lcm_url = url;
    StopSignals signals;
    Launcher launcher(graph, launcher_options);
    LcmBus bus(url);
    DemoMonitor monitor(bus, graph);

    std::cout << "Running " << graph.file.filename().string() << ": " << graph.processes.size()
              << " processes for " << options.seconds << " s; Ctrl-C ends it." << std::endl;
    launcher.start();
    StatusLine line(!options.headless && isatty(STDOUT_FILENO) == 1);
    const auto start = Clock::now();
    auto next_line = start;
    auto end =
        start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options.seconds));
    std::vector<ProcessReport> processes;
    bool failed = false;
    while (StopSignals::received() == 0 && Clock::now() < end && !failed) {
        bus.dispatch(std::chrono::milliseconds(20));
        for (const auto& event : launcher.poll(std::chrono::milliseconds(0))) {
            report_event(launcher, event, line);
            failed = failed || event.kind == LauncherEvent::Kind::failed;
            if (event.kind == LauncherEvent::Kind::finished && processes.empty()) {
                // The images are at their end. Rates are those of now, not of the silence that follows.
                processes = launcher.processes();
                end = std::min(end, Clock::now() + time_to_drain);
            }
        }
        if (Clock::now() >= next_line) {
            line.show(status_text(monitor, launcher, seconds_since(start), options.seconds));
            next_line = Clock::now() + std::chrono::milliseconds(200);
        }
    }
    const double elapsed = seconds_since(start);
    if (processes.empty()) processes = launcher.processes();
    line.clear();
    launcher.stop([] { return StopSignals::received() > 1; });

    std::cout << '\n' << demo_table(processes, monitor) << std::endl;
    for (const auto& picture : write_demo_pictures(options.pictures, graph, monitor)) {
        std::cout << "Picture: " << picture.string() << std::endl;
    }
    if (!options.json.empty()) {
        write_text(options.json, demo_json(graph, processes, monitor, elapsed).dump(2) + "\n", "--json");
        std::cout << "Figures: " << options.json << std::endl;
    }
    if (failed) return 1;
    if (monitor.frames() == 0) {
        std::cerr << "goalmouth: no frame went through the graph\n";
        return 1;
    }
    return 0;
}

}  // namespace

void add_demo_verb(CLI::App& app, Action& action) {
    auto* verb = app.add_subcommand(
        "demo", "Run a graph on a simulated robot, and show what it saw and where it thought it was");
    auto options = std::make_shared<DemoOptions>();
    verb->add_option("--graph", options->graph, "graph file, or the name of one in config/graphs [refined]")
        ->type_name("GRAPH");
    verb->add_option("--images", options->images, "real images (PNG, JPEG, PPM) instead of the simulator")
        ->type_name("DIR");
    verb->add_option("--seconds", options->seconds, "how long")
        ->check(positive_number())
        ->capture_default_str();
    verb->add_option("--json", options->json, "write the figures here, for programs")->type_name("FILE");
    verb->add_option("--pictures", options->pictures, "folder for the two pictures")
        ->type_name("DIR")
        ->capture_default_str();
    verb->add_option("--set", options->settings, "a parameter of a process (repeatable)")
        ->type_name("PROCESS.KEY=VALUE")
        ->take_all();
    verb->add_option("--lcm-url", options->lcm_url, "where the graph talks [the graph's]")->type_name("URL");
    add_network_option(*verb, options->network);
    verb->add_flag("--headless", options->headless, "no live line: for scripts");
    verb->callback([&action, options] { action = [options] { return run_demo(*options); }; });
}

}  // namespace goalmouth
