#pragma once

#include "core/detection/upright_evidence.h"
#include "core/field/field.h"

#include <cstddef>
#include <optional>
#include <span>

namespace goalmouth {

/// What may be a post.
struct UprightPost {
    UprightEdges edges;
    UprightEvidence evidence;
};

/// How well a picture's camera is known.
struct UprightDoubt {
    double attitude_sigma = 0.0;  // rad, about any level axis
    double tolerance = 0.0;       // rad, of an edge
    double pixel = 0.0;           // rad
};

/// What two posts of one picture tell of each other.
///
/// They neither stand in one place nor are at odds about the vertical. What makes an edge lean in the picture
/// (an error of the vertical, a rolling shutter) makes both lean alike, so that next to another post a wrong
/// edge, along a robot that hides the post's own or a thing that stands behind it, stands out by its lean.
/// And where two posts are a goal's, they stand as far apart as a goal is wide, which no wrong width of
/// either would give.
class UprightPairs {
  public:
    UprightPairs(const UprightSize& size, double goal_width, double lean_sigma)
        : size_(size), goal_width_(goal_width), lean_sigma_(lean_sigma) {}

    /// Both may be posts.
    bool go_together(const UprightPost& a, const UprightPost& b, const UprightDoubt& doubt) const;

    struct Pair {
        std::size_t first = 0, second = 0;  // first < second
    };
    /// The two that are posts sooner than any others, where they are so sooner than `posts[0]` alone. `posts`
    /// are in order of their scores.
    std::optional<Pair> best(std::span<const UprightPost> posts, const UprightDoubt& doubt) const;

  private:
    double lean_apart(const UprightPost& a, const UprightPost& b, const UprightDoubt& doubt) const;
    double of_one_goal(const UprightPost& a, const UprightPost& b, const UprightDoubt& doubt) const;

    UprightSize size_;
    double goal_width_;  // m
    double lean_sigma_;  // rad
};

}  // namespace goalmouth
