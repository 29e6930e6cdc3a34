#include "core/random/random.h"
#include "core/refinement/bound.h"
#include "tests/core/refinement/photographed_edge.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace goalmouth::test;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double pi = std::numbers::pi;

double radians(double degrees) {
    return degrees * pi / 180.0;
}

/// A camera before an upright post of 10 cm, turned, rolled and nodding.
struct View {
    double distance = 3.0;
    double yaw = 0.0;
    double pitch = 0.0;
    double roll = 0.0;
    Intrinsics camera = from_horizontal_fov(320, 240, radians(60.0));

    Eigen::Isometry3d T_WC() const { return camera_in_body(0.42, roll, pitch, yaw); }
    /// With the axis at `distance`, `turn` to the left of ahead.
    static Cylinder post(double distance, double turn) {
        Cylinder cylinder;
        cylinder.base = {distance * std::cos(turn), distance * std::sin(turn), 0.0};
        cylinder.length = 0.9;
        cylinder.radius = 0.05;
        return cylinder;
    }
};

struct Line {
    Vector2d normal;  // unit, towards the post
    double offset = 0.0;
    Line(const Vector2d& top, const Vector2d& base, const Vector2d& inside) {
        const Vector2d along = (base - top).normalized();
        normal = {-along.y(), along.x()};
        if (normal.dot(inside - top) < 0.0) normal = -normal;
        offset = normal.dot(top);
    }
    double at(const Vector2d& p) const { return normal.dot(p) - offset; }
};

std::array<Line, 2> lines_of(const View& view, const Cylinder& post) {
    const CylinderEdges e = project_edges(view.camera, view.T_WC(), post).value();
    const Vector2d inside = 0.25 * (e.left_top + e.left_base + e.right_top + e.right_base);
    return {Line(e.left_top, e.left_base, inside), Line(e.right_top, e.right_base, inside)};
}

/// Rows of the picture between top and base of a line from `a` to `b`, in pieces of one row.
std::vector<EdgePiece> pieces_of(const Vector2d& a, const Vector2d& b, int first_row, int last_row,
                                 const EdgeLook& look) {
    std::vector<EdgePiece> pieces;
    for (int y = first_row; y <= last_row; ++y) {
        const double share = (y - a.y()) / (b.y() - a.y());
        const Vector2d at = a + share * (b - a);
        pieces.push_back({at, (b - a).norm() / std::abs(b.y() - a.y()), look});
    }
    return pieces;
}

struct PostTrial {
    std::vector<double> distance_errors, turn_errors;
    PostBound bound;
};

/// Fits distance and direction of a post to its edges in `rows` rows about the picture's middle.
PostTrial try_post(const View& view, const EdgeLook& left_look, const EdgeLook& right_look, int rows,
                   int tries, std::uint64_t seed) {
    const Cylinder truth = View::post(view.distance, 0.0);
    const auto edges = project_edges(view.camera, view.T_WC(), truth).value();
    const auto lines = lines_of(view, truth);
    const int first =
        std::max({0, (view.camera.height - rows) / 2,
                  static_cast<int>(std::ceil(std::max(edges.left_top.y(), edges.right_top.y())))});
    const int last =
        std::min({view.camera.height - 1, first + rows - 1,
                  static_cast<int>(std::floor(std::min(edges.left_base.y(), edges.right_base.y())))});
    PostTrial trial;
    trial.bound = post_bound(view.camera, silhouette(truth, view.T_WC()).value(),
                             pieces_of(edges.left_top, edges.left_base, first, last, left_look),
                             pieces_of(edges.right_top, edges.right_base, first, last, right_look))
                      .value();

    // Each pair belongs to the nearer edge.
    std::vector<Pair> pairs;
    for (int y = first; y <= last; ++y)
        for (int x = 0; x < view.camera.width; x += 2) {
            const Vector2d p(x + 0.5, y);
            const double l = std::abs(lines[0].at(p));
            const double r = std::abs(lines[1].at(p));
            if (std::min(l, r) < 7.0) pairs.push_back({x, y, l < r ? &left_look : &right_look});
        }
    const Coverage left_profile(left_look.blur, lines[0].normal);
    const Coverage right_profile(right_look.blur, lines[1].normal);
    const auto covered_by = [&](const Eigen::VectorXd& p) -> Covered {
        const auto moved = lines_of(view, View::post(p[0], p[1]));
        return [&, moved](double x, double y) {
            const Vector2d at(x, y);
            return left_profile(moved[0].at(at)) + right_profile(moved[1].at(at)) - 1.0;
        };
    };
    Random random(seed);
    const Eigen::Vector2d true_parameters(view.distance, 0.0);
    const Eigen::Vector2d steps(1e-3 * view.distance, 1e-4);
    for (int i = 0; i < tries; ++i) {
        const auto values = photograph(pairs, covered_by(true_parameters), random);
        const Eigen::VectorXd found =
            fit(pairs, values, covered_by, Eigen::Vector2d(1.01 * view.distance, 5e-4), steps);
        trial.distance_errors.push_back(found[0] - view.distance);
        trial.turn_errors.push_back(found[1]);
    }
    return trial;
}

