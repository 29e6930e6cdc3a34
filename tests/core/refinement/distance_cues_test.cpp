#include "core/refinement/distance_cues.h"

#include "core/geometry/camera.h"
#include "core/random/random.h"
#include "core/refinement/goal_pairs.h"

#include <cmath>
#include <optional>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

constexpr double radius = 0.05, lean_sigma = 0.0175;

/// A post as a camera sees it that stands at the origin, `height` above the ground.
struct SeenPost {
    double distance = 3.0, direction = 0.0;  // m; rad, + left
    double height = 0.42, goal_height = 0.9;
    double pitch = 0.1, roll = 0.05;

    PostSilhouette silhouette() const {
        const Eigen::Matrix3d R_CB = camera_in_body(height, roll, pitch).linear().transpose();
        PostSilhouette post;
        post.up = R_CB.col(2);
        post.ahead = R_CB * Eigen::Vector3d(std::cos(direction), std::sin(direction), 0.0);
        post.right = post.ahead.cross(post.up);
        post.half_angle = std::asin(radius / distance);
        return post;
    }
    PostEnds ends(double sigma = 0.05) const {
        const double top = goal_height + radius - height;
        const auto end = [&](double slope) {
            PostEnd result;
            result.slope = slope;
            result.per_px = 1.0 / 554.0;
            result.sigma = sigma;
            return result;
        };
        PostEnds result;
        result.base = end(-height / (distance - radius));
        result.top = end(top / (top > 0.0 ? distance - radius : distance + radius));
        return result;
    }
    /// As the width tells it, `relative` its sigma.
    PostEstimate by_width(double relative) const {
        using namespace distance_error;
        PostEstimate result;
        result.distance = distance;
        result.bearing = direction;
        const double half_angle_sigma = relative * std::tan(silhouette().half_angle);
        result.errors(step + silhouette_part::half_angle, step + silhouette_part::half_angle) =
            half_angle_sigma * half_angle_sigma;
        result.errors(step + silhouette_part::lean, step + silhouette_part::lean) = lean_sigma * lean_sigma;
        result.errors(step + silhouette_part::swing, step + silhouette_part::swing) = 1e-8;
        result.distance_change[step + silhouette_part::half_angle] =
            -distance / std::tan(silhouette().half_angle);
        result.bearing_change[step + silhouette_part::swing] = 1.0;
        return result;
    }
};

Field goal_of(const SeenPost& post) {
    Field field;
    field.goal_height = post.goal_height;
    return field;
}

const DistanceCue* find(const CombinedDistance& all, DistanceCueKind kind) {
    for (const DistanceCue& cue : all.cues)
        if (cue.kind == kind) return &cue;
    return nullptr;
}

TEST(DistanceCues, BaseAndHeightTellTheDistance) {
    for (const double distance : {0.8, 3.0, 6.0}) {
        for (const double height : {0.42, 1.3}) {  // below the top, and above it
            SeenPost post;
            post.distance = distance;
            post.height = height;
            const auto all = combine_distances(post.by_width(0.01), post.silhouette(), post.ends(),
                                               CameraStance{height, 1e-4, Eigen::Vector3d::Zero()},
                                               lean_sigma, goal_of(post), {});
            const auto* base = find(all, DistanceCueKind::base);
            const auto* crossbar = find(all, DistanceCueKind::crossbar);
            ASSERT_TRUE(base && crossbar);
            EXPECT_NEAR(base->distance, distance, 1e-9);
            EXPECT_NEAR(crossbar->distance, distance, 1e-9);
            EXPECT_NEAR(all.estimate.distance, distance, 1e-9);
            EXPECT_LT(all.estimate.covariance()(0, 0), post.by_width(0.01).covariance()(0, 0));
        }
    }
}

TEST(DistanceCues, WithoutAPoseTheBaseSaysNothing) {
    const SeenPost post;
    const auto all = combine_distances(post.by_width(0.01), post.silhouette(), post.ends(), std::nullopt,
                                       lean_sigma, goal_of(post), {});
    EXPECT_EQ(find(all, DistanceCueKind::base), nullptr);
    EXPECT_NE(find(all, DistanceCueKind::crossbar), nullptr);
}

TEST(DistanceCues, EachCanBeSwitchedOff) {
    const SeenPost post;
    RefinementParameters parameters;
    parameters.base_cue = parameters.height_cue = false;
    const auto all = combine_distances(post.by_width(0.01), post.silhouette(), post.ends(),
                                       CameraStance{post.height, 1e-4, Eigen::Vector3d::Zero()}, lean_sigma,
                                       goal_of(post), parameters);
    ASSERT_EQ(all.cues.size(), 1U);
    EXPECT_EQ(all.cues.front().kind, DistanceCueKind::width);
    EXPECT_EQ(all.estimate.covariance(), post.by_width(0.01).covariance());
}

TEST(DistanceCues, AWidthThatIsSomethingElsesDoesNotCountWithTheHeight) {
    const SeenPost post;
    PostEstimate wrong = post.by_width(0.003);
    wrong.distance = 2.7;
    const auto all =
        combine_distances(wrong, post.silhouette(), post.ends(), std::nullopt, lean_sigma, goal_of(post), {});
    EXPECT_EQ(all.estimate.distance, wrong.distance);
    ASSERT_NE(find(all, DistanceCueKind::crossbar), nullptr);
    EXPECT_NEAR(find(all, DistanceCueKind::crossbar)->distance, 3.0, 1e-9);
    const double sigma = std::hypot(find(all, DistanceCueKind::crossbar)->sigma, all.cues.front().sigma);
    EXPECT_GT((3.0 - wrong.distance) / sigma, 6.0) << "far beyond cue_gate";
}

