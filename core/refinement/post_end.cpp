#include "core/refinement/post_end.h"

#include "core/refinement/end_equations.h"
#include "core/refinement/normal_table.h"
#include "core/refinement/pixel_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace goalmouth {
namespace {

double square(double x) {
    return x * x;
}

const NormalTable& normal() {
    static const NormalTable table;
    return table;
}

/// Clear of an edge.
double clear_of(double blur) {
    return 2.2 * blur + 1.0;
}

/// Whether two colours are of one hue, `far` apart at most (chroma per luma), and about as bright: the same
/// surface, in shadow or out of it.
bool same_levels(const PairColour& a, const PairColour& b, float far) {
    constexpr float brightness = 2.0F;
    const float darker = std::max(1.0F, std::min(a[0], b[0]));
    return std::max(a[0], b[0]) < brightness * darker &&
           (a.tail<2>() / std::max(1.0F, a[0]) - b.tail<2>() / std::max(1.0F, b[0])).norm() < far;
}

constexpr float darkest = 16.0F;  // luma below which ratios mean nothing
constexpr float one_hue = 0.07F;
constexpr float mixed_hue = 0.14F;  // where a line may be in it

}  // namespace

PostEndFinder::PostEndFinder(YuyvView image, const Intrinsics& camera, const PostSilhouette& post,
                             const PostColour& colour, const PostEndSearch& search)
    : image_(image),
      camera_(camera),
      post_(post),
      colour_(colour),
      search_(search),
      sine_(std::sin(post.half_angle)) {}

double PostEndFinder::rim(double across) const {
    const double distance = 1.0 / sine_;  // in radii
    const double side = near_ * std::sqrt(std::max(0.0, 1.0 - across * across));
    const double ahead = std::sqrt(std::max(0.0, distance * distance - across * across));
    return (distance - near_) / (ahead - side);
}

std::optional<Eigen::Vector2d> PostEndFinder::pixel_at(double across, double slope) const {
    const double s = across * sine_;
    if (!(std::abs(s) < 0.9)) return std::nullopt;
    const Eigen::Vector3d ray = std::sqrt(1.0 - s * s) * post_.ahead + s * post_.right + slope * post_.up;
    const auto pixel = project(camera_, ray);
    if (!pixel || !pixel->allFinite()) return std::nullopt;
    return pixel;
}

bool PostEndFinder::same_surface(const PairColour& a, const PairColour& b, float far) const {
    if (colour_.response == CameraResponse::srgb)
        return same_levels(level_of_light(a), level_of_light(b), far);
    return same_levels(a, b, far);
}

std::optional<PairColour> PostEndFinder::colour_at(double across, double slope, int pairs) const {
    const auto pixel = pixel_at(across, slope);
    if (!pixel || !(pixel->cwiseAbs().maxCoeff() < 1e5)) return std::nullopt;
    const int pair = nearest_whole(0.5 * (pixel->x() - 0.5) + 0.5 * (pairs - 1));
    const int row = nearest_whole(pixel->y());
    if (pair - pairs + 1 < 0 || 2 * pair + 1 >= image_.width || row < 1 || row + 1 >= image_.height)
        return std::nullopt;
    PairColour sum = PairColour::Zero();
    for (int y = row - 1; y <= row + 1; ++y) {
        const PairRow colours(image_.row(y), image_.width / 2, colour_.response);
        for (int p = pair - pairs + 1; p <= pair; ++p) sum += colours[p];
    }
    return PairColour(sum / (3.0F * static_cast<float>(pairs)));
}

