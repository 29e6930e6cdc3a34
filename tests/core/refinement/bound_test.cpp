#include "core/refinement/bound.h"

#include "core/evaluation/statistics.h"
#include "core/random/random.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double pi = std::numbers::pi;

double radians(double degrees) {
    return degrees * pi / 180.0;
}

/// (Y, Cb − 128, Cr − 128).
Vector3d from_rgb(const Vector3d& rgb) {
    Eigen::Matrix3d m;
    m << 0.299, 0.587, 0.114, -0.168736, -0.331264, 0.5, 0.5, -0.418688, -0.081312;
    return m * rgb;
}

const Vector3d yellow = from_rgb({226.0, 184.0, 34.0});
const Vector3d grey = from_rgb({186.0, 186.0, 190.0});
const Vector3d carpet = from_rgb({52.0, 122.0, 62.0});

EdgeLook yellow_before(const Vector3d& background, double post_noise = 16.0, double background_noise = 16.0) {
    EdgeLook look;
    look.post = yellow;
    look.background = background;
    look.post_noise = ycbcr_noise(Vector3d::Constant(post_noise));
    look.background_noise = ycbcr_noise(Vector3d::Constant(background_noise));
    return look;
}

// ---------------------------------------------------------------------------------------------------------
// What a camera makes of straight edges, and what whoever knows levels, noise and blur can tell from it. None
// of it uses the code under test.

/// Share of a pixel's light that comes from the far side of an edge, by the distance of its centre from it:
/// the blur's step averaged over the pixel's square, tabulated.
class Coverage {
  public:
    Coverage(double blur, const Vector2d& normal) {
        constexpr int subpixels = 8;
        for (int i = 0; i <= count; ++i) {
            double sum = 0.0;
            for (int v = 0; v < subpixels; ++v)
                for (int u = 0; u < subpixels; ++u) {
                    const Vector2d off = Vector2d(u + 0.5, v + 0.5) / subpixels - Vector2d::Constant(0.5);
                    const double t = -reach + 2.0 * reach * i / count + normal.dot(off);
                    sum += 0.5 * std::erfc(-t / (blur * std::numbers::sqrt2));
                }
            table_.push_back(sum / (subpixels * subpixels));
        }
    }
    double operator()(double t) const {
        const double at = std::clamp((t + reach) / (2.0 * reach), 0.0, 1.0) * count;
        const auto i = std::min(static_cast<std::size_t>(at), static_cast<std::size_t>(count - 1));
        const double share = at - static_cast<double>(i);
        return (1.0 - share) * table_[i] + share * table_[i + 1];
    }

  private:
    static constexpr double reach = 8.0;  // px
    static constexpr int count = 1600;
    std::vector<double> table_;
};

/// Pairs of pixels of a 4:2:2 picture as (mean Y, Cb, Cr): the pair's left pixel, x even.
struct Pair {
    int x = 0;
    int y = 0;
    const EdgeLook* look = nullptr;
};

/// Share of the post in each of a pair's pixels.
using Covered = std::function<double(double x, double y)>;

Vector3d draw(const Eigen::Matrix3d& covariance, Random& random) {
    const Eigen::Matrix3d root = covariance.llt().matrixL();
    return root * Vector3d(random.normal(), random.normal(), random.normal());
}

/// Takes a picture: each pixel of the post with a brightness of its own, noise in each pixel, chroma averaged
/// over the pair, levels rounded.
std::vector<Vector3d> photograph(const std::vector<Pair>& pairs, const Covered& covered, Random& random) {
    std::vector<Vector3d> values;
    for (const Pair& pair : pairs) {
        Vector3d mean = Vector3d::Zero();
        double luma = 0.0;
        for (int k = 0; k < 2; ++k) {
            const double c = covered(pair.x + k, pair.y);
            const EdgeLook& look = *pair.look;
            const double brightness = random.uniform(0.6, 1.0);
            const Vector3d level = c * brightness * look.post + (1.0 - c) * look.background +
                                   draw(c * look.post_noise + (1.0 - c) * look.background_noise, random);
            mean += 0.5 * level;
            luma += 0.5 * std::round(level.x());
        }
        values.push_back({luma, std::round(mean.y()), std::round(mean.z())});
    }
    return values;
}

