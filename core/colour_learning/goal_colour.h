#pragma once

#include "core/detection/post.h"
#include "core/imaging/colour_gains.h"
#include "core/imaging/colour_table.h"
#include "core/imaging/yuyv.h"
#include "core/parameters/parameters.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace goalmouth {

struct GoalColourParameters {
    int least_posts = 10;
    int posts = 40;
    double largest_change = 1.5;
};

template <class Visitor>
void describe_parameters(Visitor& v, GoalColourParameters& p) {
    v("least_posts", p.least_posts, Range{1, 10000}, "1",
      "posts from which the posts' colour is known; before, the table alone says what a post looks like");
    v("posts", p.posts, Range{1, 10000}, "1", "after so many it no longer changes");
    v("largest_change", p.largest_change, Range{1, 10}, "1",
      "posts are looked at while no gain is beyond this factor, up or down, from 1");
}

/// The colours of posts in a frame [levels of red, green, blue]: medians over what `table` calls goal in the
/// middle half of each, between both edges. Posts that lack an edge, or that are mostly something else, give
/// none.
std::vector<Eigen::Vector3d> post_colours(YuyvView image, std::span<const Post> posts,
                                          const ColourTable& table);

/// What goalposts look like in the light of a colour table, from the first that were found while it held: the
/// median of each channel, since some of what is found is no post.
class GoalColour {
  public:
    explicit GoalColour(const GoalColourParameters& parameters) : parameters_(parameters) {}

    /// A post's colour under `gains`. One that clips says nothing.
    void see(const Eigen::Vector3d& rgb, const ColourGains& gains);
    bool complete() const { return seen_.size() >= static_cast<std::size_t>(parameters_.posts); }
    /// Red, green, blue without the gains; nothing before enough were seen.
    std::optional<Eigen::Vector3d> levels() const;

  private:
    GoalColourParameters parameters_;
    std::vector<Eigen::Vector3d> seen_;
};

}  // namespace goalmouth
