#include "tools/evaluate/graph_settings.h"
#include "tools/evaluate/images_report.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

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

ordered_json picture_json(const ScoredPicture& picture) {
    ordered_json j = {{"file", picture.annotated.name},
                      {"detector", picture.detector},
                      {"found", picture.found()},
                      {"missed", picture.missed()},
                      {"wrong", picture.wrong()}};
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
        j["posts"].push_back(one);
    }
    j["detections"] = ordered_json::array();
    for (std::size_t i = 0; i < picture.result.posts.size(); ++i) {
        const Post& post = picture.result.posts[i];
        ordered_json one = {{"left", {point_json(post.left_top), point_json(post.left_base)}},
                            {"right", {point_json(post.right_top), point_json(post.right_base)}},
                            {"verdict", word(picture.matching.verdicts[i])}};
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
    if (options.colours.empty()) {
        j["colours"] = {{"folds", options.folds}};
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

std::string images_text(const ImagesResult& result) {
    std::size_t widest = 4;
    for (const ImageSetResult& set : result.sets) widest = std::max(widest, set.set.size());
    std::string text =
        fmt::format("{:<{}}  {:<12} {:>5} {:>6} {:>7} {:>6} {:>8} {:>10} {:>13}\n", "set", widest, "detector",
                    "posts", "found", "missed", "wrong", "recall", "precision", "on negatives");
    for (const ImageSetResult& set : result.sets) {
        for (const std::string& detector : result.options.detectors) {
            const ImageScore s = set.score(detector);
            text +=
                fmt::format("{:<{}}  {:<12} {:>5} {:>6} {:>7} {:>6} {:>6.1f} % {:>8.1f} % {:>6} in {:>3}\n",
                            set.set, widest, graph_name(detector), s.posts, s.found, s.missed(), s.wrong,
                            100.0 * s.recall(), 100.0 * s.precision(), s.wrong_on_negatives, s.negatives);
        }
    }
    return text;
}

}  // namespace goalmouth
