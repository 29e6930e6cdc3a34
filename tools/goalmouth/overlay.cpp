#include "tools/goalmouth/overlay.h"

#include "core/imaging/colour_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include <opencv2/imgproc.hpp>

namespace goalmouth {
namespace {

const cv::Scalar border_colour(255, 120, 0);
const cv::Scalar left_colour(255, 255, 0);
const cv::Scalar right_colour(255, 0, 255);
const cv::Scalar post_colour(0, 0, 255);
const cv::Scalar refined_colour(255, 255, 255);
const cv::Scalar shade(0, 0, 0);

/// 1 for a picture 640 px wide.
double scale_of(const cv::Mat& picture) {
    return std::max(1.0, picture.cols / 640.0);
}

int strokes(const cv::Mat& picture, double width) {
    return std::max(1, static_cast<int>(std::lround(width * scale_of(picture))));
}

/// Fixed-point coordinates for OpenCV's sub-pixel drawing.
constexpr int shift_bits = 4;
cv::Point fixed(const Eigen::Vector2d& p) {
    const auto coordinate = [](double v) {
        constexpr double limit = 1e6;
        return static_cast<int>(std::lround(std::clamp(v, -limit, limit) * (1 << shift_bits)));
    };
    return {coordinate(p.x()), coordinate(p.y())};
}

void line(cv::Mat& picture, const Eigen::Vector2d& a, const Eigen::Vector2d& b, const cv::Scalar& colour,
          int width) {
    cv::line(picture, fixed(a), fixed(b), colour, width, cv::LINE_AA, shift_bits);
}

void dashed(cv::Mat& picture, const Eigen::Vector2d& a, const Eigen::Vector2d& b, const cv::Scalar& colour,
            int width) {
    const double dash = 8.0 * scale_of(picture);
    const double length = (b - a).norm();
    if (length > 1e5) return;
    for (double at = 0.0; at < length; at += 2.0 * dash) {
        line(picture, a + (b - a) * at / length, a + (b - a) * std::min(length, at + dash) / length, colour,
             width);
    }
}

void dot(cv::Mat& picture, const Eigen::Vector2d& p, const cv::Scalar& colour) {
    cv::circle(picture, fixed(p), static_cast<int>(1.5 * scale_of(picture) * (1 << shift_bits)), colour,
               cv::FILLED, cv::LINE_AA, shift_bits);
}

/// Text with a dark box behind it, moved to stay inside the picture; `centre` is the middle of its upper
/// side.
void label(cv::Mat& picture, const Eigen::Vector2d& centre, const std::string& text) {
    const double size = 0.5 * scale_of(picture);
    const int width = strokes(picture, 1.0);
    int below = 0;
    const cv::Size box = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, size, width, &below);
    const int margin = strokes(picture, 3.0);
    const int x = std::clamp(static_cast<int>(centre.x()) - box.width / 2, margin,
                             std::max(margin, picture.cols - box.width - margin));
    const int y = std::clamp(static_cast<int>(centre.y()) + box.height + margin, box.height + margin,
                             std::max(box.height + margin, picture.rows - below - margin));
    cv::rectangle(picture, {x - margin, y - box.height - margin},
                  {x + box.width + margin, y + below + margin}, shade, cv::FILLED);
    cv::putText(picture, text, {x, y}, cv::FONT_HERSHEY_SIMPLEX, size, {255, 255, 255}, width, cv::LINE_AA);
}

std::string text_of(const Post& post) {
    std::string text = post.side == PostSide::left ? "L " : post.side == PostSide::right ? "R " : "";
    if (post.has(post_flag::no_distance)) return text + "cut";
    char distance[48];
    if (post.has(post_flag::refined)) {
        std::snprintf(distance, sizeof distance, "%.3f m +-%.1f mm", post.distance_m,
                      1000.0 * std::sqrt(post.covariance(0, 0)));
    } else {
        std::snprintf(distance, sizeof distance, "%.2f m", post.distance_m);
    }
    return text + distance;
}

}  // namespace

void draw_segments(cv::Mat& picture, const Segments& segments) {
    picture.setTo(cv::Scalar::all(0));
    // Rows alone cover the picture; columns are the same pixels again.
    std::vector<const ScanLine*> rows;
    for (const ScanLine& each : segments.lines)
        if (each.orientation == Orientation::horizontal) rows.push_back(&each);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const int y = rows[i]->position;
        const int next = i + 1 < rows.size() ? rows[i + 1]->position : picture.rows;
        const int height = std::max(1, next - y - 1);
        for (int k = 0; k < rows[i]->count; ++k) {
            const Segment& s = segments.segments[static_cast<std::size_t>(rows[i]->first + k)];
            const cv::Rect area(s.start, y, s.length(), height);
            picture(area & cv::Rect(0, 0, picture.cols, picture.rows)).setTo(display_colour(s.colour));
        }
    }
}

void draw_border(cv::Mat& picture, const FieldBorder& border) {
    for (std::size_t i = 1; i < border.hull.size(); ++i) {
        line(picture, border.hull[i - 1], border.hull[i], border_colour, strokes(picture, 1.5));
    }
    for (const auto& p : border.points) dot(picture, p, border_colour);
}

void draw_candidates(cv::Mat& picture, const Candidates& candidates) {
    cv::Mat faint = picture.clone();
    for (const CandidateSegment& s : candidates.segments) {
        const bool row = s.orientation == Orientation::horizontal;
        const Eigen::Vector2d a = row ? Eigen::Vector2d(s.start, s.line) : Eigen::Vector2d(s.line, s.start);
        const Eigen::Vector2d b = row ? Eigen::Vector2d(s.end, s.line) : Eigen::Vector2d(s.line, s.end);
        line(faint, a, b, {0, 128, 255}, 1);
    }
    cv::addWeighted(faint, 0.5, picture, 0.5, 0.0, picture);
    for (const auto& p : candidates.left_edges) dot(picture, p, left_colour);
    for (const auto& p : candidates.right_edges) dot(picture, p, right_colour);
}

void draw_posts(cv::Mat& picture, const std::vector<Post>& posts) {
    for (const Post& post : posts) {
        const bool refined = post.has(post_flag::refined);
        for (const bool outline : {true, false}) {
            // A thick line hides what it lies on to a fraction of a pixel.
            if (outline && refined) continue;
            const cv::Scalar& colour = outline ? shade : refined ? refined_colour : post_colour;
            const int width = refined ? 1 : strokes(picture, outline ? 3.0 : 1.0);
            const auto edge = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b, bool seen) {
                seen ? line(picture, a, b, colour, width) : dashed(picture, a, b, colour, width);
            };
            edge(post.left_top, post.left_base, !post.has(post_flag::left_edge_missing));
            edge(post.right_top, post.right_base, !post.has(post_flag::right_edge_missing));
            edge(post.left_top, post.right_top, !post.has(post_flag::cut_top));
            edge(post.left_base, post.right_base, !post.has(post_flag::cut_bottom));
        }
    }
    for (const Post& post : posts) {
        label(picture,
              0.5 * (post.left_base + post.right_base) + Eigen::Vector2d(0.0, 6.0 * scale_of(picture)),
              text_of(post));
    }
}

}  // namespace goalmouth