bool PostEndFinder::gather(double slope, double outwards, double per_px) {
    samples_.clear();
    gathered_outwards_ = 0.0;
    const double inner = 4.0 * search_.blur + 4.0, outer = clear_of(search_.blur) + 4.0;  // px
    const double most_across = std::clamp((radius_ - clear_of(search_.blur)) / radius_, 0.4, 0.6);
    double first_x = 1e9, last_x = -1e9, first_y = 1e9, last_y = -1e9;
    for (const double across : {-most_across, most_across}) {
        for (const double way : {-inner, outer}) {
            const auto corner = pixel_at(across, (slope + outwards * way * per_px) * rim(across));
            if (!corner) return false;
            first_x = std::min(first_x, corner->x()), last_x = std::max(last_x, corner->x());
            first_y = std::min(first_y, corner->y()), last_y = std::max(last_y, corner->y());
        }
    }
    constexpr double border = 1.0;  // px
    first_x = std::max(first_x, border), last_x = std::min(last_x, image_.width - 1.0 - border);
    first_y = std::max(first_y, border), last_y = std::min(last_y, image_.height - 1.0 - border);
    if (!(first_x < last_x) || !(first_y < last_y)) return false;
    constexpr int most_pairs = 6;  // of a row: they share what the background does there
    PixelRays rays(camera_);
    for (int row = static_cast<int>(std::ceil(first_y)); row <= static_cast<int>(last_y); ++row) {
        // Of a leaning post each row holds a part of its own.
        const PairRow colours(image_.row(row), image_.width / 2, colour_.response);
        const RowRay middle = rays.crossing(post_.right, 0.5 * (first_x + last_x), row);
        if (!(std::abs(middle.x) < 2.0 * camera_.width)) continue;
        const double reach = most_across * radius_ + std::numbers::sqrt2 * std::max(inner, outer);
        const int from = whole_above(0.5 * (std::max(first_x, middle.x - reach) - 0.5));
        const int to = whole_below(0.5 * (std::min(last_x, middle.x + reach) - 0.5));
        const int step = std::max(1, (to - from + most_pairs) / most_pairs);
        for (int pair = std::max(0, from); pair <= to && 2 * pair + 1 < image_.width; pair += step) {
            const RowRay ray = rays.at(2.0 * pair + 0.5, row);
            const double ahead = ray.ray.dot(post_.ahead), aside = ray.ray.dot(post_.right);
            const double level = std::sqrt(ahead * ahead + aside * aside);
            const double across = aside / (level * sine_);
            if (!(std::abs(across) <= most_across)) continue;
            const double here = ray.ray.dot(post_.up) / (level * rim(across));
            const double way = outwards * (here - slope) / per_px;
            if (way < -inner || way > outer) continue;
            samples_.push_back({way, 0.0, across, row, colours[pair] - colour_.mean});
        }
    }
    return true;
}

std::optional<PostEndFinder::Step> PostEndFinder::fit_step(double start_blur,
                                                           const Eigen::Matrix3f& contrast) {
    Step step;
    step.blur = start_blur;
    const double clear = clear_of(search_.blur);
    int beyond = 0, before = 0;
    for (const Sample& s : samples_) {
        if (s.way > clear) step.beyond += s.offset, ++beyond;
        if (s.way < -clear) ++before;
    }
    constexpr int least = 4;
    if (beyond < least || before < least) return std::nullopt;
    step.beyond /= static_cast<float>(beyond);
    const Eigen::Vector3f weights = contrast * step.beyond;
    const float strength = step.beyond.dot(weights);
    if (!(strength >= static_cast<float>(square(search_.least_contrast)))) return std::nullopt;
    const Eigen::Vector3f w = weights / std::sqrt(strength);
    for (Sample& s : samples_) s.value = static_cast<double>(w.dot(s.offset));
    ways_.assign(samples_.size());
    values_.assign(samples_.size());
    for (std::size_t i = 0; i < samples_.size(); ++i)
        ways_[i] = samples_[i].way, values_[i] = samples_[i].value;

    step.outer = std::sqrt(static_cast<double>(strength));
    constexpr double blur_known =
        0.3;  // sigma of the logarithm: movement blurs edges along and across unlike
    const NormalTable& normal_table = normal();
    Eigen::Matrix4d information = Eigen::Matrix4d::Identity();
    double squares = 0.0;
    for (int round = 0; round < 8; ++round) {
        const EndEquations equations = end_equations(
            ways_, values_, samples_.size(), {step.place, step.blur, step.inner, step.outer}, normal_table);
        information = equations.information;
        Eigen::Vector4d pull = equations.pull;
        squares = equations.squares;
        const double variance = squares / static_cast<double>(samples_.size());
        information(1, 1) += variance / square(blur_known);
        pull[1] -= variance / square(blur_known) * std::log(step.blur / start_blur);
        const Eigen::Vector4d change = information.ldlt().solve(pull);
        if (!change.allFinite()) return std::nullopt;
        step.place += std::clamp(change[0], -1.5, 1.5);
        step.blur *= std::exp(std::clamp(change[1], -0.3, 0.3));
        step.inner += change[2];
        step.outer += change[3];
        constexpr double still = 0.01;  // px; the step after that moves it by far less than the floor
        if (std::abs(change[0]) < still) break;
    }
    if (!(std::abs(step.blur / start_blur) < 3.0) || !(step.blur > 0.3)) return std::nullopt;

    // Pixels of one row share what the background does there.
    double rows = 0.0, of_row = 0.0, freedom = static_cast<double>(samples_.size()) - 4.0;
    std::array<double, 2> half_pull{}, half_information{};
    int row = -1;
    squares = 0.0;
    for (const Sample& s : samples_) {
        const double z = (s.way - step.place) / step.blur;
        const NormalTable::Normal at = normal_table.at(z);
        const double miss = s.value - step.inner - (step.outer - step.inner) * at.below;
        const double slope = -at.density * (step.outer - step.inner) / step.blur;
        if (s.row != row) rows += square(of_row), of_row = 0.0, row = s.row;
        of_row += miss;
        squares += square(miss);
        const std::size_t half = s.across < 0.0 ? 0 : 1;
        half_pull[half] += slope * miss;
        half_information[half] += square(slope);
    }
    rows += square(of_row);
    if (!(freedom > 4.0) || !(squares > 0.0)) return std::nullopt;
    const double variance = std::max(squares / freedom, 0.5) * std::max(1.0, rows / squares);
    const Eigen::Matrix4d covariance = information.inverse();
    step.sigma = std::sqrt(variance * covariance(0, 0));
    // What lies across the end crosses it at an angle, mostly.
    if (half_information[0] > 0.0 && half_information[1] > 0.0) {
        const double apart = half_pull[1] / half_information[1] - half_pull[0] / half_information[0];
        const double sigma = std::sqrt(variance * (1.0 / half_information[0] + 1.0 / half_information[1]));
        if (std::abs(apart) > 4.0 * sigma + 4.0 * search_.floor) return std::nullopt;
    }
    // The post's colour inside, and no more than noise and texture about the step.
    const double height = step.outer - step.inner;
    if (!(height > 0.5 * std::sqrt(static_cast<double>(strength)))) return std::nullopt;
    if (std::abs(step.inner) > 2.0 + 0.15 * height) return std::nullopt;
    constexpr double most_misfit = 9.0;
    if (!(squares / freedom < most_misfit) || !(step.sigma < 1.0)) return std::nullopt;
    return step;
}

