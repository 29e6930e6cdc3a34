#include "tools/evaluate/images_score.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace goalmouth {
namespace {

/// Fixed beforehand, by what a 10 cm post measures at 640 px: 3.5 m, 2.3 m, 1.7 m and 1.2 m away.
constexpr std::array<double, 4> class_borders{16.0, 24.0, 32.0, 48.0};

Eigen::Vector2d at_row(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double row) {
    if (a.y() == b.y()) return a;
    return a + (b - a) * (row - a.y()) / (b.y() - a.y());
}

void clip(Eigen::Vector2d& top, Eigen::Vector2d& base, double last_row) {
    const Eigen::Vector2d from = at_row(top, base, std::clamp(top.y(), 0.0, last_row));
    base = at_row(top, base, std::clamp(base.y(), 0.0, last_row));
    top = from;
}

Eigen::Vector2d vector(const cv::Point2d& p) {
    return {p.x, p.y};
}

}  // namespace

ReferencePost reference_post(const PostOutline& outline, int height) {
    ReferencePost post{vector(outline.top_left), vector(outline.base_left), vector(outline.top_right),
                       vector(outline.base_right)};
    const double last_row = std::max(0, height - 1);
    clip(post.left_top, post.left_base, last_row);
    clip(post.right_top, post.right_base, last_row);
    return post;
}

ScoredPicture score_picture(const AnnotatedImage& annotated, const std::string& detector, ImageResult result,
                            int height, const MatchingRule& rule) {
    ScoredPicture picture{annotated, detector, {}, std::move(result), {}};
    for (const PostOutline& outline : annotated.posts)
        picture.truth.push_back(reference_post(outline, height));
    std::vector<Eigen::AlignedBox2d> ignore;
    for (const cv::Rect& box : annotated.ignore) {
        ignore.emplace_back(Eigen::Vector2d(box.x, box.y),
                            Eigen::Vector2d(box.x + box.width, box.y + box.height));
    }
    picture.matching = match_posts(picture.truth, picture.result.posts, rule, ignore);
    picture.placed.resize(picture.truth.size());
    return picture;
}

void place_picture(ScoredPicture& picture, const RobotPlace& place, const Field& field) {
    picture.place = place;
    picture.placed = place_posts(picture.truth, picture.result.camera, place, field);
}

double ImageScore::recall() const {
    return posts > 0 ? static_cast<double>(found) / posts : 1.0;
}

double ImageScore::precision() const {
    return found + wrong > 0 ? static_cast<double>(found) / (found + wrong) : 1.0;
}

ImageScore& ImageScore::operator+=(const ScoredPicture& picture) {
    ++pictures;
    posts += static_cast<int>(picture.truth.size());
    found += picture.found();
    wrong += picture.wrong();
    ignored += static_cast<int>(
        std::count(picture.matching.verdicts.begin(), picture.matching.verdicts.end(), Verdict::ignored));
    if (picture.truth.empty()) {
        ++negatives;
        wrong_on_negatives += picture.wrong();
    }
    return *this;
}

std::vector<WidthClass> by_width(const std::vector<const ScoredPicture*>& pictures) {
    std::vector<WidthClass> classes(class_borders.size() + 1);
    for (std::size_t i = 0; i < class_borders.size(); ++i)
        classes[i].to = classes[i + 1].from = class_borders[i];
    for (const ScoredPicture* picture : pictures) {
        for (std::size_t i = 0; i < picture->annotated.posts.size(); ++i) {
            const PostOutline& post = picture->annotated.posts[i];
            const double width = std::abs(post.base_right.x - post.base_left.x);
            const auto place = std::upper_bound(class_borders.begin(), class_borders.end(), width);
            WidthClass& one = classes[static_cast<std::size_t>(place - class_borders.begin())];
            ++one.posts;
            if (picture->matching.found[i]) ++one.found;
        }
    }
    return classes;
}

}  // namespace goalmouth
