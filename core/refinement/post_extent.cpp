#include "core/refinement/post_extent.h"

#include "core/refinement/axis_slope.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {
namespace {

class Follower {
  public:
    Follower(YuyvView image, const PostSilhouette& post, const PostColour& colour, const Intrinsics& camera,
             const RoughOutline& outline)
        : image_(image),
          colour_(colour),
          rays_(camera),
          left_plane_(post.plane(OutlineSide::left)),
          right_plane_(post.plane(OutlineSide::right)),
          outline_(outline) {}

    /// Whether a row's middle has the post's colour; `apart`: and something beside it has not.
    bool shows(int row, bool apart) {
        const double left = clamped(rays_.crossing(left_plane_, outline_.left(row), row).x);
        const double right = clamped(rays_.crossing(right_plane_, outline_.right(row), row).x);
        if (!(right - left > 1.0)) return false;
        const double inset = 0.3 * (right - left);
        const int first = PairRow::pair_at(left + inset);
        const int last = PairRow::pair_at(right - inset);
        const int step = std::max(1, (last - first) / 4);
        const PairRow pairs(image_.row(row), image_.width / 2, colour_.response);
        PairColour sum = PairColour::Zero();
        int count = 0;
        for (int pair = first; pair <= std::max(first, last); pair += step) {
            if (!inside(pair)) continue;
            sum += pairs[pair];
            ++count;
        }
        if (count == 0) return false;
        const float unlike = alike_ / static_cast<float>(count) + slack_;
        if (colour_.difference(sum / static_cast<float>(count)) > unlike * colour_.spread) return false;
        if (!apart) return true;
        constexpr double beside = 5.0;  // px
        return differs(row, left - beside) || differs(row, right + beside);
    }

  private:
    static constexpr float alike_ = 14.0F;  // eᵀMe of a pair of the post's colour, at most
    static constexpr float slack_ = 6.0F;   // of a mean of many

    double clamped(double x) const { return std::clamp(x, -1.0, static_cast<double>(image_.width)); }
    bool inside(int pair) const { return pair >= 0 && 2 * pair + 1 < image_.width; }
    bool differs(int row, double x) const {
        const int pair = PairRow::pair_at(x);
        return inside(pair) &&
               colour_.difference(PairRow(image_.row(row), image_.width / 2, colour_.response)[pair]) >
                   2.0F * alike_ * colour_.spread;
    }

    YuyvView image_;
    const PostColour& colour_;
    PixelRays rays_;
    Eigen::Vector3d left_plane_, right_plane_;
    const RoughOutline& outline_;
};

/// The last row that shows the post on the way from `start` by `step`, once it is lost for `patience` rows.
int follow(Follower& follower, int start, int step, int height, int patience) {
    int last = start;
    int missed = 0;
    for (int row = start + step; row >= 0 && row < height; row += step) {
        if (follower.shows(row, true)) {
            last = row;
            missed = 0;
        } else if (++missed > patience) {
            break;
        }
    }
    return last;
}

/// The first row on the way from `start` to `end` that shows the post, and the next two as well.
int first_shown(Follower& follower, int start, int end) {
    const int step = end < start ? -1 : 1;
    int run = 0;
    for (int row = start; row != end; row += step) {
        run = follower.shows(row, false) ? run + 1 : 0;
        if (run == 3) return row - 2 * step;
    }
    return end;
}

}  // namespace

PostExtent find_extent(YuyvView image, const PostSilhouette& post, const PostColour& colour,
                       const Intrinsics& camera, const RoughOutline& outline) {
    Follower follower(image, post, colour, camera, outline);
    PostExtent extent;
    const int length = outline.last_row - outline.first_row + 1;
    const int patience = std::max(3, length / 25);
    const int middle = (outline.first_row + outline.last_row) / 2;
    int first = first_shown(follower, outline.first_row, middle);
    int last = first_shown(follower, outline.last_row, middle);
    if (first == outline.first_row) first = follow(follower, first, -1, image.height, patience);
    if (last == outline.last_row) last = follow(follower, last, 1, image.height, patience);
    if (last - first < 3) return extent;
    constexpr int border = 2;
    extent.first_row = first;
    extent.last_row = last;
    extent.top_seen = first >= border;
    extent.base_seen = last < image.height - border;

    extent.first_edge_row = first;
    extent.last_edge_row = last;
    const double shorter = 1.0 - std::sin(post.half_angle);
    constexpr double blur = 1.0;  // px
    PixelRays rays(camera);
    const auto edge_end = [&](int row) {
        return row_of_slope(post, camera, shorter * slope_in_row(post, camera, rays, row)).value_or(row);
    };
    if (extent.top_seen)
        extent.first_edge_row = std::max(first, static_cast<int>(std::ceil(edge_end(first) + blur)));
    if (extent.base_seen)
        extent.last_edge_row = std::min(last, static_cast<int>(std::floor(edge_end(last) - blur)));
    return extent;
}

}  // namespace goalmouth
