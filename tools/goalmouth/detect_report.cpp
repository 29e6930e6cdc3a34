#include "tools/goalmouth/detect_report.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace goalmouth {
namespace {

using Json = nlohmann::ordered_json;

Json point(const Eigen::Vector2d& p) {
    return Json::array({p.x(), p.y()});
}

const char* side_name(PostSide side) {
    switch (side) {
        case PostSide::left:
            return "left";
        case PostSide::right:
            return "right";
        default:
            return "unknown";
    }
}

std::vector<std::string> flag_names(const Post& post) {
    static const std::array<std::pair<std::uint32_t, const char*>, 9> names{{
        {post_flag::left_edge_missing, "left_edge_missing"},
        {post_flag::right_edge_missing, "right_edge_missing"},
        {post_flag::cut_top, "cut_top"},
        {post_flag::cut_bottom, "cut_bottom"},
        {post_flag::cut_left, "cut_left"},
        {post_flag::cut_right, "cut_right"},
        {post_flag::fills_image, "fills_image"},
        {post_flag::no_distance, "no_distance"},
        {post_flag::refined, "refined"},
    }};
    std::vector<std::string> found;
    for (const auto& [flag, name] : names) {
        if (post.has(flag)) found.emplace_back(name);
    }
    return found;
}

const char* name_of(DistanceCueKind kind) {
    switch (kind) {
        case DistanceCueKind::width:
            return "width";
        case DistanceCueKind::base:
            return "base";
        case DistanceCueKind::crossbar:
            return "crossbar";
        default:
            return "goal";
    }
}

Json refinement_report(const RefinedPost& how) {
    Json j;
    j["quality"] = how.quality;
    j["reason"] = how.reason;
    j["rows"] = how.rows;
    j["rows_left"] = how.left ? how.left->rows : 0;
    j["rows_right"] = how.right ? how.right->rows : 0;
    j["base"] = how.base ? point(*how.base) : Json(nullptr);
    j["top"] = how.top ? point(*how.top) : Json(nullptr);
    j["cues"] = Json::array();
    for (const DistanceCue& cue : how.cues)
        j["cues"].push_back(
            {{"cue", name_of(cue.kind)}, {"distance_m", cue.distance}, {"sigma_m", cue.sigma}});
    return j;
}

Json post_report(const Post& post, const std::string& detector, const std::optional<RefinedPost>& how) {
    Json j;
    j["left"] = Json::array({point(post.left_top), point(post.left_base)});
    j["right"] = Json::array({point(post.right_top), point(post.right_base)});
    const bool has_distance = !post.has(post_flag::no_distance);
    j["distance_m"] = has_distance ? Json(post.distance_m) : Json(nullptr);
    j["sigma_m"] = has_distance ? Json(std::sqrt(post.covariance(0, 0))) : Json(nullptr);
    j["bearing_rad"] = post.bearing_rad;
    j["bearing_sigma_rad"] = std::sqrt(post.covariance(1, 1));
    j["refined"] = post.has(post_flag::refined);
    j["width_px"] = post.width_px;
    j["side"] = side_name(post.side);
    j["flags"] = flag_names(post);
    j["covariance"] = Json::array({Json::array({post.covariance(0, 0), post.covariance(0, 1)}),
                                   Json::array({post.covariance(1, 0), post.covariance(1, 1)})});
    j["support"] = Json::array({post.support_left, post.support_right});
    j["detector"] = detector;
    if (how) j["refinement"] = refinement_report(*how);
    return j;
}

}  // namespace

nlohmann::ordered_json image_report(const std::string& file, const ImageResult& result) {
    Json j;
    j["file"] = file;
    j["width"] = result.camera.width;
    j["height"] = result.camera.height;
    j["posts"] = Json::array();
    for (std::size_t i = 0; i < result.posts.size(); ++i)
        j["posts"].push_back(post_report(result.posts[i], result.detectors[i], result.refinements[i]));
    j["border"] = Json::array();
    for (const auto& p : result.border.hull) j["border"].push_back(point(p));
    j["milliseconds"] = Json::object();
    for (const auto& [stage, spent] : result.milliseconds) j["milliseconds"][stage] = spent;
    return j;
}

std::string image_summary(const std::string& file, const ImageResult& result) {
    std::string text = file + ": " + std::to_string(result.posts.size()) +
                       (result.posts.size() == 1 ? " post\n" : " posts\n");
    for (std::size_t i = 0; i < result.posts.size(); ++i) {
        const Post& post = result.posts[i];
        char line[200];
        std::snprintf(line, sizeof line, "    %-7s x %6.1f … %6.1f  %5.1f px wide  bearing %+6.1f°  ",
                      side_name(post.side), post.left_base.x(), post.right_base.x(), post.width_px,
                      post.bearing_rad * 180.0 / std::numbers::pi);
        text += line;
        if (post.has(post_flag::no_distance)) {
            text += "no distance";
        } else {
            std::snprintf(line, sizeof line, post.has(post_flag::refined) ? "%.3f m ± %.4f" : "%.2f m ± %.2f",
                          post.distance_m, std::sqrt(post.covariance(0, 0)));
            text += line;
        }
        for (const auto& flag : flag_names(post)) text += "  " + flag;
        const std::optional<RefinedPost>& how = result.refinements[i];
        if (how && !how->reason.empty()) text += "  not refined: " + how->reason;
        text += '\n';
    }
    return text;
}

}  // namespace goalmouth
