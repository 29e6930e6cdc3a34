#include "tests/graph/running_graph.h"

#include "core/messaging/tap_url.h"
#include "core/messaging/typed.h"
#include "tests/support/processes.h"

#include <algorithm>

namespace goalmouth::test {

GraphOptions slowly() {
    GraphOptions options;
    options.settings = {"camera.frames_per_second=10", "tap.every=2"};
    return options;
}

RunningGraph::RunningGraph(const std::string& file, GraphOptions options, const std::string& lcm_url,
                           Start when) {
    const Graph graph = load_graph(file, options);
    LauncherOptions launcher_options;
    launcher_options.lcm_url = lcm_url_of(graph, lcm_url);
    launcher_options.first_backoff = 0.1;
    launcher_ = std::make_unique<Launcher>(graph, launcher_options);
    bus_ = std::make_unique<LcmBus>(launcher_options.lcm_url);
    for (const auto& process : graph.processes) {
        const bool tap = process.description.info.executable == "tap";
        if (tap) tap_bus_ = std::make_unique<LcmBus>(tap_url(launcher_options.lcm_url));
        listen(tap ? *tap_bus_ : *bus_, process);
    }
    if (when == Start::now) start();
}

void RunningGraph::listen(LcmBus& bus, const GraphProcess& process) {
    for (const auto& use : process.description.info.publishes) {
        const std::string channel = process.channel(use.channel);
        bus.subscribe(channel, Delivery::every, [this, channel](std::span<const std::uint8_t> bytes) {
            ++counts_[channel];
            if (channel == "POSTS") static_cast<void>(decode(bytes, posts_));
            if (channel == "POSE") static_cast<void>(decode(bytes, pose_));
        });
    }
}

void RunningGraph::step() {
    for (const auto& event : launcher_->poll(std::chrono::milliseconds(10))) {
        story_ +=
            (event.process < 0 ? "" : launcher_->processes()[static_cast<std::size_t>(event.process)].name) +
            ": " + event.text + "\n";
    }
    for (const auto& process : launcher_->processes()) pids_.insert(process.pid);
    bus_->dispatch(std::chrono::milliseconds(10));
    if (tap_bus_) tap_bus_->dispatch(std::chrono::milliseconds(0));
}

bool RunningGraph::until(const std::function<bool()>& holds, std::chrono::seconds limit) {
    bool held = false;
    eventually(
        [&] {
            step();
            held = holds();
            return held || any_failed();
        },
        limit);
    return held;
}

bool RunningGraph::any_failed() const {
    const auto processes = launcher_->processes();
    return std::any_of(processes.begin(), processes.end(),
                       [](const ProcessReport& process) { return process.state == ProcessState::failed; });
}

bool RunningGraph::until_more(const std::string& channel, int count) {
    const int before = messages(channel);
    return until([&] { return messages(channel) >= before + count; });
}

ProcessReport RunningGraph::process(const std::string& name) const {
    for (const auto& process : launcher_->processes()) {
        if (process.name == name) return process;
    }
    throw std::runtime_error("no process " + name);
}

int RunningGraph::messages(const std::string& channel) const {
    const auto found = counts_.find(channel);
    return found == counts_.end() ? 0 : found->second;
}

}  // namespace goalmouth::test
