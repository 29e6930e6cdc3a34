#pragma once

#include "core/messaging/bus.h"
#include "core/process/status.h"
#include "core/random/random.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace goalmouth {

/// A channel a module reads or writes, under its default name.
struct ChannelUse {
    std::string channel;    // e.g. "SEGMENTS"
    std::string type;       // e.g. "segments_t"
    std::string meaning;    // a sentence for people
    bool optional = false;  // a subscription the module does without: nobody need publish it
};

/// What a module is: one glance tells what goes in, what comes out (its parameters are those of its
/// Parameters struct).
struct ModuleInfo {
    std::string executable;  // e.g. "detection_ransac"
    std::string summary;     // one sentence
    std::vector<ChannelUse> subscribes;
    std::vector<ChannelUse> publishes;
};

/// What a module gets from whoever runs it: a process of its own, or a test or tool that runs several in one.
struct ModuleContext {
    Bus& bus;
    Status& status;
    std::string name;                             // in the graph, e.g. "detection"
    std::uint64_t seed = 0;                       // of the graph
    std::map<std::string, std::string> channels;  // default name → name in this graph, where they differ
    std::string lcm_url{};                        // where `bus` talks; "" = LCM's default
    /// Opens a further bus, for a module that also talks elsewhere; throws as LcmBus does. Empty where
    /// modules share one process: there is no elsewhere.
    std::function<std::shared_ptr<Bus>(const std::string& lcm_url)> open_bus{};

    /// The name of a channel in this graph.
    std::string channel(const std::string& default_name) const {
        const auto found = channels.find(default_name);
        return found == channels.end() ? default_name : found->second;
    }
    /// The generator for everything drawn for one frame.
    Random random(std::int64_t frame_seq) const { return random_for_frame(seed, name, frame_seq); }
};

/// A stage of the graph as a process runs it: subscribes in its constructor, converts, calls core, publishes.
///
/// A module type M has, besides deriving from this class:
///
///     struct Parameters {…};
///     static ModuleInfo info();
///     M(ModuleContext& context, const Parameters& parameters);
///
/// The parameters describe themselves (core/parameters/parameters.h). The constructor throws
/// ConfigurationError; the context outlives the module.
class Module {
  public:
    Module() = default;
    Module(const Module&) = delete;
    Module& operator=(const Module&) = delete;
    virtual ~Module() = default;

    /// Work that answers no message, as a source does: called again at the latest after the returned time,
    /// and after every dispatch. May block for 100 ms at most.
    virtual std::chrono::microseconds tick() { return std::chrono::seconds(1); }

    /// True once a source has nothing left to send: the process ends with exit code 0.
    virtual bool finished() const { return false; }
};

}  // namespace goalmouth