/// The two combinations of (Y, Cb, Cr) that the post's colour, however bright, leaves at 0.
Eigen::Matrix<double, 2, 3> complement(const Vector3d& post) {
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(post, Eigen::ComputeFullU);
    return svd.matrixU().rightCols<2>().transpose();
}

/// Fits by maximum likelihood in the complement: Gauss and Newton's steps, derivatives by differences.
/// `covered_by` gives the picture that parameters predict.
Eigen::VectorXd fit(const std::vector<Pair>& pairs, const std::vector<Vector3d>& values,
                    const std::function<Covered(const Eigen::VectorXd&)>& covered_by, Eigen::VectorXd guess,
                    const Eigen::VectorXd& steps) {
    constexpr int iterations = 4;
    const Eigen::Matrix<double, 2, 3> b = complement(yellow);  // of all posts here
    const Eigen::Index unknowns = guess.size();
    const auto share = [](const Covered& covered, const Pair& pair) {
        return 0.5 * (covered(pair.x, pair.y) + covered(pair.x + 1, pair.y));
    };
    for (int n = 0; n < iterations; ++n) {
        const Covered here = covered_by(guess);
        std::vector<Covered> above, below;
        for (Eigen::Index k = 0; k < unknowns; ++k) {
            const Eigen::VectorXd off = Eigen::VectorXd::Unit(unknowns, k) * steps[k];
            above.push_back(covered_by(guess + off));
            below.push_back(covered_by(guess - off));
        }
        Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(unknowns, unknowns);
        Eigen::VectorXd rhs = Eigen::VectorXd::Zero(unknowns);
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            const EdgeLook& look = *pairs[i].look;
            const double c = share(here, pairs[i]);
            Eigen::Matrix3d noise = 0.5 * (c * look.post_noise + (1.0 - c) * look.background_noise);
            noise.diagonal() += Vector3d(1.0, 2.0, 2.0) / 24.0;
            const Eigen::Matrix2d weight = (b * noise * b.transpose()).inverse();
            const Vector2d background = b * look.background;
            const Vector2d residual = b * values[i] - (1.0 - c) * background;
            Eigen::RowVectorXd rate(unknowns);
            for (Eigen::Index k = 0; k < unknowns; ++k) {
                const auto at = static_cast<std::size_t>(k);
                rate[k] = -(share(above[at], pairs[i]) - share(below[at], pairs[i])) / (2.0 * steps[k]);
            }
            const double information = background.dot(weight * background);
            normal += information * rate.transpose() * rate;
            rhs += background.dot(weight * residual) * rate.transpose();
        }
        guess += normal.ldlt().solve(rhs);
    }
    return guess;
}

/// What `tries` errors must show of a bound: their RMSE reaches it within a few per cent, and is not
/// significantly less.
void expect_reached(const std::vector<double>& errors, double bound) {
    const ErrorStatistics statistics = error_statistics(errors).value();
    const auto tries = static_cast<double>(errors.size());
    const double chance = 1.0 / std::sqrt(2.0 * tries);  // relative σ of an RMSE
    EXPECT_GT(statistics.rmse, bound * (1.0 - 3.0 * chance)) << "less than the bound " << bound;
    EXPECT_LT(statistics.rmse, bound * (1.03 + 3.0 * chance)) << "not near the bound " << bound;
    EXPECT_LT(std::abs(statistics.bias), 0.1 * bound + 3.0 * bound / std::sqrt(tries));
}

// ---------------------------------------------------------------------------------------------------------

/// Edges across a patch of even height: the shift's errors of many fits.
std::vector<double> shift_errors(const EdgeLook& look, double angle, int tries, std::uint64_t seed,
                                 double& length) {
    // n points from the background to the post; an angle of 0 is an upright edge.
    const Vector2d normal(std::cos(angle), std::sin(angle));
    const bool steep = std::abs(normal.x()) > std::abs(normal.y());
    constexpr int along = 30;
    constexpr int across = 7;  // px to either side
    std::vector<Pair> pairs;
    const Vector2d middle(100.3, 100.4);
    for (int y = 0; y < 200; ++y)
        for (int x = 0; x < 200; x += 2) {
            const Vector2d off = Vector2d(x + 0.5, y) - middle;
            if (std::abs(normal.dot(off)) > across) continue;
            const double place = steep ? y - 85 : x - 85 + 0.5;
            if (place < 0.0 || place >= along) continue;
            pairs.push_back({x, y, &look});
        }
    length = along / std::max(std::abs(normal.x()), std::abs(normal.y()));
    const Coverage profile(look.blur, normal);
    Random random(seed);
    std::vector<double> errors;
    for (int i = 0; i < tries; ++i) {
        const double shift = random.uniform(-1.0, 1.0);  // everywhere in a pair
        const auto covered_by = [&](const Eigen::VectorXd& s) -> Covered {
            return [&, s = s[0]](double x, double y) {
                return profile(normal.dot(Vector2d(x, y) - middle) - s);
            };
        };
        const Eigen::VectorXd truth = Eigen::VectorXd::Constant(1, shift);
        const auto values = photograph(pairs, covered_by(truth), random);
        const Eigen::VectorXd start = truth.array() + 0.2;
        errors.push_back(fit(pairs, values, covered_by, start, Eigen::VectorXd::Constant(1, 0.01))[0] -
                         shift);
    }
    return errors;
}

