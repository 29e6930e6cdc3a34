#include "core/process/launcher.h"

#include "core/messaging/channels.h"
#include "core/messaging/frame_ring.h"
#include "core/messaging/lcm_bus.h"
#include "core/messaging/typed.h"
#include "core/process/guardian.h"
#include "core/process/launcher_child.h"
#include "core/process/launcher_command.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

namespace goalmouth {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;
using Kind = LauncherEvent::Kind;

// STATUS has no descriptor to wait on, so it is asked for this often; so is the end of a process where there
// are no pidfds.
constexpr std::chrono::milliseconds longest_wait{50};
constexpr int configuration_error = 2;  // exit code
constexpr std::chrono::seconds patience_after_kill{5};
constexpr std::chrono::seconds patience_with_listeners{3};  // foreign programs need not publish STATUS

struct Slot {
    Child child;
    ProcessState state = ProcessState::waiting;
    int starts = 0;
    int deaths_in_a_row = 0;
    std::string last_end;
    int exit_code = -1;
    Clock::time_point started;
    Clock::time_point next_start;
    std::optional<status_t> status;
    Clock::time_point status_time;

    bool runs() const { return state == ProcessState::running; }
};

std::string seconds_text(double seconds) {
    char text[32];
    std::snprintf(text, sizeof text, seconds < 10.0 ? "%.1f s" : "%.0f s", seconds);
    return text;
}

}  // namespace

struct Launcher::Impl {
    Graph graph;
    LauncherOptions options;
    Guardian guardian;
    std::unique_ptr<LcmBus> bus;
    std::vector<Slot> slots;
    std::vector<LauncherEvent> events;
    bool stopping = false;

    Impl(Graph given, LauncherOptions chosen)
        : graph(std::move(given)),
          options(std::move(chosen)),
          guardian(options.grace, [] { remove_stale_rings(); }) {
        slots.resize(graph.processes.size());
    }

    const GraphProcess& process(std::size_t i) const { return graph.processes[i]; }

    void tell(Kind kind, std::size_t i, std::string text = {}) {
        events.push_back({kind, static_cast<int>(i), std::move(text)});
    }

    void start(std::size_t i) {
        Slot& slot = slots[i];
        const auto line = command_line(graph, process(i), options.lcm_url);
        slot.started = Clock::now();
        slot.status.reset();
        const int error = slot.child.start(line, {"LCM_DEFAULT_URL=" + options.lcm_url},
                                           [this](pid_t group) { guardian.watch(group); });
        ++slot.starts;
        if (error == 0) {
            slot.state = ProcessState::running;
            tell(Kind::started, i, line[0]);
            return;
        }
        slot.last_end = "cannot run " + line[0] + ": " + std::strerror(error);
        // A program that ran before may be back in a moment: someone builds it anew.
        if (slot.starts > 1) {
            wait_for_restart(i);
        } else {
            slot.state = ProcessState::failed;
            tell(Kind::failed, i, slot.last_end);
        }
    }

    void wait_for_restart(std::size_t i) {
        Slot& slot = slots[i];
        const double lived = Seconds(Clock::now() - slot.started).count();
        if (lived >= options.steady_after) slot.deaths_in_a_row = 0;
        const double pause =
            std::min(options.longest_backoff,
                     options.first_backoff * std::pow(2.0, std::min(slot.deaths_in_a_row, 30)));
        ++slot.deaths_in_a_row;
        slot.state = ProcessState::waiting;
        slot.next_start = Clock::now() + std::chrono::duration_cast<Clock::duration>(Seconds(pause));
        tell(Kind::died, i,
             slot.last_end + " after " + seconds_text(lived) + "; starts again in " + seconds_text(pause));
    }

    bool is_source(std::size_t i) const { return process(i).description.info.subscribes.empty(); }

