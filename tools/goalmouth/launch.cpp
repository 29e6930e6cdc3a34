#include "core/process/launcher.h"
#include "tools/goalmouth/checks.h"
#include "tools/goalmouth/launch_display.h"
#include "tools/goalmouth/network_option.h"
#include "tools/goalmouth/verbs.h"

#include <chrono>
#include <csignal>
#include <memory>

#include <CLI/CLI.hpp>

namespace goalmouth {
namespace {

using Clock = std::chrono::steady_clock;

struct LaunchOptions {
    std::string graph;
    double seconds = 0.0;
    std::vector<std::string> settings;
    std::string tap;
    std::string lcm_url;
    std::string network = "auto";
    bool quiet = false;
};

/// The exit code that a process which could not even begin stands for; 0 where all began.
int broken_start(const std::vector<ProcessReport>& processes) {
    for (const auto& process : processes) {
        if (process.state == ProcessState::failed && process.restarts == 0)
            return process.exit_code == 2 ? 2 : 1;
    }
    return 0;
}

int launch(const LaunchOptions& options) {
    const Graph graph = load_graph(options.graph, {options.settings, options.tap, {}});
    const std::string url = lcm_url_of(graph, options.lcm_url);
    std::signal(SIGPIPE, SIG_IGN);  // a reader that goes ends the graph in good order (display.show)
    const StopSignals signals;
    LaunchDisplay display(graph, options.quiet);
    const std::string network = provide_network(url, network_choice(options.network));
    if (!network.empty()) display.say(network);

    LauncherOptions launcher_options;
    launcher_options.lcm_url = url;
    Launcher launcher(graph, launcher_options);
    launcher.start();
    const auto end = Clock::now() + std::chrono::duration<double>(options.seconds);
    bool time_is_up = false;
    bool read = true;
    int code = 0;
    while (read && StopSignals::received() == 0 && !time_is_up && code == 0 && !launcher.all_ended()) {
        const auto events = launcher.poll(std::chrono::milliseconds(100));
        read = display.show(events, launcher.processes());
        code = broken_start(launcher.processes());
        time_is_up = options.seconds > 0.0 && Clock::now() >= end;
    }
    if (code == 0 && !launcher.all_alive()) code = 1;
    const int enough = StopSignals::received() + 1;
    display.finish(launcher.stop([enough] { return StopSignals::received() >= enough; }));
    return code;
}

}  // namespace

void add_launch_verb(CLI::App& app, Action& action) {
    auto options = std::make_shared<LaunchOptions>();
    CLI::App* verb =
        app.add_subcommand("launch", "start the processes of a graph, and keep them alive until Ctrl-C");
    verb->add_option("graph", options->graph, "graph file, or the name of one in config/graphs, e.g. refined")
        ->type_name("GRAPH")
        ->required();
    verb->add_option("--seconds", options->seconds, "end after this time [until Ctrl-C]")
        ->check(positive_number());
    verb->add_option("--set", options->settings,
                     "one parameter of one process, over the graph's (repeatable)")
        ->type_name("PROCESS.KEY=VALUE")
        ->expected(1)
        ->take_all();
    verb->add_option("--tap", options->tap,
                     "whole pictures for logs and viewers, on the graph's port + 1000: raw (every frame, "
                     "exact), jpeg, "
                     "or off [as the graph says]")
        ->check(CLI::IsMember({"raw", "jpeg", "off"}));
    verb->add_option("--lcm-url", options->lcm_url,
                     "where the graph talks [the graph's lcm_url, or $LCM_DEFAULT_URL]")
        ->type_name("URL");
    add_network_option(*verb, options->network);
    verb->add_flag("--quiet,-q", options->quiet, "show only what goes wrong");
    verb->footer(
        "Ctrl-C ends the processes in good order, a second one at once.\n"
        "Exit code: 0 ended as asked, 1 a process could not be kept alive, 2 the graph or a process is "
        "configured wrongly.");
    verb->callback([options, &action] { action = [options] { return launch(*options); }; });
}

}  // namespace goalmouth
