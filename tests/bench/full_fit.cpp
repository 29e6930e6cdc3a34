#include "tests/bench/full_fit.h"

#include "core/refinement/pixel_rays.h"
#include "core/refinement/post_colour.h"
#include "core/refinement/refinement_parameters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <unsupported/Eigen/LevenbergMarquardt>
#include <utility>
#include <vector>

namespace goalmouth::bench {
namespace {

constexpr double window = 10.0;      // px to either side of an edge: RANSAC's inlier distance and a wide blur
constexpr double left_out = 0.03;    // of the edges' length at each end
constexpr int least_rows = 8;        // px
constexpr double least_width = 3.0;  // px
constexpr double first_blur = 1.0;   // px
constexpr int parts = 4;             // of a SilhouetteStep
constexpr int unknowns = parts + 1;  // and the logarithm of the blur
constexpr std::size_t components = 2;  // of a pair's colour

/// One row about one edge.
struct Strip {
    OutlineSide side;
    double outwards;           // −1: left edge, 1: right edge
    RowRay ray;                // where the edge is supposed
    double first;              // px, middle of the first pair
    std::size_t begin, pairs;  // of the values
};

double x_on(const Eigen::Vector2d& top, const Eigen::Vector2d& base, double y) {
    return std::lerp(top.x(), base.x(), (y - top.y()) / (base.y() - top.y()));
}

Eigen::Vector3d ray_through(const Intrinsics& camera, const Eigen::Vector2d& pixel) {
    return normalised_from_pixel(camera, pixel).homogeneous();
}

/// All that is fitted to.
struct Pixels {
    std::vector<Strip> strips;
    std::vector<std::array<double, components>> values;
    std::array<double, components> noise{};
    int rows = 0;
};

Eigen::Vector3d mean_colour(YuyvView image, const Post& post, int first, int last) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double count = 0.0;
    for (int y = first; y <= last; ++y) {
        const double left = x_on(post.left_top, post.left_base, y);
        const double right = x_on(post.right_top, post.right_base, y);
        const int from = std::max(0, static_cast<int>(0.75 * left + 0.25 * right) / 2);
        const int to = std::min(image.width / 2 - 1, static_cast<int>(0.25 * left + 0.75 * right) / 2);
        const PairRow row(image.row(y), image.width / 2, CameraResponse::linear);
        for (int pair = from; pair <= to; ++pair, count += 1.0) sum += row[pair].cast<double>();
    }
    return count > 0.0 ? Eigen::Vector3d(sum / count) : Eigen::Vector3d::UnitX();
}

/// Two directions square to the post's colour and to each other.
std::array<Eigen::Vector3d, components> square_to(const Eigen::Vector3d& colour) {
    const Eigen::Vector3d other = colour.unitOrthogonal();
    return {other, colour.normalized().cross(other)};
}

/// σ of one value, from how the rows of a strip differ from the next ones'.
std::array<double, components> noise_of(const Pixels& pixels) {
    std::array<double, components> noise{};
    for (std::size_t c = 0; c < components; ++c) {
        std::vector<double> differences;
        for (std::size_t i = 2; i < pixels.strips.size(); ++i) {
            const Strip& a = pixels.strips[i - 2];  // of the same side
            const Strip& b = pixels.strips[i];
            if (a.first != b.first || a.side != b.side) continue;
            for (std::size_t j = 0; j < std::min(a.pairs, b.pairs); ++j)
                differences.push_back(
                    std::abs(pixels.values[a.begin + j][c] - pixels.values[b.begin + j][c]));
        }
        if (differences.empty()) differences.push_back(1.0);
        const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
        std::nth_element(differences.begin(), middle, differences.end());
        // Normal differences: median |d| = 0.6745 · √2 σ. Rounding to whole numbers is noise, too.
        noise[c] = std::max(*middle / (0.6745 * std::numbers::sqrt2), std::sqrt(1.0 / 12.0));
    }
    return noise;
}

Pixels gather(YuyvView image, const Intrinsics& camera, const Post& post, int first, int last) {
    Pixels pixels;
    const auto directions = square_to(mean_colour(image, post, first, last));
    for (int y = first; y <= last; ++y) {
        const double left = x_on(post.left_top, post.left_base, y);
        const double right = x_on(post.right_top, post.right_base, y);
        const double inner = std::min(window, 0.5 * (right - left));
        for (const auto& [side, edge, outwards] :
             {std::tuple(OutlineSide::left, left, -1.0), std::tuple(OutlineSide::right, right, 1.0)}) {
            const double from = edge - (outwards > 0.0 ? inner : window);
            const double to = edge + (outwards > 0.0 ? window : inner);
            const int first_pair = static_cast<int>(std::ceil(0.5 * (from - 0.5)));
            const int last_pair = static_cast<int>(std::floor(0.5 * (to - 0.5)));
            if (first_pair < 0 || 2 * last_pair + 1 >= image.width) continue;
            Strip strip;
            strip.side = side;
            strip.outwards = outwards;
            strip.first = 2.0 * first_pair + 0.5;
            strip.begin = pixels.values.size();
            strip.pairs = static_cast<std::size_t>(std::max(0, last_pair - first_pair + 1));
            strip.ray.x = edge;
            strip.ray.ray = ray_through(camera, {edge, y});
            strip.ray.slope = ray_through(camera, {edge + 0.5, y}) - ray_through(camera, {edge - 0.5, y});
            const PairRow row(image.row(y), image.width / 2, CameraResponse::linear);
            for (int pair = first_pair; pair <= last_pair; ++pair) {
                const Eigen::Vector3d colour = row[pair].cast<double>();
                pixels.values.push_back({directions[0].dot(colour), directions[1].dot(colour)});
            }
            pixels.strips.push_back(strip);
        }
        ++pixels.rows;
    }
    pixels.noise = noise_of(pixels);
    return pixels;
}

struct Edge {
    double step;   // 0 inside … 1 outside
    double slope;  // per px outwards
    double blur;   // per px of σ
};

/// x [px] outwards from the edge to a pair's middle.
Edge edge_at(double x, double sigma) {
    const auto below = [](double u) { return 0.5 * std::erfc(-u / std::numbers::sqrt2); };
    const auto density = [](double u) { return std::exp(-0.5 * u * u) / std::sqrt(2.0 * std::numbers::pi); };
    const double before = (x - 1.0) / sigma;
    const double behind = (x + 1.0) / sigma;
    const double p_before = below(before);
    const double p_behind = below(behind);
    const double d_before = density(before);
    const double d_behind = density(behind);
    return {0.5 * sigma * (behind * p_behind + d_behind - before * p_before - d_before),
            0.5 * (p_behind - p_before), 0.5 * (d_behind - d_before)};
}

/// What is left of a strip's values, and how it changes.
class Residuals : public Eigen::DenseFunctor<double> {
  public:
    Residuals(const Pixels& pixels, const PostSilhouette& start, double lean_sigma)
        : DenseFunctor(unknowns, static_cast<int>(components * pixels.values.size()) + 1),
          pixels_(pixels),
          start_(start),
          lean_sigma_(lean_sigma) {}

