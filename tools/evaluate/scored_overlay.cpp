#include "tools/evaluate/scored_overlay.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace goalmouth {
namespace {

const cv::Scalar shade(0, 0, 0);

// Lines in a picture 640 px wide [px]: they must be seen where it is shown at half its size.
constexpr double truth_width = 2.0;
constexpr double missed_width = 3.0;
constexpr double post_width = 3.0;

constexpr int fraction_bits = 4;

cv::Point fixed(const Eigen::Vector2d& p) {
    const auto coordinate = [](double v) {
        return static_cast<int>(std::lround(std::clamp(v, -1e5, 1e5) * (1 << fraction_bits)));
    };
    return {coordinate(p.x()), coordinate(p.y())};
}

struct Pen {
    cv::Scalar colour;
    double width = 1.0;  // px, in a picture 640 px wide
    bool dashed = false;
};

void draw_line(cv::Mat& picture, const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Pen& pen) {
    const double scale = std::max(1.0, picture.cols / 640.0);
    const double dash = 6.0 * scale;
    const double length = std::max(1e-9, (b - a).norm());
    const double step = pen.dashed && length < 1e5 ? 2.0 * dash : length;
    const double drawn = pen.dashed ? dash : length;
    for (const bool under : {true, false}) {
        const int width =
            std::max(1, static_cast<int>(std::lround((under ? pen.width + 2.0 : pen.width) * scale)));
        for (double at = 0.0; at < length; at += step)
            cv::line(picture, fixed(a + (b - a) * at / length),
                     fixed(a + (b - a) * std::min(length, at + drawn) / length), under ? shade : pen.colour,
                     width, cv::LINE_AA, fraction_bits);
    }
}

template <class Outline>
void draw_outline(cv::Mat& picture, const Outline& o, const Pen& pen) {
    draw_line(picture, o.left_top, o.left_base, pen);
    draw_line(picture, o.right_top, o.right_base, pen);
    draw_line(picture, o.left_base, o.right_base, pen);
    draw_line(picture, o.left_top, o.right_top, pen);
}

}  // namespace

void draw_scored_posts(cv::Mat& picture, std::span<const ReferencePost> truth, std::span<const Post> posts,
                       const PostMatching& matching) {
    using namespace scored_colour;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        if (!truth[i].counts)
            draw_outline(picture, truth[i], {left_out, truth_width, true});
        else if (matching.found[i])
            draw_outline(picture, truth[i], {found_truth, truth_width});
        else
            draw_outline(picture, truth[i], {missed_truth, missed_width});
    }
    for (std::size_t i = 0; i < posts.size(); ++i) {
        const Verdict verdict = matching.verdicts[i];
        draw_outline(picture, posts[i],
                     {verdict == Verdict::found     ? right_post
                      : verdict == Verdict::ignored ? left_out
                                                    : wrong_post,
                      post_width});
    }
}

}  // namespace goalmouth
