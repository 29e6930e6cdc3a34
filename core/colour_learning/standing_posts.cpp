#include "core/colour_learning/standing_posts.h"

#include "core/detection/ransac_detector.h"
#include "core/extraction/extraction.h"
#include "core/segmentation/segmentation.h"

#include <algorithm>
#include <numbers>

namespace goalmouth {

namespace {

/// False posts teach wrong colours, missed ones little: rules stricter than the paper's where it leaves room.
/// Lengths are for pictures 640 px wide.
RansacDetectorParameters strict_rules(double scale) {
    RansacDetectorParameters p;
    p.ransac.attempts = 200;
    p.ransac.inlier_distance = 3.0 * scale;
    p.pairing.least_aspect = 2.0;
    p.pairing.nearest = 0.0;
    p.pairing.farthest = 0.0;
    p.pairing.cut_margin = 6.0 * scale;
    p.pairing.largest_hole = 0.3;
    p.pairing.largest_lean = 0.6;
    return p;
}

constexpr std::uint32_t cut =
    post_flag::left_edge_missing | post_flag::right_edge_missing | post_flag::cut_left | post_flag::cut_right;

cv::Point2d point(const Eigen::Vector2d& v) {
    return {v.x(), v.y()};
}

/// A post is higher than the camera of the robots that play between them, so it ends above the horizon and
/// the field's border with it.
bool rises_above(const FieldBorder& border, const Post& post) {
    const Eigen::Vector2d top = 0.5 * (post.left_top + post.right_top);
    return !border.empty() && top.y() < border.y_at(top.x()) - post.width_px;
}

}  // namespace

std::vector<std::vector<PostOutline>> standing_posts(std::span<const YuyvImage> pictures,
                                                     const ColourTable& table, bool cut_ones) {
    constexpr double any_field_of_view = std::numbers::pi / 3.0;
    Segmenter segmenter(table);
    std::vector<std::vector<PostOutline>> found(pictures.size());
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const YuyvView image = pictures[i].view();
        const double scale = image_scale(image.width);
        ScanLineParameters lines;
        lines.row_spacing = lines.column_spacing = std::max(1, static_cast<int>(4.0 * scale));
        const Segments& segments = segmenter.segment(image, image_layout(image.width, image.height, lines));
        const FieldBorder border = find_border(segments, {});
        if (border.empty()) continue;
        const Candidates candidates = extract_candidates(segments, border, {});
        Random random = random_for_frame(0, "standing_posts", static_cast<std::int64_t>(i));
        const Intrinsics camera = from_horizontal_fov(image.width, image.height, any_field_of_view);
        for (const Post& post :
             detect_posts_by_ransac(candidates, camera, 0.1, strict_rules(scale), random)) {
            if (post.has(post_flag::fills_image) || (post.has(cut) && !cut_ones)) continue;
            if (!rises_above(border, post)) continue;
            found[i].push_back(
                {point(post.left_base), point(post.right_base), point(post.right_top), point(post.left_top)});
        }
    }
    return found;
}

}  // namespace goalmouth