std::optional<PostEnd> PostEndFinder::find(double slope, double outwards, const Eigen::Matrix3f& contrast) {
    if (outwards < 0.0 && !(slope < 0.0)) return std::nullopt;  // the ground is below a camera
    near_ = outwards > 0.0 && slope < 0.0 ? -1.0 : 1.0;
    constexpr double little = 1e-4;
    const auto here = pixel_at(0.0, slope), there = pixel_at(0.0, slope + little);
    const auto left = pixel_at(-1.0, slope), right = pixel_at(1.0, slope);
    if (!here || !there || !left || !right) return std::nullopt;
    const Eigen::Vector2d along = (*there - *here) / little;
    PostEnd end;
    end.per_px = 1.0 / along.norm();
    radius_ = 0.5 * (*right - *left).norm();
    // Near to where it was looked for before the same pixels are asked once more.
    constexpr double near = 1.0;  // px
    const double moved = outwards * (slope - gathered_at_) / end.per_px;
    if (outwards == gathered_outwards_ && std::abs(moved) < near)
        for (Sample& s : samples_) s.way -= moved;
    else if (!gather(slope, outwards, end.per_px))
        return std::nullopt;
    gathered_at_ = slope, gathered_outwards_ = outwards;
    // A pair of pixels is as wide as one is high, and once more along the row.
    const double leaning = along.x() * end.per_px;
    const auto step =
        fit_step(std::sqrt(square(search_.blur) + 1.0 / 12.0 + 0.25 * square(leaning)), contrast);
    constexpr double farthest = 4.0;  // px
    if (!step || std::abs(step->place) > farthest) return std::nullopt;
    end.slope = slope + outwards * step->place * end.per_px;
    end.sigma = std::hypot(step->sigma, search_.floor);
    end.beyond = step->beyond + colour_.mean;
    const auto pixel = pixel_at(0.0, end.slope);
    if (!pixel) return std::nullopt;
    end.pixel = *pixel;
    return end;
}

std::optional<double> PostEndFinder::slope_at(int row) const {
    PixelRays rays(camera_);
    const RowRay start = rays.crossing(post_.right, camera_.cx, row);
    if (!std::isfinite(start.x) || std::abs(start.x) > 2.0 * camera_.width) return std::nullopt;
    return start.ray.dot(post_.up) / start.ray.dot(post_.ahead);
}

