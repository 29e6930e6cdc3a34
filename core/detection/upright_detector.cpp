#include "core/detection/upright_detector.h"

#include "core/detection/post_order.h"
#include "core/geometry/line.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <Eigen/Cholesky>

namespace goalmouth {
namespace {

constexpr double least_roll_sigma = 1e-3;    // rad
constexpr double roll_sigmas = 3.0;          // rolls are tried as far from the measured vertical as this
constexpr double most_roll = 0.7;            // rad, and no farther
constexpr std::size_t most_peaks = 10;       // of a side, for one roll
constexpr std::size_t most_hypotheses = 32;  // that are judged

}  // namespace

UprightDetector::UprightDetector(const UprightDetectorParameters& parameters, const Field& field)
    : parameters_(parameters),
      size_{0.5 * field.post_diameter, field.goal_height + 0.5 * field.post_diameter},
      narrowest_(2.0 * std::asin(std::min(1.0, size_.radius / parameters.search.farthest))),
      widest_(2.0 * std::asin(std::min(1.0, size_.radius / parameters.search.nearest))),
      judge_(size_),
      pairs_(size_, field.goal_width, parameters.search.lean_sigma) {}

/// Of the rows it would be seen in were all of it in the picture, some are reason enough.
double UprightDetector::usual_rows(const UprightEdges& edges) const {
    constexpr double usual = 0.4;
    const double distance = size_.radius / std::sin(edges.half_angle());
    return usual * size_.height / distance * view_scale_ / row_step_;
}

UprightDetector::Ends UprightDetector::ends_of(const UprightView& view, const UprightEdges& edges) const {
    const double distance = size_.radius / std::sin(edges.half_angle());
    const double height = view.height().value_or(0.5 * size_.height);
    const double slack = 2.0 * view.attitude_sigma() + 0.1 * size_.height / distance;
    return {(size_.height - height) / distance + slack, -height / distance - slack};
}

/// Points near its edges and between its ends; 0 where either edge has next to none.
int UprightDetector::points_along(const UprightView& view, const UprightEdges& edges,
                                  double tolerance) const {
    const Ends ends = ends_of(view, edges);
    const auto count = [&](const std::vector<UprightPoint>& from, double azimuth) {
        int n = 0;
        for (const UprightPoint& p : from)
            n += static_cast<int>(p.ray.slope < ends.top) & static_cast<int>(p.ray.slope > ends.base) &
                 static_cast<int>(std::abs(p.ray.azimuth - azimuth - edges.roll * p.ray.slope) < tolerance);
        return n;
    };
    constexpr int least = 3;
    const int left = count(seen_.left, edges.left);
    if (left < least) return 0;
    const int right = count(seen_.right, edges.right);
    return right < least ? 0 : left + right;
}

void UprightDetector::suggest(const UprightView& view, double tolerance) {
    hypotheses_.clear();
    double steepest = 0.0;
    for (const auto* points : {&seen_.left, &seen_.right})
        for (const UprightPoint& p : *points) steepest = std::max(steepest, std::abs(p.ray.slope));
    const double reach = std::min(roll_sigmas * roll_sigma_, most_roll);
    constexpr int most_steps = 100;  // to either side
    const double step = std::max(2.0 * tolerance / std::max(steepest, 0.1), reach / most_steps);
    const int steps = static_cast<int>(std::ceil(reach / step));
    constexpr int least_points = 3;
    constexpr double least_promise = -2.0;
    for (int i = -steps; i <= steps; ++i) {
        const double roll = i * step;
        votes_.find(seen_.left, roll, tolerance, least_points, most_peaks, left_);
        votes_.find(seen_.right, roll, tolerance, least_points, most_peaks, right_);
        for (const AzimuthPeak& left : left_) {
            for (const AzimuthPeak& right : right_) {
                const double width = right.azimuth - left.azimuth;
                if (width < narrowest_ || width > widest_) continue;
                Hypothesis next{{left.azimuth, right.azimuth, roll}, 0.0};
                const double leaves = 0.5 * (roll / roll_sigma_) * (roll / roll_sigma_);
                const double rows = usual_rows(next.edges) + leaves;
                if (left.near + right.near - rows <= least_promise) continue;  // counted at most
                next.promise = points_along(view, next.edges, 1.5 * tolerance) - rows;
                if (next.promise > least_promise) hypotheses_.push_back(next);
            }
        }
    }
    std::sort(hypotheses_.begin(), hypotheses_.end(), [](const Hypothesis& a, const Hypothesis& b) {
        return std::tuple(-a.promise, a.edges.left, a.edges.right, a.edges.roll) <
               std::tuple(-b.promise, b.edges.left, b.edges.right, b.edges.roll);
    });
    // Of those with the same edges the best. Where the vertical was measured, it tells which of those that
    // lean otherwise is meant, as judged later; else the points alone do.
    std::size_t kept = 0;
    for (const Hypothesis& next : hypotheses_) {
        if (kept >= most_hypotheses) break;
        const Ends ends = ends_of(view, next.edges);
        const double farthest = std::max(std::abs(ends.top), std::abs(ends.base));
        const bool known = std::any_of(
            hypotheses_.begin(), hypotheses_.begin() + static_cast<std::ptrdiff_t>(kept),
            [&](const Hypothesis& h) {
                return std::abs(h.edges.left - next.edges.left) < 2.0 * tolerance &&
                       std::abs(h.edges.right - next.edges.right) < 2.0 * tolerance &&
                       (!view.height() || std::abs(h.edges.roll - next.edges.roll) * farthest < tolerance);
            });
        if (!known) hypotheses_[kept++] = next;
    }
    hypotheses_.resize(kept);
}

UprightEdges UprightDetector::fitted(const UprightView& view, const UprightEdges& start,
                                     double tolerance) const {
    UprightEdges edges = start;
    for (const double near : {2.0 * tolerance, 1.3 * tolerance, tolerance}) {
        const Ends ends = ends_of(view, edges);
        Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  // left, right, roll
        Eigen::Vector3d pull = Eigen::Vector3d::Zero();
        const auto add = [&](const std::vector<UprightPoint>& points, double azimuth, int part) {
            for (const UprightPoint& p : points) {
                if (!(p.ray.slope < ends.top && p.ray.slope > ends.base)) continue;
                const double miss = p.ray.azimuth - azimuth - edges.roll * p.ray.slope;
                if (std::abs(miss) > near) continue;
                Eigen::Vector3d j(0.0, 0.0, p.ray.slope);
                j[part] = 1.0;
                information += j * j.transpose();
                pull += miss * j;
            }
        };
        add(seen_.left, edges.left, 0);
        add(seen_.right, edges.right, 1);
        if (!(information(0, 0) > 0.0) || !(information(1, 1) > 0.0)) return start;
        const double prior = tolerance * tolerance / (4.0 * roll_sigma_ * roll_sigma_);
        information(2, 2) += prior;
        pull[2] -= prior * edges.roll;
        const Eigen::Vector3d step = information.ldlt().solve(pull);
        if (!step.allFinite()) return start;
        edges.left += step[0];
        edges.right += step[1];
        edges.roll += step[2];
        if (!(edges.half_angle() > 0.0)) return start;
    }
    return edges;
}

bool UprightDetector::passes(const UprightEvidence& evidence) const {
    const auto& search = parameters_.search;
    constexpr int least_edge_rows = 3;
    const double edge = std::max<double>(least_edge_rows, search.least_edge * evidence.rows);
    return evidence.covered_rows >= search.least_rows &&
           evidence.covered_rows >= search.least_cover * evidence.rows && evidence.left_rows >= edge &&
           evidence.right_rows >= edge && evidence.score >= search.least_score * evidence.rows;
}

std::optional<Post> UprightDetector::post_of(const UprightPost& found, const UprightView& view,
                                             const Intrinsics& camera) const {
    Post post;
    const auto place = [&](double azimuth, double slope, Eigen::Vector2d& corner) {
        const auto pixel = view.pixel({azimuth + found.edges.roll * slope, slope});
        if (pixel) corner = *pixel;
        return pixel.has_value();
    };
    const double top = found.evidence.first_slope, base = found.evidence.last_slope;
    if (!(top > base) || !place(found.edges.left, top, post.left_top) ||
        !place(found.edges.left, base, post.left_base) || !place(found.edges.right, top, post.right_top) ||
        !place(found.edges.right, base, post.right_base))
        return std::nullopt;
    post.support_left = found.evidence.left_rows;
    post.support_right = found.evidence.right_rows;
    const auto sigma = [](int rows) { return 0.5 / std::sqrt(std::max(1, rows)); };  // px
    measure_post(post, camera, 2.0 * size_.radius, sigma(post.support_left), sigma(post.support_right),
                 parameters_.measurement);
    const double half_angle = found.edges.half_angle();
    const double by_width = post.distance_m;
    post.distance_m = size_.radius / std::sin(half_angle);
    // The covariance is of the same edges: in proportion.
    const double scale = post.distance_m / by_width;
    post.covariance(0, 0) *= scale * scale;
    post.covariance(0, 1) *= scale;
    post.covariance(1, 0) *= scale;
    if (!(post.distance_m > 0.0) || !std::isfinite(post.bearing_rad) || !post.covariance.allFinite())
        return std::nullopt;
    return post;
}

/// The edge with most points among those that no post has taken, as a line in the picture.
std::optional<EdgeLine> UprightDetector::free_edge(const std::vector<UprightPoint>& points, bool left,
                                                   double tolerance) {
    free_.clear();
    for (const UprightPoint& p : points) {
        const bool taken = std::any_of(taken_.begin(), taken_.end(), [&](const UprightPost& f) {
            const double edge = left ? f.edges.left : f.edges.right;
            return std::abs(p.ray.azimuth - edge - f.edges.roll * p.ray.slope) < 2.0 * tolerance;
        });
        if (!taken) free_.push_back(p);
    }
    const double reach = std::min(roll_sigmas * roll_sigma_, most_roll);
    constexpr double step = 0.01;
    int most = 0;
    double azimuth = 0.0, roll = 0.0;
    const auto try_roll = [&](double r) {
        votes_.find(free_, r, tolerance, parameters_.search.least_rows, 1, left_);
        if (!left_.empty() && left_[0].points > most)
            most = left_[0].points, azimuth = left_[0].azimuth, roll = r;
    };
    try_roll(0.0);
    for (int i = 1; i * step <= reach; ++i) {
        try_roll(i * step);
        try_roll(-i * step);
    }
    if (most == 0) return std::nullopt;
    edge_points_.clear();
    for (const UprightPoint& p : free_)
        if (std::abs(p.ray.azimuth - azimuth - roll * p.ray.slope) < 1.5 * tolerance)
            edge_points_.push_back(p.pixel);
    const auto line = fit_line(edge_points_);
    if (!line) return std::nullopt;
    return edge_line(*line, edge_points_);
}

void UprightDetector::add_cut_posts(const Candidates& candidates, const Intrinsics& camera,
                                    double tolerance) {
    if (!parameters_.cut_posts.report) return;
    constexpr double near_px = 5.0;  // as the paper's inlier distance
    for (const bool left : {true, false}) {
        const auto edge = free_edge(left ? seen_.left : seen_.right, left, tolerance);
        if (!edge) continue;
        auto post = post_with_one_edge(*edge, left ? EdgeSide::left : EdgeSide::right, candidates, near_px,
                                       parameters_.cut_posts);
        if (!post) continue;
        measure_post(*post, camera, 2.0 * size_.radius, 0.0, 0.0, parameters_.measurement);
        insert_from_left(posts_, *post);
    }
    if (!posts_.empty()) return;
    if (auto post = post_that_fills_image(candidates, parameters_.cut_posts)) {
        measure_post(*post, camera, 2.0 * size_.radius, 0.0, 0.0, parameters_.measurement);
        insert_from_left(posts_, *post);
    }
}

const std::vector<Post>& UprightDetector::detect(const Candidates& candidates, const Intrinsics& camera,
                                                 const std::optional<CameraPose>& pose) {
    posts_.clear();
    taken_.clear();
    found_.clear();
    fits_.clear();
    const auto view = UprightView::make(camera, pose, parameters_.search.level_sigma);
    if (!view) return posts_;
    seen_.take(candidates, *view);
    const double tolerance = parameters_.search.tolerance / camera.fx;
    roll_sigma_ =
        std::max(least_roll_sigma, std::hypot(view->attitude_sigma(), parameters_.search.lean_sigma));
    row_step_ = seen_.rows.size() > 1 ? static_cast<double>(seen_.rows.back() - seen_.rows.front()) /
                                            static_cast<double>(seen_.rows.size() - 1)
                                      : 1.0;
    view_scale_ = camera.fy;
    suggest(*view, tolerance);
    for (const Hypothesis& h : hypotheses_) {
        const UprightEdges edges = fitted(*view, h.edges, tolerance);
        if (std::abs(edges.roll) > 4.0 * roll_sigma_) continue;
        const bool judged = std::any_of(fits_.begin(), fits_.end(), [&](const UprightEdges& other) {
            const double same = 0.1 * tolerance;
            return std::abs(edges.left - other.left) < same && std::abs(edges.right - other.right) < same &&
                   std::abs(edges.roll - other.roll) < same;
        });
        if (judged) continue;
        fits_.push_back(edges);
        // What the fit moves it by is no reason to leave it.
        const double width = 2.0 * edges.half_angle();
        if (!(width >= 0.9 * narrowest_ && width <= 1.1 * widest_)) continue;
        UprightEvidence evidence = judge_.judge(seen_, *view, edges, 1.5 * tolerance);
        evidence.score -= cost_of_error(edges.roll, roll_sigma_);
        if (passes(evidence)) found_.push_back({edges, evidence});
    }
    std::sort(found_.begin(), found_.end(), [](const UprightPost& a, const UprightPost& b) {
        return std::tuple(-a.evidence.score, a.edges.left, a.edges.right, a.edges.roll) <
               std::tuple(-b.evidence.score, b.edges.left, b.edges.right, b.edges.roll);
    });
    const UprightDoubt doubt{view->attitude_sigma(), tolerance, 1.0 / camera.fx};
    if (const auto pair = pairs_.best(found_, doubt)) {
        const auto to_front = [&](std::size_t place, std::size_t from) {
            const auto begin = found_.begin() + static_cast<std::ptrdiff_t>(place);
            const auto at = found_.begin() + static_cast<std::ptrdiff_t>(from);
            std::rotate(begin, at, at + 1);
        };
        to_front(0, pair->first);
        to_front(1, pair->second);
    }
    for (const UprightPost& next : found_) {
        if (!std::all_of(taken_.begin(), taken_.end(),
                         [&](const UprightPost& f) { return pairs_.go_together(f, next, doubt); }))
            continue;
        const auto post = post_of(next, *view, camera);
        if (!post) continue;
        taken_.push_back(next);
        insert_from_left(posts_, *post);
    }
    add_cut_posts(candidates, camera, tolerance);
    assign_sides(posts_, candidates, parameters_.sides);
    return posts_;
}

}  // namespace goalmouth
