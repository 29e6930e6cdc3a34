#include "core/imaging/colour_labels.h"

#include "core/imaging/colour_rules.h"
#include "core/imaging/colour_training.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

namespace goalmouth {

namespace {

constexpr int chroma_cells = 64;
constexpr double region_threshold = 0.02;  // of the mode's frequency
constexpr double border_margin = 3.0;      // px at 640 px width: mixed pixels teach nothing

/// Lengths in this file are meant for images 640 px wide.
double image_scale(const YuyvImage& image) {
    return std::max(image.width / 640.0, 0.25);
}

int odd(double value) {
    return 2 * static_cast<int>(value / 2.0) + 1;
}

cv::Mat disc(double radius) {
    const int size = odd(2.0 * radius + 1.0);
    return cv::getStructuringElement(cv::MORPH_ELLIPSE, {size, size});
}

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

cv::Mat posts_mask(const LabelledScene& scene, bool eroded, double outwards = 0.0) {
    cv::Mat mask = cv::Mat::zeros(scene.image.height, scene.image.width, CV_8UC1);
    for (const PostOutline& post : scene.posts)
        cv::fillConvexPoly(mask, moved_inwards(post, eroded ? erosion_of(post) : -outwards), cv::Scalar(255));
    return mask;
}

/// First row that is sure to show the pitch.
int first_pitch_row(const LabelledScene& scene) {
    if (scene.posts.empty()) return scene.image.height / 2;
    double lowest = 0.0;
    for (const PostOutline& post : scene.posts)
        lowest = std::max({lowest, post.base_left.y, post.base_right.y});
    return std::clamp(static_cast<int>(lowest) + 2, 0, scene.image.height);
}

/// Cells joined to the mode of a smoothed chroma histogram that reach a share of its height.
ChromaRegion region_around_mode(cv::Mat histogram) {
    cv::GaussianBlur(histogram, histogram, {0, 0}, 1.0);
    double peak = 0.0;
    cv::Point mode;
    cv::minMaxLoc(histogram, nullptr, &peak, nullptr, &mode);
    cv::Mat above = histogram >= peak * region_threshold;
    cv::Mat components;
    cv::connectedComponents(above, components, 8, CV_32S);
    ChromaRegion region;
    region.cells = components == components.at<int>(mode);
    region.cr = mode.x * 4.0 + 2.0;
    region.cb = mode.y * 4.0 + 2.0;
    return region;
}

template <class Wanted>
cv::Mat mask_of(YuyvView image, Wanted wanted) {
    cv::Mat mask(image.height, image.width, CV_8UC1);
    for (int y = 0; y < image.height; ++y) {
        std::uint8_t* row = mask.ptr<std::uint8_t>(y);
        for (int x = 0; x < image.width; ++x) row[x] = wanted(image.at(x, y)) ? 255 : 0;
    }
    return mask;
}

cv::Mat luma_of(YuyvView image) {
    cv::Mat luma(image.height, image.width, CV_8UC1);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) luma.at<std::uint8_t>(y, x) = image.at(x, y).y;
    return luma;
}

/// Everything from the upper rim of the largest field-coloured area down, column by column.
cv::Mat pitch_mask(const cv::Mat& field_coloured, double scale) {
    cv::Mat joined;
    cv::morphologyEx(field_coloured, joined, cv::MORPH_OPEN, disc(1.5 * scale));
    cv::morphologyEx(joined, joined, cv::MORPH_CLOSE, disc(6.0 * scale));
    cv::Mat components, stats, centres;
    const int count = cv::connectedComponentsWithStats(joined, components, stats, centres, 8, CV_32S);
    cv::Mat pitch = cv::Mat::zeros(joined.size(), CV_8UC1);
    int largest = 0;
    for (int i = 1; i < count; ++i)
        if (largest == 0 || stats.at<int>(i, cv::CC_STAT_AREA) > stats.at<int>(largest, cv::CC_STAT_AREA))
            largest = i;
    if (largest == 0 || stats.at<int>(largest, cv::CC_STAT_AREA) < pitch.rows * pitch.cols / 50) return pitch;
    for (int x = 0; x < pitch.cols; ++x) {
        int y = 0;
        while (y < pitch.rows && components.at<int>(y, x) != largest) ++y;
        for (; y < pitch.rows; ++y) pitch.at<std::uint8_t>(y, x) = 255;
    }
    return pitch;
}

/// Local mean of the luma of field-coloured pixels.
cv::Mat field_luma_around(const cv::Mat& luma, const cv::Mat& field_coloured, double scale) {
    cv::Mat weight, weighted;
    field_coloured.convertTo(weight, CV_32F, 1.0 / 255.0);
    luma.convertTo(weighted, CV_32F);
    weighted = weighted.mul(weight);
    const cv::Size window(odd(60.0 * scale), odd(60.0 * scale));
    cv::boxFilter(weight, weight, CV_32F, window);
    cv::boxFilter(weighted, weighted, CV_32F, window);
    weight = cv::max(weight, 1e-6);
    return weighted / weight;
}

/// Keeps blobs of `mask` that are neither specks nor too large for a ball.
cv::Mat ball_sized(const cv::Mat& mask, double scale) {
    cv::Mat components, stats, centres;
    const int count = cv::connectedComponentsWithStats(mask, components, stats, centres, 8, CV_32S);
    cv::Mat kept = cv::Mat::zeros(mask.size(), CV_8UC1);
    for (int i = 1; i < count; ++i) {
        const int area = stats.at<int>(i, cv::CC_STAT_AREA);
        const double width = stats.at<int>(i, cv::CC_STAT_WIDTH);
        const double height = stats.at<int>(i, cv::CC_STAT_HEIGHT);
        if (area < 30.0 * scale * scale || area > 0.05 * mask.rows * mask.cols) continue;
        if (std::max(width, height) > 2.5 * std::min(width, height)) continue;
        kept.setTo(255, components == i);
    }
    return kept;
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

}  // namespace

double PostOutline::width() const {
    const cv::Point2d v = base_right - base_left;
    return std::hypot(v.x, v.y);
}

ChromaRegion find_field_colour(std::span<const LabelledScene> scenes) {
    cv::Mat histogram = cv::Mat::zeros(chroma_cells, chroma_cells, CV_32F);
    for (const LabelledScene& scene : scenes) {
        const YuyvView image = scene.image.view();
        for (int y = first_pitch_row(scene); y < image.height; ++y) {
            for (int x = 0; x < image.width; x += 2) {
                const Ycbcr p = image.at(x, y);
                const ChromaPolar polar = chroma_polar(p);
                if (polar.hue >= 180.0 && polar.hue <= 290.0 && polar.chroma >= 10.0)
                    histogram.at<float>(p.cb >> 2, p.cr >> 2) += 1.0F;
            }
        }
    }
    if (cv::countNonZero(histogram) == 0)
        throw std::invalid_argument("no picture shows green where the field should be");
    return region_around_mode(histogram);
}

ChromaRegion find_goal_colour(std::span<const LabelledScene> scenes) {
    cv::Mat histogram = cv::Mat::zeros(chroma_cells, chroma_cells, CV_32F);
    for (const LabelledScene& scene : scenes) {
        const cv::Mat inside = posts_mask(scene, true);
        for (int y = 0; y < inside.rows; ++y)
            for (int x = 0; x < inside.cols; ++x)
                if (inside.at<std::uint8_t>(y, x)) {
                    const Ycbcr p = scene.image.view().at(x, y);
                    histogram.at<float>(p.cb >> 2, p.cr >> 2) += 1.0F;
                }
    }
    if (cv::countNonZero(histogram) == 0) throw std::invalid_argument("no picture has a post marked in it");
    return region_around_mode(histogram);
}

cv::Mat label_scene(const LabelledScene& scene, const ChromaRegion& field, const ChromaRegion& goal) {
    const YuyvView image = scene.image.view();
    const double scale = image_scale(scene.image);
    const cv::Mat post_area = posts_mask(scene, false, border_margin * scale);
    const cv::Mat like_field = mask_of(image, [&](Ycbcr p) { return field.holds(p); });
    cv::Mat like_goal = mask_of(image, [&](Ycbcr p) { return goal.holds(p); });
    like_goal.setTo(0, like_field);
    const cv::Mat pitch = pitch_mask(like_field, scale);
    cv::Mat well_inside;  // of the pitch
    cv::erode(pitch, well_inside, disc(border_margin * scale), {-1, -1}, 1, cv::BORDER_REPLICATE);
    well_inside.setTo(0, post_area);

    cv::Mat luma = luma_of(image);
    luma.convertTo(luma, CV_32F);
    const cv::Mat bright = (luma - field_luma_around(luma_of(image), like_field, scale)) > 25.0;
    const double field_chroma = std::hypot(field.cb - 128.0, field.cr - 128.0);
    const double goal_hue =
        chroma_polar({128, static_cast<std::uint8_t>(goal.cb), static_cast<std::uint8_t>(goal.cr)}).hue;
    const cv::Mat pale = mask_of(image, [&](Ycbcr p) { return chroma_polar(p).chroma < 0.5 * field_chroma; });
    const cv::Mat orange = mask_of(image, [&](Ycbcr p) {
        const ChromaPolar polar = chroma_polar(p);
        return polar.hue > 95.0 && polar.hue < goal_hue - 12.0 && polar.chroma > 40.0;
    });

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
    label(well_inside & bright & pale & ~like_field, Colour::line);
    label(well_inside & ball_sized(orange & well_inside, scale), Colour::ball);
    label(posts_mask(scene, true), Colour::goal);
    const cv::Rect whole(0, 0, image.width, image.height);
    for (const cv::Rect& box : scene.ignore) labels(box & whole).setTo(ColourTrainer::no_label);
    return labels;
}

GoalColourScore& GoalColourScore::operator+=(const GoalColourScore& other) {
    inside += other.inside;
    inside_goal += other.inside_goal;
    elsewhere += other.elsewhere;
    elsewhere_goal += other.elsewhere_goal;
    return *this;
}

GoalColourScore score_goal_colour(const LabelledScene& scene, const ColourTable& table) {
    const YuyvView image = scene.image.view();
    const cv::Mat inside = posts_mask(scene, true);
    cv::Mat near = posts_mask(scene, false, 2.0 * border_margin * image_scale(scene.image));
    const cv::Rect whole(0, 0, image.width, image.height);
    for (const cv::Rect& box : scene.ignore) near(box & whole).setTo(255);
    int first_row = 0;  // below the crossbar
    for (const PostOutline& post : scene.posts)
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