    int operator()(const InputType& x, ValueType& residuals) const {
        each_strip(x, [&](const Strip& strip, const Fitted& fit, const auto&) {
            for (std::size_t j = 0; j < strip.pairs; ++j)
                for (std::size_t c = 0; c < components; ++c)
                    residuals[index(strip, j, c)] = fit.left[j][c] / pixels_.noise[c];
        });
        residuals[values() - 1] = x[silhouette_part::lean] / lean_sigma_;
        return 0;
    }

    int df(const InputType& x, JacobianType& jacobian) const {
        each_strip(x, [&](const Strip& strip, const Fitted& fit, const PostSilhouette& post) {
            const Eigen::Vector3d plane = post.plane(strip.side);
            const double cut = plane.dot(strip.ray.slope);
            const double crossing = strip.ray.crossing(plane);
            const Eigen::Vector3d ray = strip.ray.ray + (crossing - strip.ray.x) * strip.ray.slope;
            const Eigen::RowVector4d change =
                -ray.transpose() * post.plane_change(strip.side) / cut;  // of the crossing
            for (std::size_t j = 0; j < strip.pairs; ++j) {
                for (std::size_t c = 0; c < components; ++c) {
                    const double contrast = fit.contrast[c] / pixels_.noise[c];
                    const Eigen::Index row = index(strip, j, c);
                    jacobian.row(row).head<parts>() = contrast * strip.outwards * fit.slope[j] * change;
                    jacobian(row, parts) = -contrast * fit.blur[j] * std::exp(x[parts]);
                }
            }
        });
        jacobian.row(values() - 1).setZero();
        jacobian(values() - 1, silhouette_part::lean) = 1.0 / lean_sigma_;
        return 0;
    }

