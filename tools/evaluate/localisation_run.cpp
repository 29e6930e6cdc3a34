#include "tools/evaluate/localisation_run.h"

#include "core/process/configuration.h"
#include "core/simulation/route.h"
#include "tools/evaluate/file_hash.h"
#include "tools/evaluate/paper_settings.h"
#include "tools/evaluate/parallel.h"
#include "tools/goalmouth/image_chain.h"
#include "tools/goalmouth/registry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

namespace goalmouth {
namespace {

constexpr double track_interval = 0.2;           // s between the samples that are kept
constexpr std::int64_t whole_run = -1;           // in place of a frame's number: what is drawn once
constexpr std::int64_t first_utime = 1'000'000;  // µs

/// Means of what is added.
class QualityMean {
  public:
    void add(const PoseQuality& q) {
        sum_.position_error += q.position_error;
        sum_.heading_error += q.heading_error;
        sum_.position_sigma += q.position_sigma;
        sum_.heading_sigma += q.heading_sigma;
        ++count_;
    }
    PoseQuality mean() const {
        const double n = std::max(1, count_);
        return {sum_.position_error / n, sum_.heading_error / n, sum_.position_sigma / n,
                sum_.heading_sigma / n};
    }

  private:
    PoseQuality sum_;
    int count_ = 0;
};

PoseQuality quality_of(const PoseEstimate& estimate, const Pose2& truth) {
    return {(estimate.pose.position() - truth.position()).norm(),
            std::abs(wrap_angle(estimate.pose.theta - truth.theta)),
            std::sqrt(estimate.covariance(0, 0) + estimate.covariance(1, 1)),
            std::sqrt(estimate.covariance(2, 2))};
}

PoseQuality rounded_quality(const PoseQuality& q) {
    return {rounded(q.position_error), rounded(q.heading_error), rounded(q.position_sigma),
            rounded(q.heading_sigma)};
}

Pose2 rounded_pose(const Pose2& p) {
    return {rounded(p.x), rounded(p.y), rounded(p.theta)};
}

/// One detector's graph on one walk.
class Walk {
  public:
    Walk(const LocalisationOptions& options, const LocalisationDetector& detector, std::uint64_t seed)
        : chain_([&] {
              ImageChainOptions chain;
              chain.graph = detector.graph;
              chain.settings = detector.settings;
              chain.field = options.field_file;
              chain.colours = options.colours;
              chain.seed = seed;
              chain.end = ChainEnd::pose;
              return chain;
          }()),
          name_(detector.name) {}

    void see(const ChainFrame& frame, const Pose2& truth, bool in_track, bool in_end) {
        const ImageResult result = chain_.run(frame);
        if (!result.pose || result.pose->utime != *frame.utime) {
            throw std::runtime_error(name_ + ": frame " + std::to_string(frame.seq) +
                                     " came back without a pose");
        }
        const PoseQuality quality = quality_of(*result.pose, truth);
        walk_.add(quality);
        if (in_end) end_.add(quality);
        result_.posts += static_cast<int>(result.posts.size());
        if (!in_track) return;
        result_.path.push_back(rounded_pose(result.pose->pose));
        result_.track.push_back(rounded_quality(quality));
    }

    DetectorWalk finish() {
        result_.walk = walk_.mean();
        result_.end = end_.mean();
        return std::move(result_);
    }