TEST(EdgeInformation, IsReachedByMaximumLikelihoodAtEveryAngle) {
    for (const double degrees : {1.5, 10.0, 20.0, 45.0, 90.0}) {
        SCOPED_TRACE(degrees);
        const EdgeLook look = yellow_before(grey);
        const double angle = radians(degrees);
        double length = 0.0;
        const auto errors = shift_errors(look, angle, 800, 7, length);
        expect_reached(errors,
                       1.0 / std::sqrt(length * edge_information(look, {std::cos(angle), std::sin(angle)})));
    }
}

TEST(EdgeInformation, HoldsForOtherNoiseBlurAndColours) {
    EdgeLook faint = yellow_before(0.5 * yellow + 0.2 * (grey - yellow), 4.0, 4.0);
    EdgeLook dark = yellow_before(carpet, 24.0, 4.0);  // a bright post's photon noise
    EdgeLook soft = yellow_before(carpet);
    soft.blur = 1.6;
    EdgeLook clean = yellow_before(grey, 0.5, 0.5);  // rounding counts
    for (const EdgeLook& look : {faint, dark, soft, clean}) {
        double length = 0.0;
        const double angle = radians(-7.0);
        const auto errors = shift_errors(look, angle, 800, 11, length);
        SCOPED_TRACE(&look - &faint);
        expect_reached(errors,
                       1.0 / std::sqrt(length * edge_information(look, {std::cos(angle), std::sin(angle)})));
    }
}

TEST(EdgeInformation, IsNoneWhereTheBackgroundIsThePostsColour) {
    const Vector2d across(1.0, 0.0);
    EXPECT_NEAR(edge_information(yellow_before(yellow), across), 0.0, 1e-12);
    EXPECT_NEAR(edge_information(yellow_before(0.4 * yellow), across), 0.0, 1e-12)
        << "a shadow is the post's colour too";
    EXPECT_GT(edge_information(yellow_before(grey), across), 1.0);
    EXPECT_NEAR(contrast_to_noise(yellow_before(0.4 * yellow)), 0.0, 1e-6);
}

TEST(EdgeInformation, DoesNotKnowHowBrightThePostIs) {
    const Vector2d across(0.6, 0.8);
    EdgeLook bright = yellow_before(grey);
    EdgeLook shaded = bright;
    shaded.post *= 0.3;
    EXPECT_NEAR(edge_information(shaded, across), edge_information(bright, across),
                1e-9 * edge_information(bright, across));
}

TEST(EdgeInformation, GrowsWithContrastAndFallsWithNoiseAndBlur) {
    const Vector2d level(0.0, 1.0);
    const double plain = edge_information(yellow_before(grey), level);
    // Without rounding, information goes with the inverse of the noise's variance.
    EXPECT_NEAR(edge_information(yellow_before(grey, 64.0, 64.0), level) / plain, 0.25, 0.01);
    EXPECT_NEAR(edge_information(yellow_before(0.5 * grey), level) / plain, 0.25, 1e-9);
    EdgeLook soft = yellow_before(grey);
    soft.blur = std::sqrt(4.0 * (0.85 * 0.85 + 1.0 / 12.0) - 1.0 / 12.0);
    EXPECT_NEAR(edge_information(soft, level) / plain, 0.5, 1e-9) << "as one over the profile's σ";
    EXPECT_GT(plain, edge_information(yellow_before(grey), {1.0, 0.0})) << "pairs blur upright edges";
}

// ---------------------------------------------------------------------------------------------------------

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