    /// Every process starts, but sources wait until the others listen: they would lose the first frames.
    void start_all() {
        for (std::size_t i = 0; i < slots.size(); ++i) {
            if (is_source(i)) {
                slots[i].state = ProcessState::waiting;
                slots[i].next_start = Clock::now() + patience_with_listeners;
            } else {
                start(i);
            }
        }
        start_due();
    }

    /// A process listens by the time it reports for the first time.
    void start_sources_once_heard() {
        for (std::size_t i = 0; i < slots.size(); ++i) {
            if (!is_source(i) && slots[i].runs() && !slots[i].status) return;
        }
        for (std::size_t i = 0; i < slots.size(); ++i) {
            if (is_source(i) && slots[i].starts == 0) slots[i].next_start = Clock::now();
        }
    }

    void start_due() {
        start_sources_once_heard();
        for (std::size_t i = 0; i < slots.size(); ++i) {
            if (slots[i].state == ProcessState::waiting && Clock::now() >= slots[i].next_start) start(i);
        }
    }

    void read_output(std::size_t i, bool to_the_end) {
        for (auto& line : to_the_end ? slots[i].child.rest() : slots[i].child.read_lines()) {
            tell(Kind::output, i, std::move(line));
        }
    }

    /// The leader ended and nothing of its group lives: takes note, and plans what follows.
    void bury(std::size_t i) {
        Slot& slot = slots[i];
        const pid_t group = slot.child.pid();
        read_output(i, true);
        const int status = slot.child.reap();
        guardian.forget(group);
        slot.last_end = end_text(status);
        const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
        slot.exit_code = code;
        if (stopping) {
            slot.state = ProcessState::stopped;
            tell(Kind::stopped, i, slot.last_end);
        } else if (code == 0) {
            slot.state = ProcessState::finished;
            tell(Kind::finished, i, slot.last_end);
        } else if (code == configuration_error) {
            slot.state = ProcessState::failed;
            tell(Kind::failed, i, "its configuration is wrong (exit code 2); it is not started again");
        } else {
            wait_for_restart(i);
        }
    }

    void look_for_deaths() {
        for (std::size_t i = 0; i < slots.size(); ++i) {
            if (!slots[i].runs() || !slots[i].child.ended()) continue;
            ::kill(-slots[i].child.pid(),
                   SIGKILL);  // what it started itself; the zombie keeps the number ours
            bury(i);
            remove_stale_rings();
        }
    }

    void on_status(const status_t& message) {
        for (std::size_t i = 0; i < slots.size(); ++i) {
            Slot& slot = slots[i];
            // Another graph on this port may use the same names, and a dead process's last word may come
            // late.
            if (process(i).name != message.process || !slot.runs()) continue;
            if (message.pid != slot.child.pid() && ::getpgid(message.pid) != slot.child.pid()) continue;
            slot.status = message;
            slot.status_time = Clock::now();
        }
    }

    void wait(std::chrono::milliseconds limit) {
        Clock::duration left = std::min<Clock::duration>(limit, longest_wait);
        std::vector<pollfd> waits;
        for (const Slot& slot : slots) {
            if (slot.runs()) {
                waits.push_back({slot.child.output_descriptor(), POLLIN, 0});
                waits.push_back({slot.child.end_descriptor(), POLLIN, 0});
            } else if (slot.state == ProcessState::waiting && !stopping) {
                left = std::min(left, slot.next_start - Clock::now());
            }
        }
        left = std::max(left, Clock::duration::zero());
        ::poll(waits.data(), waits.size(),
               static_cast<int>(std::chrono::ceil<std::chrono::milliseconds>(left).count()));
    }

    std::vector<LauncherEvent> take_events() { return std::exchange(events, {}); }
};

Launcher::Launcher(Graph graph, LauncherOptions options)
    : impl_(std::make_unique<Impl>(std::move(graph), std::move(options))) {}

Launcher::~Launcher() {
    stop();
}

const Graph& Launcher::graph() const {
    return impl_->graph;
}

