#include "tools/goalmouth/image_chain.h"

#include "core/conversion/border.h"
#include "core/conversion/camera_pose.h"
#include "core/conversion/candidates.h"
#include "core/conversion/intrinsics.h"
#include "core/conversion/kinematics.h"
#include "core/conversion/odometry.h"
#include "core/conversion/pose.h"
#include "core/conversion/posts.h"
#include "core/conversion/refinement.h"
#include "core/conversion/segments.h"
#include "core/messaging/channels.h"
#include "core/messaging/image_output.h"
#include "core/messaging/memory_bus.h"
#include "core/messaging/typed.h"
#include "core/process/configuration.h"
#include "core/process/graph.h"
#include "core/process/status.h"
#include "tools/goalmouth/registry.h"

#include <algorithm>
#include <set>
#include <utility>

#include <goalmouth/border_t.hpp>
#include <goalmouth/candidates_t.hpp>
#include <goalmouth/image_t.hpp>
#include <goalmouth/pose_t.hpp>
#include <goalmouth/posts_t.hpp>
#include <goalmouth/refinement_t.hpp>
#include <goalmouth/segments_t.hpp>

namespace goalmouth {
namespace {

namespace fs = std::filesystem;

bool publishes_type(const GraphProcess& process, const std::string& type) {
    const auto& uses = process.description.info.publishes;
    return std::any_of(uses.begin(), uses.end(), [&](const ChannelUse& use) { return use.type == type; });
}

bool subscribes_type(const GraphProcess& process, const std::string& type) {
    const auto& uses = process.description.info.subscribes;
    return std::any_of(uses.begin(), uses.end(), [&](const ChannelUse& use) { return use.type == type; });
}

/// Posts in, the same posts out.
bool refines(const GraphProcess& process) {
    return subscribes_type(process, "posts_t") && publishes_type(process, "posts_t");
}

/// Processes that find or measure posts by more than one channel. In a chain all that is known of a picture
/// comes before what others found in it: nothing is to be waited for.
void wait_for_nothing(std::vector<GraphProcess>& stages) {
    constexpr const char* wait = "timing.wait";
    for (GraphProcess& process : stages) {
        const auto& parameters = process.description.parameters;
        const bool waits = std::any_of(parameters.begin(), parameters.end(),
                                       [&](const ParameterInfo& p) { return p.key == wait; });
        if (publishes_type(process, "posts_t") && waits)
            process.settings.push_back({wait, "0", {"one picture after the other", 0}, {}});
    }
}

/// The processes between pictures and messages of type `result`: those that publish it, and whatever they get
/// their messages from, up to the source of the pictures, which is left out.
std::vector<GraphProcess> stages_to(const std::string& result, const Graph& graph, bool carry_over = false) {
    std::set<std::string> wanted;  // channels
    std::vector<bool> taken(graph.processes.size(), false);
    for (bool grew = true; grew;) {
        grew = false;
        for (std::size_t i = 0; i < graph.processes.size(); ++i) {
            const GraphProcess& process = graph.processes[i];
            if (taken[i] || publishes_type(process, "image_t")) continue;
            const auto& info = process.description.info;
            const bool needed =
                std::any_of(info.publishes.begin(), info.publishes.end(), [&](const ChannelUse& use) {
                    return use.type == result || wanted.contains(process.channel(use.channel));
                });
            if (!needed) continue;
            taken[i] = grew = true;
            for (const ChannelUse& use : info.subscribes) {
                // What is optional may carry something over from one picture to the next.
                if (use.optional && !carry_over) continue;
                if (use.type != "image_t" && use.type != result) wanted.insert(process.channel(use.channel));
            }
        }
    }
    std::vector<GraphProcess> stages;
    for (std::size_t i = 0; i < graph.processes.size(); ++i) {
        if (taken[i]) stages.push_back(graph.processes[i]);
    }
    return stages;
}

bool has_parameter(const GraphProcess& process, const std::string& key) {
    const auto& parameters = process.description.parameters;
    return std::any_of(parameters.begin(), parameters.end(),
                       [&](const ParameterInfo& p) { return p.key == key; });
}

void override_parameter(std::vector<GraphProcess>& stages, const std::string& key, const fs::path& file,
                        const std::string& origin) {
    if (file.empty()) return;
    if (!fs::exists(file)) throw ConfigurationError(origin + ": there is no file " + file.string());
    bool known = false;
    for (GraphProcess& process : stages) {
        if (!has_parameter(process, key)) continue;
        process.settings.push_back({key, fs::absolute(file).string(), {origin, 0}, fs::current_path()});
        known = true;
    }
    if (!known) throw ConfigurationError(origin + ": no stage of the graph has a parameter `" + key + "`");
}

/// The camera file that the graph gives the source of its pictures, if any.
fs::path camera_of(const Graph& graph) {
    fs::path found;
    for (const GraphProcess& process : graph.processes) {
        if (!publishes_type(process, "image_t")) continue;
        for (const GraphSetting& setting : process.settings) {
            if (setting.key == "camera" && !setting.value.empty()) found = setting.folder / setting.value;
        }
    }
    return found;
}

image_t image_message(YuyvView image, const Intrinsics& camera, std::int64_t utime, std::int64_t seq) {
    FrameInfo info;
    info.utime = utime;
    info.seq = seq;
    info.intrinsics = to_message(camera);
    return self_contained_yuyv(info, "picture", image);
}

struct Stage {
    GraphProcess process;
    MemoryBus* bus = nullptr;
    Status status;
    std::unique_ptr<ModuleContext> context;
    std::unique_ptr<Module> module;
};

}  // namespace

bool takes_colours(const std::string& graph) {
    GraphOptions options;
    options.describe = describe_module;
    const std::vector<GraphProcess> stages = stages_to("posts_t", load_graph(graph, options));
    return std::any_of(stages.begin(), stages.end(),
                       [](const GraphProcess& process) { return has_parameter(process, "colours"); });
}

struct ImageChain::State {
    MemoryHub hub;
    std::vector<std::unique_ptr<Stage>> stages;
    std::set<std::string> image_channels;
    std::set<std::string> kinematics_channels;
    std::set<std::string> odometry_channels;
    Intrinsics camera;
    std::optional<Eigen::Isometry3d> T_BC;
    std::int64_t utime = 0;
    ImageResult result;

