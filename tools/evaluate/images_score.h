#pragma once

#include "core/evaluation/post_matching.h"
#include "core/evaluation/reference_post.h"
#include "tools/evaluate/images_truth.h"
#include "tools/goalmouth/annotations.h"
#include "tools/goalmouth/image_chain.h"

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

namespace goalmouth {

/// The rule of `goalmouth evaluate paper`, with what a person's eye can tell as the least tolerance.
inline constexpr MatchingRule hand_marked_rule{.fraction = 0.25, .floor = 3.0, .coverage = 0.5};

/// The outline as the matching takes it: its edges over the rows 0 … height − 1.
ReferencePost reference_post(const PostOutline& outline, int height);

/// What a detector did on one annotated picture.
struct ScoredPicture {
    AnnotatedImage annotated;
    std::string detector;
    std::vector<ReferencePost> truth;  // as annotated.posts
    ImageResult result;                // its posts are what is judged
    PostMatching matching;
    std::optional<RobotPlace> place = {};                // where it is known
    std::vector<std::optional<PlacedPost>> placed = {};  // as truth: which goalpost, where that is known

    int found() const { return static_cast<int>(matching.found_count(truth)); }
    int missed() const { return static_cast<int>(truth.size()) - found(); }
    int wrong() const { return static_cast<int>(matching.wrong_count()); }
    bool failed() const { return missed() + wrong() > 0; }
};

ScoredPicture score_picture(const AnnotatedImage& annotated, const std::string& detector, ImageResult result,
                            int height, const MatchingRule& rule = hand_marked_rule);

/// Adds what is known of the true distances from the robot's place.
void place_picture(ScoredPicture& picture, const RobotPlace& place, const Field& field);

/// Sums over pictures.
struct ImageScore {
    int pictures = 0;
    int posts = 0;
    int found = 0;
    int wrong = 0;
    int ignored = 0;
    int negatives = 0;           // pictures without a post
    int wrong_on_negatives = 0;  // posts found in them

    int missed() const { return posts - found; }
    double recall() const;  // 1 where there is no post
    double precision() const;
    ImageScore& operator+=(const ScoredPicture& picture);
};

/// Posts by their width at the foot [px]: from … below to.
struct WidthClass {
    double from = 0.0;
    double to = std::numeric_limits<double>::infinity();
    int posts = 0;
    int found = 0;
};
std::vector<WidthClass> by_width(const std::vector<const ScoredPicture*>& pictures);

}  // namespace goalmouth