  private:
    ImageChain chain_;
    std::string name_;
    DetectorWalk result_;
    QualityMean walk_;
    QualityMean end_;
};

/// Nothing where it was stopped.
std::optional<LocalisationRun> run_once(const LocalisationOptions& options, int number, int frames,
                                        const LocalisationProgress& progress) {
    const std::uint64_t seed =
        random_for_frame(options.seed, "goalmouth evaluate localisation", number).bits();
    Simulation simulation(options.simulation, options.field, options.camera,
                          random_for_frame(seed, "simulation", whole_run));
    std::vector<std::unique_ptr<Walk>> walks;
    for (const LocalisationDetector& detector : options.detectors)
        walks.push_back(std::make_unique<Walk>(options, detector, seed));

    LocalisationRun run;
    run.run = number;
    run.frames = frames;
    YuyvImage image(options.camera.width, options.camera.height);
    const auto every = std::max<std::int64_t>(1, std::llround(track_interval * options.frames_per_second));
    const OdometryParameters& odometry = options.simulation.walk.odometry;
    for (std::int64_t seq = 0; seq < frames; ++seq) {
        if (progress.stop && progress.stop()) return std::nullopt;
        const double time = static_cast<double>(seq) / options.frames_per_second;
        const double end_time = static_cast<double>(frames - 1) / options.frames_per_second;
        Random random = random_for_frame(seed, "simulation", seq);
        const SimulatedFrame simulated = simulation.capture(time, random, image.data.data(), image.stride());

        ChainFrame frame;
        frame.image = image.view();
        frame.seq = seq;
        frame.utime = first_utime + std::llround(time * 1e6);
        frame.camera = options.camera;
        frame.kinematics = CameraPose{simulated.T_BC, simulated.T_BC_covariance};
        frame.odometry = OdometrySample{.utime = *frame.utime,
                                        .pose = simulated.odometry,
                                        .translation_noise = odometry.translation_noise,
                                        .rotation_noise = odometry.rotation_noise};
        const bool in_track = seq % every == 0 || seq == frames - 1;
        if (in_track) {
            run.times.push_back(rounded(time));
            run.truth.push_back(rounded_pose(simulated.truth.robot));
        }
        for (const auto& walk : walks)
            walk->see(frame, simulated.truth.robot, in_track, time > end_time - 1.0);
        if (progress.step) progress.step();
    }
    for (const auto& walk : walks) run.detectors.push_back(walk->finish());
    return run;
}

/// "a.b" → {"a": {"b": …}}.
template <class Parameters>
nlohmann::json as_json(const Parameters& parameters) {
    nlohmann::json all = nlohmann::json::object();
    for (const ParameterInfo& p : list_parameters(parameters)) {
        const nlohmann::json value = nlohmann::json::parse(p.value, nullptr, false);
        std::string pointer = "/" + p.key;
        std::replace(pointer.begin(), pointer.end(), '.', '/');
        all[nlohmann::json::json_pointer(pointer)] = value.is_discarded() ? nlohmann::json(p.value) : value;
    }
    return all;
}

nlohmann::json settings_json(const LocalisationOptions& options) {
    nlohmann::json all;
    all["formation"] = as_json(options.simulation.formation);
    all["walk"] = as_json(options.simulation.walk);
    all["kinematics"] = as_json(options.simulation.kinematics);
    all["camera"] = as_json(options.camera);
    all["field"] = as_json(options.field);
    all["colours"] = options.colours.filename().string();
    if (!options.colours.empty()) all[std::string("colours") + hash_suffix] = file_hash(options.colours);
    for (const LocalisationDetector& detector : options.detectors) {
        GraphOptions graph;
        graph.settings = detector.settings;
        graph.describe = describe_module;
        all["detectors"][detector.name] = settings_as_json(load_graph(detector.graph, graph));
    }
    return all;
}

}  // namespace

double walk_to_ball_seconds(const WalkParameters& walk, const Field& field) {
    const double speed = walk.gait.speed;
    if (speed <= 0.0)
        throw ConfigurationError(
            "walk.gait.speed is 0: the robot never reaches the ball; say with --seconds how long to look");
    const Route route = paper_route(field);
    const Eigen::Vector2d mark(-(0.5 * field.length - field.penalty_mark_distance), 0.0);
    double nearest = std::numeric_limits<double>::infinity();
    double distance = 0.0;
    for (double d = 0.0; d <= route.lead_in_length(); d += 0.001) {
        const double from_mark = (route.at(d).position() - mark).norm();
        if (from_mark < nearest) {
            nearest = from_mark;
            distance = d;
        }
    }
    const double ramp = speed / walk.gait.acceleration;
    const double ramp_distance = 0.5 * speed * ramp;
    return distance < ramp_distance ? std::sqrt(2.0 * distance / walk.gait.acceleration)
                                    : distance / speed + 0.5 * ramp;
}

LocalisationResult evaluate_localisation(const LocalisationOptions& options,
                                         const LocalisationProgress& progress) {
    LocalisationResult result;
    result.seed = options.seed;
    result.runs = options.runs;
    for (const LocalisationDetector& detector : options.detectors) result.detectors.push_back(detector.name);
    result.seconds = options.seconds > 0.0 ? options.seconds
                                           : walk_to_ball_seconds(options.simulation.walk, options.field);
    result.frames_per_second = options.frames_per_second;
    result.scene = options.scene;
    result.field = options.field;
    result.settings = settings_json(options);
    if (options.parts > 1) result.shard = std::to_string(options.part) + "/" + std::to_string(options.parts);

    std::vector<int> numbers;
    for (int run = options.part - 1; run < options.runs; run += options.parts) numbers.push_back(run);
    const int frames = static_cast<int>(std::floor(result.seconds * options.frames_per_second)) + 1;
    if (progress.expect) progress.expect(numbers.size() * static_cast<std::size_t>(frames));

    std::vector<std::optional<LocalisationRun>> runs(numbers.size());
    try {
        for_each_in_parallel(
            numbers.size(), options.jobs,
            [&](std::size_t, std::size_t i) { runs[i] = run_once(options, numbers[i], frames, progress); },
            progress.stop);
    } catch (const std::invalid_argument& error) {
        throw ConfigurationError(error.what());
    }
    for (auto& run : runs)
        if (run) result.done.push_back(std::move(*run));
    return result;
}

}  // namespace goalmouth
