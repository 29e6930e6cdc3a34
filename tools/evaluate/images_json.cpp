#include "tools/evaluate/images_report.h"
#include "tools/goalmouth/image_chain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <nlohmann/json.hpp>

namespace goalmouth {
namespace {

using nlohmann::ordered_json;

ordered_json point_json(const Eigen::Vector2d& p) {
    return {p.x(), p.y()};
}

const char* word(Verdict verdict) {
    switch (verdict) {
        case Verdict::found:
            return "found";
        case Verdict::ignored:
            return "ignored";
        case Verdict::wrong:
            return "wrong";
    }
    return "";
}

ordered_json score_json(const ImageScore& score) {
    ordered_json j = {{"pictures", score.pictures}, {"posts", score.posts},
                      {"found", score.found},       {"missed", score.missed()},
                      {"wrong", score.wrong},       {"ignored", score.ignored},
                      {"recall", score.recall()},   {"precision", score.precision()}};
    j["negatives"] = score.negatives;
    j["wrong_on_negatives"] = score.wrong_on_negatives;
    return j;
}

ordered_json width_json(const std::vector<WidthClass>& classes) {
    ordered_json all = ordered_json::array();
    for (const WidthClass& c : classes) {
        ordered_json one = {{"from_px", c.from}, {"to_px", c.to}, {"posts", c.posts}, {"found", c.found}};
        if (!std::isfinite(c.to)) one["to_px"] = nullptr;
        all.push_back(one);
    }
    return all;
}

constexpr double degree = std::numbers::pi / 180.0;

ordered_json errors_json(const std::optional<ErrorStatistics>& errors) {
    if (!errors) return nullptr;
    return {{"mean_px", errors->bias}, {"rms_px", errors->rmse}, {"median_abs_px", errors->median_abs}};
}

ordered_json edges_json(const std::vector<MeasuredPost>& posts) {
    ordered_json all = ordered_json::array();
    for (const MeasuredGroup& group : groups(posts)) {
        const EdgeSummary s = edge_summary(group.posts);
        ordered_json one = {{"of", group.name},
                            {"posts", s.posts},
                            {"left", errors_json(s.left)},
                            {"right", errors_json(s.right)},
                            {"width", errors_json(s.width)},
                            {"annotation_sigma_px", nullptr}};
        if (s.annotation_sigma) one["annotation_sigma_px"] = *s.annotation_sigma;
        all.push_back(one);
    }
    return all;
}

ordered_json distance_json(const DistanceSummary& s) {
    return {
        {"posts", s.posts},        {"without_distance", s.without},  {"rmse_m", s.errors.rmse},
        {"bias_m", s.errors.bias}, {"relative_rms", s.relative_rms}, {"median_relative", s.median_relative}};
}

/// Those of one detector, "": of the outlines.
ordered_json distances_json(const std::vector<DistanceGroup>& all_groups, const std::string& detector) {
    ordered_json all = ordered_json::array();
    for (const DistanceGroup& group : all_groups) {
        const auto whole = distance_summary(group.samples);
        if (!whole || group.detector != detector) continue;
        ordered_json one = {{"of", group.of}};
        one.update(distance_json(*whole));
        one["by_distance"] = ordered_json::array();
        for (const DistanceSummary& s : by_distance(group.samples)) {
            ordered_json step = {{"from_m", s.from}, {"to_m", s.to}};
            step.update(distance_json(s));
            one["by_distance"].push_back(step);
        }
        all.push_back(one);
    }
    return all;
}

ordered_json placement_json(const ImageSetResult& set, const std::string& detector) {
    const PlacementSummary s = placement_summary(set.of(detector));
    return {{"field", set.field.string()},
            {"posts", s.posts},
            {"unplaced", s.unplaced},
            {"direction_rms_deg", s.direction_rms / degree}};
}

ordered_json place_json(const RobotPlace& place) {
    return {{"x_m", place.feet.x},
            {"y_m", place.feet.y},
            {"heading_deg", place.feet.theta / degree},
            {"head_yaw_rad", place.head_yaw},
            {"head_pitch_rad", place.head_pitch}};
}

ordered_json heights_json(const std::array<std::optional<double>, 3>& errors) {
    ordered_json all = ordered_json::array();
    for (const auto& error : errors) all.push_back(error ? ordered_json(*error) : ordered_json(nullptr));
    return all;
}

ordered_json picture_json(const ScoredPicture& picture) {
    ordered_json j = {{"file", picture.annotated.name},
                      {"detector", picture.detector},
                      {"found", picture.found()},
                      {"missed", picture.missed()},
                      {"wrong", picture.wrong()}};
    if (picture.place) j["place"] = place_json(*picture.place);
    const std::vector<MeasuredPost> measured = measured_posts({&picture});
    j["posts"] = ordered_json::array();
    for (std::size_t i = 0; i < picture.truth.size(); ++i) {
        const ReferencePost& truth = picture.truth[i];
        ordered_json one = {{"left", {point_json(truth.left_top), point_json(truth.left_base)}},
                            {"right", {point_json(truth.right_top), point_json(truth.right_base)}},
                            {"found", picture.matching.found[i].has_value()},
                            {"edge_offsets_px", nullptr}};
        if (const auto detection = picture.matching.identified[i]) {
            const auto offsets = edge_offsets(truth, picture.result.posts[*detection]);
            if (std::isfinite(offsets[0]) && std::isfinite(offsets[1])) one["edge_offsets_px"] = offsets;
        }
        if (const auto& placed = picture.placed[i]) {
            one["goalpost"] = placed->goalpost;
            one["true_distance_m"] = placed->distance;
            one["direction_error_deg"] = placed->direction_error / degree;
        }
        for (const MeasuredPost& post : measured) {
            if (post.truth != i) continue;
            one["detection"] = post.detection;
            one["edge_errors_px"] = {{"left", heights_json(post.edges.left)},
                                     {"right", heights_json(post.edges.right)}};
        }
        j["posts"].push_back(one);
    }
    j["detections"] = ordered_json::array();
    for (std::size_t i = 0; i < picture.result.posts.size(); ++i) {
        const Post& post = picture.result.posts[i];
        ordered_json one = {{"left", {point_json(post.left_top), point_json(post.left_base)}},
                            {"right", {point_json(post.right_top), point_json(post.right_base)}},
                            {"verdict", word(picture.matching.verdicts[i])},
                            {"refined", post.has(post_flag::refined)},
                            {"distance_m", nullptr}};
        if (!post.has(post_flag::no_distance)) one["distance_m"] = post.distance_m;
        if (const auto& how = picture.result.refinements[i]; how && !how->reason.empty())
            one["not_refined_because"] = how->reason;
        j["detections"].push_back(one);
    }
    return j;
}

}  // namespace

bool ImagesResult::complete() const {
    return !sets.empty() &&
           std::all_of(sets.begin(), sets.end(), [](const ImageSetResult& set) { return set.complete; });
}

ordered_json images_json(const ImagesResult& result) {
    const ImagesOptions& options = result.options;
    ordered_json j = {{"what", "images"},
                      {"version", result.version},
                      {"command", result.command},
                      {"complete", result.complete()},
                      {"detectors", options.detectors},
                      {"rule",
                       {{"fraction", hand_marked_rule.fraction},
                        {"floor_px", hand_marked_rule.floor},
                        {"coverage", hand_marked_rule.coverage}}}};
    if (std::none_of(options.detectors.begin(), options.detectors.end(), takes_colours)) {
        j["colours"] = nullptr;
    } else if (options.colours.empty()) {
        j["colours"] = {{"folds", options.folds}, {"without_labels", options.without_labels}};
    } else {
        j["colours"] = {{"table", options.colours.string()}};
    }
    j["sets"] = ordered_json::array();
    j["pictures"] = ordered_json::array();
    for (const ImageSetResult& set : result.sets) {
        for (const std::string& detector : options.detectors) {
            ordered_json one = {{"set", set.set}, {"detector", detector}, {"camera", set.camera.string()}};
            one.update(score_json(set.score(detector)));
            one["by_width"] = width_json(by_width(set.of(detector)));
            const std::vector<MeasuredPost> measured = set.measured(detector);
            one["edges"] = edges_json(measured);
            if (set.goals) {
                one["placement"] = placement_json(set, detector);
                const std::vector<DistanceGroup> distances = set.distances(options.detectors);
                one["distances"] = distances_json(distances, detector);
                one["outline_distances"] = distances_json(distances, "");
            }
            j["sets"].push_back(one);
        }
        for (const ScoredPicture& picture : set.pictures) {
            ordered_json one = {{"set", set.set}};
            one.update(picture_json(picture));
            j["pictures"].push_back(one);
        }
    }
    return j;
}

}  // namespace goalmouth