  private:
    /// A strip's levels solved for: what is left of its values and of the edge's derivatives.
    struct Fitted {
        std::array<double, components> contrast{};  // outside less inside
        std::vector<std::array<double, components>> left;
        std::vector<double> slope, blur;
    };

    static Eigen::Index index(const Strip& strip, std::size_t pair, std::size_t component) {
        return static_cast<Eigen::Index>(components * (strip.begin + pair) + component);
    }

    template <class Visit>
    void each_strip(const InputType& x, Visit visit) const {
        const PostSilhouette post = start_.moved(x.head<parts>());
        const double sigma = std::exp(x[parts]);
        const std::array<Eigen::Vector3d, 2> planes = {post.plane(OutlineSide::left),
                                                       post.plane(OutlineSide::right)};
        std::vector<double> step;
        Fitted fit;
        for (const Strip& strip : pixels_.strips) {
            const double crossing = strip.ray.crossing(planes[strip.side == OutlineSide::left ? 0 : 1]);
            step.resize(strip.pairs);
            fit.left.resize(strip.pairs);
            fit.slope.resize(strip.pairs);
            fit.blur.resize(strip.pairs);
            // The span of 1 and the step is that of the inner and the outer level's share.
            const auto n = static_cast<double>(strip.pairs);
            double mean = 0.0;
            for (std::size_t j = 0; j < strip.pairs; ++j) {
                const double middle = strip.first + 2.0 * static_cast<double>(j);
                const Edge edge = edge_at(strip.outwards * (middle - crossing), sigma);
                step[j] = edge.step;
                fit.slope[j] = edge.slope;
                fit.blur[j] = edge.blur;
                mean += edge.step / n;
            }
            double square = 0.0;
            for (double& each : step) {
                each -= mean;
                square += each * each;
            }
            const bool crossed = square > 1e-3;  // else one side alone is in sight
            const auto take_span = [&](auto at) {
                double constant = 0.0;
                double along = 0.0;
                for (std::size_t j = 0; j < strip.pairs; ++j) {
                    constant += at(j) / n;
                    along += at(j) * step[j];
                }
                along = crossed ? along / square : 0.0;
                for (std::size_t j = 0; j < strip.pairs; ++j) at(j) -= constant + along * step[j];
                return along;
            };
            for (std::size_t c = 0; c < components; ++c) {
                for (std::size_t j = 0; j < strip.pairs; ++j)
                    fit.left[j][c] = pixels_.values[strip.begin + j][c];
                fit.contrast[c] = take_span([&](std::size_t j) -> double& { return fit.left[j][c]; });
            }
            take_span([&](std::size_t j) -> double& { return fit.slope[j]; });
            take_span([&](std::size_t j) -> double& { return fit.blur[j]; });
            visit(strip, fit, post);
        }
    }