TEST(PostBound, IsReachedByMaximumLikelihoodFarAndNearUprightAndTiltedAndOffTheAxis) {
    View far;
    far.distance = 3.0;
    far.yaw = 0.004;  // edges not along the pixels
    far.pitch = 0.06;
    View tilted = far;
    tilted.roll = radians(20.0);
    tilted.yaw = 0.15;
    View near;  // the picture is 0.46 m wide there, the post a fifth of it
    near.distance = 0.4;
    near.yaw = 0.02;
    near.pitch = 0.1;
    near.roll = radians(10.0);
    View aside;
    aside.distance = 1.0;
    aside.yaw = radians(24.0);
    aside.roll = radians(5.0);
    const EdgeLook before_wall = yellow_before(grey);
    const EdgeLook before_carpet = yellow_before(carpet, 20.0, 8.0);
    int place = 0;
    for (const View& view : {far, tilted, near, aside}) {
        SCOPED_TRACE(place++);
        const PostTrial trial = try_post(view, before_wall, before_carpet, 50, 400, 3);
        expect_reached(trial.distance_errors, trial.bound.distance_sigma());
        expect_reached(trial.turn_errors, trial.bound.turn_sigma());
    }
}

TEST(PostBound, IsTheFormulaFarAwayInTheMiddle) {
    View view;
    view.distance = 6.0;
    view.camera = Intrinsics{};
    const EdgeLook look = yellow_before(grey);
    const auto edges = project_edges(view.camera, view.T_WC(), View::post(6.0, 0.0)).value();
    const auto bound = post_bound(view.camera, silhouette(View::post(6.0, 0.0), view.T_WC()).value(),
                                  pieces_of(edges.left_top, edges.left_base, 210, 259, look),
                                  pieces_of(edges.right_top, edges.right_base, 210, 259, look));
    ASSERT_TRUE(bound);
    const double one_edge = 1.0 / std::sqrt(50.0 * edge_information(look, {1.0, 0.0}));  // px
    const double width = std::numbers::sqrt2 * one_edge;
    EXPECT_NEAR(bound->distance_sigma(), 36.0 / (0.1 * view.camera.fx) * width,
                1e-3 * bound->distance_sigma());
    EXPECT_NEAR(bound->turn_sigma(), 0.5 * width / view.camera.fx, 1e-3 * bound->turn_sigma());
    // σ_w = (σ_n/A) √(4√π σ_b/L), pairs of pixels giving half a sample for each, the optics' Gaussian alone.
    const double noise_to_contrast = std::numbers::sqrt2 / contrast_to_noise(look);
    const double sigma_b = std::sqrt(0.85 * 0.85 + 1.0 / 12.0 + 0.25);
    EXPECT_NEAR(noise_to_contrast * std::sqrt(4.0 * std::sqrt(pi) * sigma_b / 50.0), width, 0.01 * width);
}

