#include "core/imaging/colour_labels.h"

#include "core/imaging/colour_rules.h"
#include "core/imaging/colour_training.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

namespace goalmouth {

namespace {

constexpr double border_margin = 3.0;  // px at 640 px width: mixed pixels teach nothing

/// The outline moved inwards (negative: outwards) by `by` px on both sides and at both ends.
std::vector<cv::Point> moved_inwards(const PostOutline& post, double by) {
    const auto unit = [](cv::Point2d v) {
        const double length = std::hypot(v.x, v.y);
        return length > 0.0 ? v * (1.0 / length) : cv::Point2d(0.0, 0.0);
    };
    const cv::Point2d across_base = unit(post.base_right - post.base_left) * by;
    const cv::Point2d across_top = unit(post.top_right - post.top_left) * by;
    const cv::Point2d up = unit(post.top_left + post.top_right - post.base_left - post.base_right) * by;
    std::vector<cv::Point> polygon;
    for (const cv::Point2d& p : {post.base_left + across_base + up, post.base_right - across_base + up,
                                 post.top_right - across_top - up, post.top_left + across_top - up})
        polygon.emplace_back(cvRound(p.x), cvRound(p.y));
    return polygon;
}

double erosion_of(const PostOutline& post) {
    return std::max(1.5, post.width() / 6.0);
}

cv::Mat posts_mask(YuyvView image, std::span<const PostOutline> posts, bool eroded, double outwards = 0.0) {
    cv::Mat mask = cv::Mat::zeros(image.height, image.width, CV_8UC1);
    for (const PostOutline& post : posts)
        cv::fillConvexPoly(mask, moved_inwards(post, eroded ? erosion_of(post) : -outwards), cv::Scalar(255));
    return mask;
}

cv::Mat posts_mask(const LabelledScene& scene, bool eroded, double outwards = 0.0) {
    return posts_mask(scene.image.view(), scene.posts, eroded, outwards);
}

/// First row that is sure to show the pitch.
int first_pitch_row(const LabelledScene& scene) {
    if (scene.posts.empty()) return scene.image.height / 2;
    double lowest = 0.0;
    for (const PostOutline& post : scene.posts)
        lowest = std::max({lowest, post.base_left.y, post.base_right.y});
    return std::clamp(static_cast<int>(lowest) + 2, 0, scene.image.height);
}

/// Pixels of `like_goal` joined to one of the posts, directly or over a gap of a few pixels.
cv::Mat joined_to_posts(const cv::Mat& like_goal, const cv::Mat& posts, double scale) {
    cv::Mat together;
    cv::morphologyEx(like_goal | posts, together, cv::MORPH_CLOSE, disc(3.0 * scale));
    cv::Mat components;
    const int count = cv::connectedComponents(together, components, 8, CV_32S);
    std::vector<bool> touches(static_cast<std::size_t>(count), false);
    for (int y = 0; y < posts.rows; ++y)
        for (int x = 0; x < posts.cols; ++x)
            if (posts.at<std::uint8_t>(y, x))
                touches[static_cast<std::size_t>(components.at<int>(y, x))] = true;
    touches[0] = false;
    cv::Mat joined = cv::Mat::zeros(posts.size(), CV_8UC1);
    for (int y = 0; y < posts.rows; ++y)
        for (int x = 0; x < posts.cols; ++x)
            if (touches[static_cast<std::size_t>(components.at<int>(y, x))])
                joined.at<std::uint8_t>(y, x) = 255;
    return joined;
}

/// Lines by the colour known of them or, where none is, as what is pale.
cv::Mat line_mask(YuyvView image, const SceneColours& colours, const cv::Mat& like_field) {
    const double scale = image_scale(image.width);
    if (colours.line) {
        const cv::Mat like_line = mask_of(image, [&](Ycbcr p) { return colours.line->holds(p); });
        return brighter_than_field(image, like_field) & like_line;
    }
    cv::Mat luma = luma_of(image);
    const cv::Mat field_luma = field_luma_around(luma, like_field, scale);
    luma.convertTo(luma, CV_32F);
    const cv::Mat bright = (luma - field_luma) > 25.0;
    const double field_chroma = std::hypot(colours.field.cb - 128.0, colours.field.cr - 128.0);
    const cv::Mat pale = mask_of(image, [&](Ycbcr p) { return chroma_polar(p).chroma < 0.5 * field_chroma; });
    return bright & pale & ~like_field;
}

/// Balls by the colour known of them or, where none is, as what is orange.
cv::Mat ball_mask(YuyvView image, const SceneColours& colours) {
    if (colours.ball) {
        return mask_of(image, [&](Ycbcr p) {
            return colours.ball->holds(p) && !colours.field.holds(p) && !colours.goal.holds(p);
        });
    }
    const Ycbcr goal{128, static_cast<std::uint8_t>(colours.goal.cb),
                     static_cast<std::uint8_t>(colours.goal.cr)};
    const double goal_hue = chroma_polar(goal).hue;
    return mask_of(image, [&](Ycbcr p) {
        const ChromaPolar polar = chroma_polar(p);
        return polar.hue > 95.0 && polar.hue < goal_hue - 12.0 && polar.chroma > 40.0;
    });
}

}  // namespace

double PostOutline::width() const {
    const cv::Point2d v = base_right - base_left;
    return std::hypot(v.x, v.y);
}

std::vector<cv::Point> corners(const PostOutline& post) {
    return moved_inwards(post, 0.0);
}

std::vector<Ycbcr> pixels_in_posts(YuyvView image, std::span<const PostOutline> posts) {
    const cv::Mat inside = posts_mask(image, posts, true);
    std::vector<Ycbcr> pixels;
    for (int y = 0; y < inside.rows; ++y)
        for (int x = 0; x < inside.cols; ++x)
            if (inside.at<std::uint8_t>(y, x)) pixels.push_back(image.at(x, y));
    return pixels;
}

ChromaRegion find_field_colour(std::span<const LabelledScene> scenes) {
    ChromaHistogram histogram, all;
    for (const LabelledScene& scene : scenes) {
        const YuyvView image = scene.image.view();
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; x += 2) all.add(image.at(x, y));
        for (int y = first_pitch_row(scene); y < image.height; ++y) {
            for (int x = 0; x < image.width; x += 2) {
                const Ycbcr p = image.at(x, y);
                const ChromaPolar polar = chroma_polar(p);
                if (polar.hue >= 180.0 && polar.hue <= 290.0 && polar.chroma >= 10.0) histogram.add(p);
            }
        }
    }
    if (histogram.empty()) throw std::invalid_argument("no picture shows green where the field should be");
    return all.without_rivals(histogram.region_around_mode());
}