    const Pixels& pixels_;
    PostSilhouette start_;
    double lean_sigma_;
};

/// The plane through an edge's ends, its normal towards a point of the post.
Eigen::Vector3d plane_through(const Intrinsics& camera, const Eigen::Vector2d& top,
                              const Eigen::Vector2d& base, const Eigen::Vector2d& inside) {
    const Eigen::Vector3d normal = ray_through(camera, top).cross(ray_through(camera, base)).normalized();
    return normal.dot(ray_through(camera, inside)) < 0.0 ? Eigen::Vector3d(-normal) : normal;
}

struct Vertical {
    Eigen::Vector3d up = -Eigen::Vector3d::UnitY();
    double sigma = 0.0;  // rad
};

/// As the refiner takes it by default.
Vertical vertical_of(const std::optional<CameraPose>& pose) {
    const RefinementParameters parameters;
    if (!pose) return {-Eigen::Vector3d::UnitY(), std::hypot(parameters.level_sigma, parameters.tilt_floor)};
    const double square = pose->covariance.bottomRightCorner<3, 3>().trace() / 3.0;
    return {pose->T_BC.linear().transpose() * Eigen::Vector3d::UnitZ(),
            std::sqrt(square + parameters.tilt_floor * parameters.tilt_floor)};
}

}  // namespace

std::optional<FullFit> fit_all_pixels(YuyvView image, const Intrinsics& camera, const Post& start,
                                      double diameter, const std::optional<CameraPose>& pose) {
    if (start.has(post_flag::left_edge_missing | post_flag::right_edge_missing | post_flag::fills_image))
        return std::nullopt;
    const double top = std::max(start.left_top.y(), start.right_top.y());
    const double base = std::min(start.left_base.y(), start.right_base.y());
    const double hem = left_out * (base - top);
    const int first = std::max(0, static_cast<int>(std::ceil(top + hem)));
    const int last = std::min(image.height - 1, static_cast<int>(std::floor(base - hem)));
    if (last - first + 1 < least_rows) return std::nullopt;
    for (const int y : {first, last})
        if (x_on(start.right_top, start.right_base, y) - x_on(start.left_top, start.left_base, y) <
            least_width)
            return std::nullopt;

    const Vertical vertical = vertical_of(pose);
    const Eigen::Vector2d middle =
        0.25 * (start.left_top + start.left_base + start.right_top + start.right_base);
    const PostSilhouette silhouette =
        silhouette_between(plane_through(camera, start.left_top, start.left_base, middle),
                           plane_through(camera, start.right_top, start.right_base, middle), vertical.up);
    const Pixels pixels = gather(image, camera, start, first, last);
    if (pixels.values.size() < 4 * least_rows) return std::nullopt;

    Residuals residuals(pixels, silhouette, vertical.sigma);
    Eigen::LevenbergMarquardt<Residuals> search(residuals);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(unknowns);
    x[parts] = std::log(first_blur);
    const auto end = search.minimize(x);
    if (end == Eigen::LevenbergMarquardtSpace::ImproperInputParameters ||
        end == Eigen::LevenbergMarquardtSpace::TooManyFunctionEvaluation || !x.allFinite())
        return std::nullopt;

    FullFit fit;
    fit.post = silhouette.moved(x.head<parts>());
    if (!(fit.post.half_angle > 0.0)) return std::nullopt;
    fit.distance = 0.5 * diameter / std::sin(fit.post.half_angle);
    fit.blur = std::exp(x[parts]);
    fit.rows = pixels.rows;
    fit.values = residuals.values();
    fit.evaluations = static_cast<int>(search.nfev());
    Eigen::MatrixXd jacobian(residuals.values(), unknowns);
    residuals.df(x, jacobian);
    const Eigen::MatrixXd covariance = (jacobian.transpose() * jacobian).inverse();
    // Two levels of each strip and component were solved for.
    const double freedom =
        fit.values - unknowns - 2.0 * components * static_cast<double>(pixels.strips.size());
    const double misfit = search.fvec().squaredNorm() / std::max(1.0, freedom);
    fit.sigma = fit.distance / std::tan(fit.post.half_angle) *
                std::sqrt(misfit * covariance(silhouette_part::half_angle, silhouette_part::half_angle));
    if (!std::isfinite(fit.sigma)) return std::nullopt;
    return fit;
}

}  // namespace goalmouth::bench
