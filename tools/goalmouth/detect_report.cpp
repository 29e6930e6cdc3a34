#include "tools/goalmouth/detect_report.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>
#include <vector>

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
    static const std::array<std::pair<std::uint32_t, const char*>, 8> names{{
        {post_flag::left_edge_missing, "left_edge_missing"},
        {post_flag::right_edge_missing, "right_edge_missing"},
        {post_flag::cut_top, "cut_top"},
        {post_flag::cut_bottom, "cut_bottom"},
        {post_flag::cut_left, "cut_left"},
        {post_flag::cut_right, "cut_right"},
        {post_flag::fills_image, "fills_image"},
        {post_flag::no_distance, "no_distance"},
    }};
    std::vector<std::string> found;
    for (const auto& [flag, name] : names) {
        if (post.has(flag)) found.emplace_back(name);
    }
    return found;
}

Json post_report(const Post& post, const std::string& detector) {
    Json j;
    j["left"] = Json::array({point(post.left_top), point(post.left_base)});
    j["right"] = Json::array({point(post.right_top), point(post.right_base)});
    j["distance_m"] = post.has(post_flag::no_distance) ? Json(nullptr) : Json(post.distance_m);
    j["bearing_rad"] = post.bearing_rad;
    j["width_px"] = post.width_px;
    j["side"] = side_name(post.side);
    j["flags"] = flag_names(post);
    j["covariance"] = Json::array({Json::array({post.covariance(0, 0), post.covariance(0, 1)}),
                                   Json::array({post.covariance(1, 0), post.covariance(1, 1)})});
    j["support"] = Json::array({post.support_left, post.support_right});
    j["detector"] = detector;
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
        j["posts"].push_back(post_report(result.posts[i], result.detectors[i]));
    j["border"] = Json::array();
    for (const auto& p : result.border.hull) j["border"].push_back(point(p));
    j["milliseconds"] = Json::object();
    for (const auto& [stage, spent] : result.milliseconds) j["milliseconds"][stage] = spent;
    return j;
}

std::string image_summary(const std::string& file, const ImageResult& result) {
    std::string text = file + ": " + std::to_string(result.posts.size()) +
                       (result.posts.size() == 1 ? " post\n" : " posts\n");
    for (const Post& post : result.posts) {
        char line[200];
        std::snprintf(line, sizeof line, "    %-7s x %6.1f … %6.1f  %5.1f px wide  bearing %+6.1f°  ",
                      side_name(post.side), post.left_base.x(), post.right_base.x(), post.width_px,
                      post.bearing_rad * 180.0 / std::numbers::pi);
        text += line;
        if (post.has(post_flag::no_distance)) {
            text += "no distance";
        } else {
            std::snprintf(line, sizeof line, "%.2f m ± %.2f", post.distance_m,
                          std::sqrt(post.covariance(0, 0)));
            text += line;
        }
        for (const auto& flag : flag_names(post)) text += "  " + flag;
        text += '\n';
    }
    return text;
}

}  // namespace goalmouth