ChromaRegion find_goal_colour(std::span<const LabelledScene> scenes) {
    ChromaHistogram histogram;
    for (const LabelledScene& scene : scenes)
        for (const Ycbcr p : pixels_in_posts(scene.image.view(), scene.posts)) histogram.add(p);
    if (histogram.empty()) throw std::invalid_argument("no picture has a post marked in it");
    return histogram.shades_of_mode();
}

cv::Mat label_scene(const LabelledScene& scene, const SceneColours& colours) {
    const YuyvView image = scene.image.view();
    const double scale = image_scale(scene.image.width);
    const cv::Mat post_area = posts_mask(scene, false, border_margin * scale);
    const cv::Mat like_field = mask_of(image, [&](Ycbcr p) { return colours.field.holds(p); });
    cv::Mat like_goal =
        mask_of(image, [&](Ycbcr p) { return p.y >= colours.darkest_goal && colours.goal.holds(p); });
    like_goal.setTo(0, like_field);
    const cv::Mat pitch = pitch_mask(like_field, scale);
    cv::Mat well_inside;  // of the pitch
    cv::erode(pitch, well_inside, disc(border_margin * scale), {-1, -1}, 1, cv::BORDER_REPLICATE);
    well_inside.setTo(0, post_area);

    cv::Mat above;
    cv::dilate(pitch, above, disc(2.0 * border_margin * scale), {-1, -1}, 1, cv::BORDER_REPLICATE);
    above = ~above;
    cv::Mat goal_parts = joined_to_posts(like_goal, posts_mask(scene, false), scale) | post_area;
    cv::dilate(goal_parts, goal_parts, disc(border_margin * scale));

    cv::Mat labels(image.height, image.width, CV_8UC1, cv::Scalar(ColourTrainer::no_label));
    const auto label = [&](const cv::Mat& mask, Colour colour) {
        labels.setTo(static_cast<int>(colour), mask);
    };
    label(above & ~goal_parts, Colour::unclassified);
    cv::Mat field_core;
    cv::erode(like_field, field_core, disc(1.0 * scale));
    label(well_inside & field_core, Colour::field);
    label(well_inside & line_mask(image, colours, like_field), Colour::line);
    label(well_inside & ball_sized(ball_mask(image, colours) & well_inside, scale), Colour::ball);
    label(posts_mask(scene, true), Colour::goal);
    const cv::Rect whole(0, 0, image.width, image.height);
    for (const cv::Rect& box : scene.ignore) labels(box & whole).setTo(ColourTrainer::no_label);
    return labels;
}

cv::Mat label_scene(const LabelledScene& scene, const ChromaRegion& field, const ChromaRegion& goal) {
    return label_scene(scene, SceneColours{field, goal, {}, {}, 0.0});
}

GoalColourScore& GoalColourScore::operator+=(const GoalColourScore& other) {
    inside += other.inside;
    inside_goal += other.inside_goal;
    elsewhere += other.elsewhere;
    elsewhere_goal += other.elsewhere_goal;
    return *this;
}

GoalColourScore score_goal_colour(const LabelledScene& scene, const ColourTable& table) {
    return score_goal_colour(scene.image.view(), scene.posts, scene.ignore, table);
}

GoalColourScore score_goal_colour(YuyvView image, std::span<const PostOutline> posts,
                                  std::span<const cv::Rect> ignore, const ColourTable& table) {
    const cv::Mat inside = posts_mask(image, posts, true);
    cv::Mat near = posts_mask(image, posts, false, 2.0 * border_margin * image_scale(image.width));
    const cv::Rect whole(0, 0, image.width, image.height);
    for (const cv::Rect& box : ignore) near(box & whole).setTo(255);
    int first_row = 0;  // below the crossbar
    for (const PostOutline& post : posts)
        first_row = std::max(
            first_row, static_cast<int>(std::max(post.top_left.y, post.top_right.y) + 2.5 * post.width()));
    GoalColourScore score;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const bool is_goal = table.at(image.at(x, y)) == Colour::goal;
            if (inside.at<std::uint8_t>(y, x)) {
                ++score.inside;
                score.inside_goal += is_goal;
            } else if (y >= first_row && !near.at<std::uint8_t>(y, x)) {
                ++score.elsewhere;
                score.elsewhere_goal += is_goal;
            }
        }
    }
    return score;
}

}  // namespace goalmouth