TEST(PostBound, NeedsBothEdges) {
    View view;
    const CylinderSilhouette outline = silhouette(View::post(3.0, 0.0), view.T_WC()).value();
    const auto edges = project_edges(view.camera, view.T_WC(), View::post(3.0, 0.0)).value();
    const EdgeLook look = yellow_before(grey);
    const auto left = pieces_of(edges.left_top, edges.left_base, 100, 140, look);
    const auto right = pieces_of(edges.right_top, edges.right_base, 100, 140, look);
    EXPECT_TRUE(post_bound(view.camera, outline, left, right));
    EXPECT_FALSE(post_bound(view.camera, outline, left, {}));
    EXPECT_FALSE(post_bound(view.camera, outline, {}, right));
    EXPECT_FALSE(post_bound(view.camera, outline, {}, {}));
    const auto invisible =
        pieces_of(edges.right_top, edges.right_base, 100, 140, yellow_before(0.8 * yellow));
    EXPECT_FALSE(post_bound(view.camera, outline, left, invisible));
}

TEST(PostBound, FallsWithTheRootOfTheLengthOfBothEdges) {
    View view;
    const CylinderSilhouette outline = silhouette(View::post(3.0, 0.0), view.T_WC()).value();
    const auto edges = project_edges(view.camera, view.T_WC(), View::post(3.0, 0.0)).value();
    const auto sigma = [&](int left_rows, int right_rows) {
        const EdgeLook look = yellow_before(grey);
        return post_bound(view.camera, outline,
                          pieces_of(edges.left_top, edges.left_base, 120, 119 + left_rows, look),
                          pieces_of(edges.right_top, edges.right_base, 120, 119 + right_rows, look))
            .value()
            .distance_sigma();
    };
    const double even = sigma(40, 40);
    EXPECT_NEAR(sigma(10, 10), 2.0 * even, 0.01 * even);
    EXPECT_NEAR(sigma(40, 10), std::sqrt(2.5) * even, 0.01 * even) << "(1 + 4)/2 of the variance";
}

TEST(PostBound, GrowsWhereTheVerticalIsNotKnown) {
    View view;
    view.distance = 0.6;
    view.pitch = 0.1;
    const Cylinder post = View::post(0.6, 0.0);
    const CylinderSilhouette outline = silhouette(post, view.T_WC()).value();
    const auto edges = project_edges(view.camera, view.T_WC(), post).value();
    const EdgeLook look = yellow_before(grey);
    const auto left = pieces_of(edges.left_top, edges.left_base, 20, 219, look);
    const auto right = pieces_of(edges.right_top, edges.right_base, 20, 219, look);
    const auto sigma = [&](double direction) {
        return post_bound(view.camera, outline, left, right, direction).value().distance_sigma();
    };
    EXPECT_NEAR(sigma(1e-9), sigma(0.0), 1e-6 * sigma(0.0));
    EXPECT_GT(sigma(radians(1.0)), 1.05 * sigma(0.0));
    EXPECT_GT(sigma(radians(3.0)), sigma(radians(1.0)));
    EXPECT_LT(sigma(1e3), 1e3 * sigma(0.0)) << "the edges alone tell the lean too, near by";
}

TEST(PostBound, HoldsThroughALensToo) {
    View view;
    view.distance = 2.0;
    view.yaw = 0.3;
    const Cylinder post = View::post(2.0, 0.0);
    const CylinderSilhouette outline = silhouette(post, view.T_WC()).value();
    const auto edges = project_edges(view.camera, view.T_WC(), post).value();
    const EdgeLook look = yellow_before(grey);
    Intrinsics bent = view.camera;
    bent.distortion = {-0.1, 0.0, 0.0, 0.0, 0.0};
    const auto through_lens = [&](std::vector<EdgePiece> pieces) {
        for (EdgePiece& piece : pieces)
            piece.pixel = pixel_from_normalised(bent, normalised_from_pixel(view.camera, piece.pixel));
        return pieces;
    };
    const auto left = pieces_of(edges.left_top, edges.left_base, 100, 140, look);
    const auto right = pieces_of(edges.right_top, edges.right_base, 100, 140, look);
    const double straight = post_bound(view.camera, outline, left, right).value().distance_sigma();
    const double pulled_in =
        post_bound(bent, outline, through_lens(left), through_lens(right)).value().distance_sigma();
    // At x/z = tan 0.3 this lens moves radial steps by 1 − 3·0.1·x² of what they were.
    const double x = std::tan(0.3);
    EXPECT_NEAR(pulled_in / straight, 1.0 / (1.0 - 0.3 * x * x), 0.01);
}

}  // namespace
}  // namespace goalmouth
