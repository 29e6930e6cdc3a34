#pragma once

#include "core/process/graph.h"

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

#include <goalmouth/status_t.hpp>

namespace goalmouth {

/// How a process stands.
enum class ProcessState {
    waiting,  // not started yet, or died and waits for its next start
    running,
    finished,  // ended by itself with exit code 0: a source with nothing left to send; not started again
    failed,  // ended with exit code 2 (its configuration is wrong) or cannot be run at all; not started again
    stopped,  // ended because the launcher asked it to
};

/// What the launcher knows about one process.
struct ProcessReport {
    std::string name;
    std::string executable;
    ProcessState state = ProcessState::waiting;
    pid_t pid = 0;                   // 0 where it does not run
    int restarts = 0;                // starts after the first
    std::string last_end;            // how it ended last: "killed by SIGSEGV (11)", "exit code 1"; "" = never
    int exit_code = -1;              // of its last end; −1 = none, or killed by a signal
    std::optional<status_t> status;  // its last status message, from its present life
    double status_age = 0.0;         // [s] since that message, or since the start where there is none
};

struct LauncherEvent {
    enum class Kind {
        output,  // `text` is one line the process wrote
        started,
        died,      // unexpectedly; `text` says how, and when it starts again
        finished,  // by itself, with exit code 0
        failed,    // will not be started again; `text` says why
        stopped,   // on request
        notice,    // of the launcher itself; process is −1
    };
    Kind kind = Kind::notice;
    int process = -1;  // index into the graph's processes
    std::string text;
};

struct LauncherOptions {
    std::string lcm_url;            // as lcm_url_of() gave it
    double first_backoff = 0.2;     // [s] pause before the first restart; doubles with each
    double longest_backoff = 10.0;  // [s]
    double steady_after = 30.0;     // [s] a process that lived this long starts again after the first pause
    double grace = 5.0;             // [s] between SIGTERM and SIGKILL
};

/// Runs the processes of a graph: starts them, collects their output and STATUS, restarts what dies, ends
/// them all.
///
/// Each process leads a process group of its own and gets SIGTERM should this process die; a guardian process
/// (guardian.h) ends whole groups should this process be killed. No threads and no signal handlers of its
/// own: one thread makes it, polls it and stops it. Make it early: the guardian is forked in the constructor.
class Launcher {
  public:
    Launcher(Graph graph, LauncherOptions options);
    ~Launcher();  // stops what still runs
    Launcher(const Launcher&) = delete;
    Launcher& operator=(const Launcher&) = delete;

    /// Starts every process; those that subscribe to nothing (cameras) once the others have reported for the
    /// first time, or after three seconds. Throws std::runtime_error where the LCM URL cannot be opened.
    void start();

    /// Waits up to `timeout` for something to happen (returns early where a signal interrupts), and returns
    /// what did, in order.
    std::vector<LauncherEvent> poll(std::chrono::milliseconds timeout);

    /// Ends every process: SIGTERM, then SIGKILL after the grace time or once `at_once()` is true. Returns
    /// the last events. When it returns no process of any group is left. May be called again.
    std::vector<LauncherEvent> stop(const std::function<bool()>& at_once = {});

    const Graph& graph() const;
    /// One for each process of the graph, in its order.
    std::vector<ProcessReport> processes() const;
    /// Every process that is not meant to have ended runs.
    bool all_alive() const;
    /// No process runs and none will be started.
    bool all_ended() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Counts SIGINT and SIGTERM from its making on, so that a loop can end as asked; waits in system calls
/// return at once.
class StopSignals {
  public:
    StopSignals();
    ~StopSignals();  // puts the former handlers back
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;
    static int received();
};

/// Where a graph gets a network that carries multicast.
enum class NetworkChoice { automatic, host, separate };

/// Makes sure that `lcm_url` works before anything opens it, in this process and those it starts: leaves the
/// host's network where multicast works there or `host` is chosen, else enters a network of its own (one
/// thread only, for good). Returns what to tell the user:
/// "" or a sentence, e.g. how to join that network. Throws ConfigurationError that says what to type where
/// nothing works.
std::string provide_network(const std::string& lcm_url, NetworkChoice choice);

}  // namespace goalmouth