void Launcher::start() {
    Impl& self = *impl_;
    self.bus = std::make_unique<LcmBus>(self.options.lcm_url);
    std::vector<std::string> names = {channels::status};
    for (const auto& process : self.graph.processes) names.push_back(process.channel(channels::status));
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    for (const auto& name : names) {
        subscribe<status_t>(*self.bus, name, [&self](const status_t& message) { self.on_status(message); });
    }
    self.stopping = false;
    self.start_all();
}

std::vector<LauncherEvent> Launcher::poll(std::chrono::milliseconds timeout) {
    Impl& self = *impl_;
    const auto deadline = Clock::now() + timeout;
    const int signals = StopSignals::received();
    for (;;) {
        self.start_due();
        if (self.events.empty()) {
            self.wait(std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()));
        }
        for (std::size_t i = 0; i < self.slots.size(); ++i) {
            if (self.slots[i].runs()) self.read_output(i, false);
        }
        self.look_for_deaths();
        if (self.bus) self.bus->dispatch(std::chrono::milliseconds(0));
        if (self.guardian.keep_alive()) {
            self.events.push_back({Kind::notice, -1, "the guardian had been killed; there is a new one"});
        }
        if (!self.events.empty() || Clock::now() >= deadline || StopSignals::received() != signals) break;
    }
    return self.take_events();
}

std::vector<LauncherEvent> Launcher::stop(const std::function<bool()>& at_once) {
    Impl& self = *impl_;
    self.stopping = true;
    const auto deadline =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(Seconds(self.options.grace));
    bool any = false;
    for (Slot& slot : self.slots) {
        if (slot.runs()) {
            any = true;
            ::kill(-slot.child.pid(), SIGTERM);
        } else if (slot.state == ProcessState::waiting) {
            slot.state = ProcessState::stopped;
        }
    }
    bool killed = false;
    Clock::time_point given_up;
    while (std::any_of(self.slots.begin(), self.slots.end(), [](const Slot& slot) { return slot.runs(); })) {
        if (!killed && (Clock::now() >= deadline || (at_once && at_once()))) {
            killed = true;
            given_up = Clock::now() + patience_after_kill;
            for (const Slot& slot : self.slots) {
                if (slot.runs()) ::kill(-slot.child.pid(), SIGKILL);
            }
        }
        // Only a process that waits inside the kernel outlives SIGKILL; nobody can help it on.
        if (killed && Clock::now() >= given_up) {
            self.events.push_back(
                {Kind::notice, -1, "a process does not end although it was killed; it is left behind"});
            break;
        }
        const auto living = living_groups();
        for (std::size_t i = 0; i < self.slots.size(); ++i) {
            if (!self.slots[i].runs()) continue;
            self.read_output(i, false);
            if (self.slots[i].child.ended() && !living.contains(self.slots[i].child.pid())) self.bury(i);
        }
        ::poll(nullptr, 0, 10);
    }
    if (any) remove_stale_rings();
    return self.take_events();
}

std::vector<ProcessReport> Launcher::processes() const {
    std::vector<ProcessReport> reports;
    const auto now = Clock::now();
    for (std::size_t i = 0; i < impl_->slots.size(); ++i) {
        const Slot& slot = impl_->slots[i];
        const auto& process = impl_->process(i);
        const auto since = slot.status ? slot.status_time : slot.started;
        reports.push_back({process.name, process.executable, slot.state, slot.runs() ? slot.child.pid() : 0,
                           std::max(0, slot.starts - 1), slot.last_end, slot.exit_code, slot.status,
                           Seconds(now - since).count()});
    }
    return reports;
}

bool Launcher::all_alive() const {
    return std::all_of(impl_->slots.begin(), impl_->slots.end(), [](const Slot& slot) {
        return slot.runs() || slot.state == ProcessState::finished || slot.state == ProcessState::stopped;
    });
}

bool Launcher::all_ended() const {
    return std::none_of(impl_->slots.begin(), impl_->slots.end(),
                        [](const Slot& slot) { return slot.runs() || slot.state == ProcessState::waiting; });
}

}  // namespace goalmouth