std::optional<PairColour> PostEndFinder::ground_about(const PostEnd& end) const {
    std::vector<PairColour> colours;
    for (const double below : {0.3, 0.7, 1.2, 2.0}) {
        for (const double across : {-5.0, -2.5, 0.0, 2.5, 5.0}) {
            const double way = 2.0 * below * radius_ + clear_of(search_.blur);
            const auto colour = colour_at(across, end.slope - way * end.per_px);
            if (colour) colours.push_back(*colour);
        }
    }
    PairColour ground = PairColour::Zero();
    std::ptrdiff_t most = 0;
    for (const PairColour& colour : colours) {
        const auto alike = std::count_if(colours.begin(), colours.end(), [&](const PairColour& other) {
            return same_surface(colour, other, one_hue);
        });
        if (alike > most) most = alike, ground = colour;
    }
    constexpr std::size_t least = 6;
    constexpr double most_of_it = 0.75;  // lines and balls lie on it
    const auto seen = static_cast<double>(colours.size());
    if (colours.size() < least || static_cast<double>(most) < most_of_it * seen) return std::nullopt;
    // What stands before a foot seldom reaches as far to both sides.
    const double clear = clear_of(search_.blur) + 1.0;
    for (const double across : {-5.0, -2.5, 2.5, 5.0}) {
        const auto beside = colour_at(across, end.slope - clear * end.per_px);
        if (beside && !same_surface(*beside, ground, mixed_hue)) return std::nullopt;
    }
    return ground;
}

bool PostEndFinder::ends_free(const PostEnd& end) const {
    const double clear = clear_of(search_.blur) + 1.0;
    const double inside = std::max(0.4, 1.0 - (clear + 1.0) / radius_);
    const double outside = 1.0 + (clear + 1.0) / radius_;
    const double below = end.slope - clear * end.per_px, above = end.slope + clear * end.per_px;
    const auto of_post = [&](const PairColour& colour) {
        constexpr float alike = 14.0F;  // of a pair of one colour, at most
        return colour_.difference(colour) < alike * colour_.spread;
    };
    bool free = false;
    for (const double side : {-1.0, 1.0}) {
        const auto in_it = colour_at(side * inside, below, 1);
        if (!in_it || !of_post(*in_it)) return false;
        const auto beside = colour_at(side * outside, below), over = colour_at(side * outside, above);
        if (!beside || !over) continue;
        free = free || (!of_post(*beside) && same_surface(*beside, *over, one_hue));
    }
    return free;
}

std::optional<PostEnd> PostEndFinder::base(int row) {
    const auto slope = slope_at(row);
    if (!slope) return std::nullopt;
    const auto roughly = find(*slope, -1.0, colour_.contrast);
    if (!roughly) return std::nullopt;
    const auto ground = ground_about(*roughly);
    if (!ground || (*ground)[0] < grey_as_read(darkest, colour_.response) ||
        !same_surface(roughly->beyond, *ground, mixed_hue))
        return std::nullopt;
    const auto end = find(roughly->slope, -1.0, contrast_matrix(colour_.noise, *ground / (*ground)[0]));
    if (!end || !same_surface(end->beyond, *ground, mixed_hue)) return std::nullopt;
    return end;
}

std::optional<PostEnd> PostEndFinder::top(int row) {
    const auto slope = slope_at(row);
    if (!slope) return std::nullopt;
    const auto roughly = find(*slope, 1.0, colour_.contrast);
    if (!roughly) return std::nullopt;
    auto end = find(roughly->slope, 1.0, colour_.contrast);
    if (!end || !ends_free(*end)) return std::nullopt;
    // One step between two colours is in one place however they are told apart.
    Eigen::Matrix3f contrast = colour_.noise.inverse();
    if (end->beyond[0] >= grey_as_read(darkest, colour_.response))
        contrast = contrast_matrix(colour_.noise, end->beyond / end->beyond[0]);
    if (const auto other = find(end->slope, 1.0, contrast)) {
        const double apart = std::abs(other->slope - end->slope) / end->per_px;
        if (apart > 4.0 * std::hypot(end->sigma, other->sigma)) return std::nullopt;
        end->sigma = std::hypot(end->sigma, 0.5 * apart);
    }
    return end;
}

}  // namespace goalmouth
