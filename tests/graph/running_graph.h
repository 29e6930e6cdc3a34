#pragma once

#include "core/messaging/lcm_bus.h"
#include "core/process/launcher.h"

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <goalmouth/pose_t.hpp>
#include <goalmouth/posts_t.hpp>

namespace goalmouth::test {

/// For a graph with a simulator: a machine that also compiles need not keep up with 30 frames a second.
GraphOptions slowly();

/// A graph with its launcher, and somebody who listens to what comes out.
class RunningGraph {
  public:
    enum class Start {
        now,
        later,  // by start(): for who wants to hear the first message
    };
    /// On `lcm_url` where one is given, else on the graph's own.
    explicit RunningGraph(const std::string& graph, GraphOptions options = {},
                          const std::string& lcm_url = {}, Start start = Start::now);
    void start() { launcher_->start(); }

    /// Lets things happen for a moment.
    void step();
    /// Steps until it holds, with a generous limit; gives up where a process failed for good.
    bool until(const std::function<bool()>& holds, std::chrono::seconds limit = std::chrono::seconds(60));
    /// Steps until `count` more messages came on the channel.
    bool until_more(const std::string& channel, int count);

    Launcher& launcher() { return *launcher_; }
    /// To listen to more: before the first step.
    LcmBus& bus() { return *bus_; }
    LcmBus& tap_bus() { return *tap_bus_; }
    ProcessReport process(const std::string& name) const;
    int messages(const std::string& channel) const;
    const posts_t& posts() const { return posts_; }
    const pose_t& pose() const { return pose_; }
    /// Every process that ever ran.
    const std::set<pid_t>& pids() const { return pids_; }
    /// What processes wrote and what befell them, for messages of failing tests.
    const std::string& story() const { return story_; }

  private:
    void listen(LcmBus& bus, const GraphProcess& process);
    bool any_failed() const;

    std::unique_ptr<Launcher> launcher_;
    std::unique_ptr<LcmBus> bus_;
    std::unique_ptr<LcmBus> tap_bus_;  // for what a tap publishes on its own port
    std::map<std::string, int> counts_;
    posts_t posts_{};
    pose_t pose_{};
    std::set<pid_t> pids_;
    std::string story_;
};

}  // namespace goalmouth::test