/// Errors drawn as the covariance says, and put into what is measured, not into the formulas.
TEST(DistanceCues, ErrorsAreWhatTheCovarianceSays) {
    Random random(5);
    double squares = 0.0, base_squares = 0.0, height_squares = 0.0;
    constexpr int draws = 4000;
    constexpr double camera_sigma = 0.01;
    for (int i = 0; i < draws; ++i) {
        SeenPost post;
        post.distance = random.uniform(1.2, 2.2);
        const RefinementParameters parameters;
        PostEnds ends = post.ends(0.3);
        // The post leans in the eyes of whoever has the vertical wrong.
        const double lean = lean_sigma * random.normal();
        for (auto* end : {&*ends.base, &*ends.top}) {
            end->slope = std::tan(std::atan(end->slope) - lean);
            end->slope += end->sigma * end->per_px * random.normal();
        }
        PostEstimate width = post.by_width(0.01);
        width.distance *= 1.0 + 0.01 * random.normal();
        Field field = goal_of(post);
        field.goal_height += parameters.goal_error * random.normal();
        const auto all = combine_distances(width, post.silhouette(), ends,
                                           CameraStance{post.height + camera_sigma * random.normal(),
                                                        camera_sigma * camera_sigma, Eigen::Vector3d::Zero()},
                                           lean_sigma, field, parameters);
        const auto normalised = [&](double distance, double variance) {
            return (distance - post.distance) * (distance - post.distance) / variance;
        };
        squares += normalised(all.estimate.distance, all.estimate.covariance()(0, 0));
        const auto* base = find(all, DistanceCueKind::base);
        const auto* height = find(all, DistanceCueKind::crossbar);
        ASSERT_TRUE(base && height);
        base_squares += normalised(base->distance, base->sigma * base->sigma);
        height_squares += normalised(height->distance, height->sigma * height->sigma);
    }
    EXPECT_NEAR(squares / draws, 1.0, 0.12);
    EXPECT_NEAR(base_squares / draws, 1.0, 0.15);
    EXPECT_NEAR(height_squares / draws, 1.0, 0.12);
}

/// Two posts of a goal 1.5 m wide, seen at an angle.
std::vector<GoalPairPost> goal(double relative) {
    std::vector<GoalPairPost> posts(2);
    const Eigen::Vector2d middle(3.0, 0.4), half(0.3, 0.75 * std::sqrt(1.0 - 0.16));
    for (std::size_t i = 0; i < 2; ++i) {
        const Eigen::Vector2d place = middle + (i == 0 ? 1.0 : -1.0) * half;
        SeenPost post;
        post.distance = place.norm();
        post.direction = std::atan2(place.y(), place.x());
        posts[i].silhouette = post.silhouette();
        posts[i].estimate = post.by_width(relative);
    }
    return posts;
}

TEST(GoalPairs, TheOtherPostTellsTheDistanceAndItsErrors) {
    Random random(3);
    constexpr int draws = 2000;
    constexpr double relative = 0.01, goal_error = 0.005;
    double squares = 0.0, before = 0.0, after = 0.0;
    int results = 0;
    for (int i = 0; i < draws; ++i) {
        const auto truth = goal(relative);
        auto posts = truth;
        for (GoalPairPost& post : posts) post.estimate.distance *= 1.0 + relative * random.normal();
        const auto told =
            pair_up(posts, Eigen::Matrix3d::Zero(), 1.5 + goal_error * random.normal(), goal_error);
        for (const GoalPairResult& result : told) {
            const double off = result.estimate[0] - truth[result.post].estimate.distance;
            squares += off * off / result.covariance(0, 0);
            before +=
                std::pow(posts[result.post].estimate.distance - truth[result.post].estimate.distance, 2);
            after += off * off;
            ++results;
        }
    }
    EXPECT_GT(results, 2 * draws * 0.98);
    EXPECT_NEAR(squares / results, 1.0, 0.12);
    EXPECT_LT(after, 0.8 * before);
}

TEST(GoalPairs, PostsOfNoGoalStayAsTheyAre) {
    auto posts = goal(0.003);
    EXPECT_EQ(pair_up(posts, Eigen::Matrix3d::Zero(), 1.5, 0.005).size(), 2U);
    EXPECT_TRUE(pair_up(posts, Eigen::Matrix3d::Zero(), 1.7, 0.005).empty());
    posts.push_back(posts.back());  // which of the two is it?
    EXPECT_TRUE(pair_up(posts, Eigen::Matrix3d::Zero(), 1.5, 0.005).empty());
    EXPECT_TRUE(pair_up({}, Eigen::Matrix3d::Zero(), 1.5, 0.005).empty());
}

/// A focal length that is told wrong moves both distances and the angle between the posts, not what they
/// make of the goal's width.
TEST(GoalPairs, CommonErrorsAreNotTakenForTwo) {
    const auto with = [](double focal_error) {
        auto posts = goal(0.01);
        for (GoalPairPost& post : posts) {
            post.estimate.distance_change[distance_error::focal] = post.estimate.distance;
            post.estimate.errors(distance_error::focal, distance_error::focal) = focal_error * focal_error;
        }
        return pair_up(posts, Eigen::Matrix3d::Zero(), 1.5, 0.005);
    };
    const auto sure = with(0.0), unsure = with(0.02);
    ASSERT_EQ(sure.size(), 2U);
    ASSERT_EQ(unsure.size(), 2U);
    const double distance = unsure.front().estimate[0];
    EXPECT_GT(unsure.front().covariance(0, 0),
              sure.front().covariance(0, 0) + 0.5 * std::pow(0.02 * distance, 2));
}

}  // namespace
}  // namespace goalmouth