    void add(const Graph& graph, const GraphProcess& process);
    void listen();
    template <class Message, class F>
    void hear(const std::string& type, F handler);
    bool goes_on(const std::string& channel) const;
};

void ImageChain::State::add(const Graph& graph, const GraphProcess& process) {
    const ModuleType* type = find_module_type(process.executable);
    if (type == nullptr) {
        throw ConfigurationError(
            process.place.text() + ": process " + process.name + " runs " + process.executable +
            ", which is not one of goalmouth's modules and cannot run inside `goalmouth`");
    }
    auto stage = std::make_unique<Stage>();
    stage->process = process;
    stage->bus = &hub.endpoint(process.name);
    stage->context = std::make_unique<ModuleContext>(
        ModuleContext{*stage->bus, stage->status, process.name, graph.seed, process.channels});
    stage->module = type->create(*stage->context, process.configuration());
    for (const ChannelUse& use : type->info.subscribes) {
        if (use.channel == channels::image) image_channels.insert(process.channel(use.channel));
        if (use.type == "kinematics_t") kinematics_channels.insert(process.channel(use.channel));
        if (use.type == "odometry_t") odometry_channels.insert(process.channel(use.channel));
    }
    stages.push_back(std::move(stage));
}

/// Subscribes once to each channel of that type.
template <class Message, class F>
void ImageChain::State::hear(const std::string& type, F handler) {
    std::set<std::string> names;
    for (const auto& stage : stages) {
        for (const ChannelUse& use : stage->process.description.info.publishes) {
            const std::string channel = stage->process.channel(use.channel);
            if (use.type == type && !(type == "posts_t" && goes_on(channel))) names.insert(channel);
        }
    }
    for (const std::string& name : names) subscribe<Message>(hub.endpoint("results"), name, handler);
}

/// Whether posts on this channel are refined to others.
bool ImageChain::State::goes_on(const std::string& channel) const {
    return std::any_of(stages.begin(), stages.end(), [&](const auto& stage) {
        const auto& uses = stage->process.description.info.subscribes;
        return refines(stage->process) && std::any_of(uses.begin(), uses.end(), [&](const ChannelUse& use) {
                   return use.type == "posts_t" && stage->process.channel(use.channel) == channel;
               });
    });
}

void ImageChain::State::listen() {
    hear<segments_t>("segments_t", [this](const segments_t& m) { result.segments = from_message(m); });
    hear<border_t>("border_t", [this](const border_t& m) { result.border = from_message(m); });
    hear<candidates_t>("candidates_t",
                       [this](const candidates_t& m) { result.candidates = from_message(m); });
    hear<posts_t>("posts_t", [this](const posts_t& m) {
        for (const Post& post : from_message(m)) {
            result.posts.push_back(post);
            result.detectors.push_back(m.detector);
            result.refinements.emplace_back();
        }
    });
    // It follows the posts it is about.
    hear<refinement_t>("refinement_t", [this](const refinement_t& m) {
        std::size_t at = result.posts.size() - std::min(result.posts.size(), m.posts.size());
        for (RefinedPost& how : from_message(m)) {
            how.post = result.posts.at(at);
            result.refinements.at(at++) = std::move(how);
        }
    });
    hear<pose_t>("pose_t", [this](const pose_t& m) { result.pose = from_message(m); });
}

ImageChain::ImageChain(const ImageChainOptions& options) : state_(std::make_unique<State>()) {
    GraphOptions graph_options;
    graph_options.settings = options.settings;
    graph_options.describe = describe_module;
    Graph graph = load_graph(options.graph, graph_options);
    graph.seed = options.seed.value_or(graph.seed);
    const bool to_pose = options.end == ChainEnd::pose;
    std::vector<GraphProcess> stages = stages_to(to_pose ? "pose_t" : "posts_t", graph, options.carry_over);
    if (stages.empty()) {
        throw ConfigurationError(graph.file.string() + ": no process of this graph finds " +
                                 (to_pose ? "the robot's pose" : "goalposts"));
    }
    if (!options.refine) std::erase_if(stages, refines);
    wait_for_nothing(stages);
    override_parameter(stages, "colours", options.colours, "--colours");
    override_parameter(stages, "field", options.field, "--field");

    const fs::path camera = options.camera.empty() ? camera_of(graph) : options.camera;
    if (!options.camera.empty() && !fs::exists(camera))
        throw ConfigurationError("--camera: there is no file " + camera.string());
    if (!camera.empty()) state_->camera = load_parameters<Intrinsics>(camera);
    state_->T_BC = options.T_BC;
    for (const GraphProcess& process : stages) state_->add(graph, process);
    state_->listen();
}

ImageChain::~ImageChain() = default;

ImageResult ImageChain::run(const ChainFrame& frame) {
    const YuyvView& image = frame.image;
    State& s = *state_;
    s.result = {};
    s.result.camera = frame.camera.value_or(scaled_to(s.camera, image.width, image.height));
    s.utime = frame.utime.value_or(s.utime + 1'000'000);
    std::vector<std::chrono::nanoseconds> before;
    for (const auto& stage : s.stages) before.push_back(stage->bus->time_spent());

    MemoryBus& source = s.hub.endpoint("picture");
    if (frame.kinematics || s.T_BC) {
        const kinematics_t message = frame.kinematics
                                         ? to_message(KinematicsSample{s.utime, *frame.kinematics}, frame.seq)
                                         : kinematics_message(*s.T_BC, s.utime, frame.seq);
        for (const auto& channel : s.kinematics_channels) publish(source, channel, message);
    }
    if (frame.odometry) {
        OdometrySample sample = *frame.odometry;
        sample.utime = s.utime;
        for (const auto& channel : s.odometry_channels)
            publish(source, channel, to_message(sample, frame.seq));
    }
    const image_t message = image_message(image, s.result.camera, s.utime, frame.seq);
    for (const auto& channel : s.image_channels) publish(source, channel, message);
    s.hub.run_until_idle();

    for (std::size_t i = 0; i < s.stages.size(); ++i) {
        const std::chrono::duration<double, std::milli> spent = s.stages[i]->bus->time_spent() - before[i];
        s.result.milliseconds[s.stages[i]->process.name] = spent.count();
    }
    return std::move(s.result);
}

std::vector<std::string> ImageChain::stages() const {
    std::vector<std::string> names;
    for (const auto& stage : state_->stages) names.push_back(stage->process.name);
    return names;
}

}  // namespace goalmouth
