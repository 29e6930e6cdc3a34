#include "core/refinement/silhouette_fit.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace goalmouth {
namespace {

constexpr std::array<OutlineSide, 2> sides = {OutlineSide::left, OutlineSide::right};
constexpr double narrowest_blur = 0.3, widest_blur = 6.0;

double outwards(std::size_t side) {
    return side == 0 ? -1.0 : 1.0;
}

/// Angle from the prior's up to the silhouette's within its middle plane, in the sense of `lean`.
double lean_from(const Eigen::Vector3d& up, const PostSilhouette& post) {
    const Eigen::Vector3d in_plane = up - up.dot(post.right) * post.right;
    return std::atan2(post.up.dot(post.right.cross(in_plane)), post.up.dot(in_plane));
}

/// The same about the line of sight, in the sense of `roll`.
double roll_from(const Eigen::Vector3d& up, const PostSilhouette& post) {
    const Eigen::Vector3d across = up - up.dot(post.ahead) * post.ahead;
    return std::atan2(post.up.dot(post.ahead.cross(across)), post.up.dot(across));
}

/// Rows that share an error claim far more than they know: no post stands so that the measured vertical is
/// off by more than this many of its sigmas.
constexpr double steepest = 3.0;

/// The step that information and pull ask for, but for a lean that no more than turns a little: of a narrow
/// post edges hardly tell it, and far off it means nothing.
SilhouetteStep step_of(const Eigen::Matrix4d& information, const SilhouetteStep& pull) {
    constexpr double most = 0.15;  // rad
    using silhouette_part::lean;
    SilhouetteStep step = information.ldlt().solve(pull);
    if (!(std::abs(step[lean]) > most)) return step;
    const double turn = std::copysign(most, step[lean]);
    Eigen::Matrix4d others = information;
    others.row(lean).setZero();
    others.col(lean).setZero();
    others(lean, lean) = 1.0;
    SilhouetteStep rest = pull - turn * information.col(lean);
    rest[lean] = turn;
    return others.ldlt().solve(rest);
}

PostSilhouette upright(const PostSilhouette& post, const SilhouettePrior& prior) {
    SilhouetteStep back = SilhouetteStep::Zero();
    const double lean = lean_from(prior.up, post), roll = roll_from(prior.up, post);
    back[silhouette_part::lean] =
        std::clamp(lean, -steepest * prior.lean_sigma, steepest * prior.lean_sigma) - lean;
    back[silhouette_part::roll] =
        std::clamp(roll, -steepest * prior.roll_sigma, steepest * prior.roll_sigma) - roll;
    return back.isZero() ? post : post.moved(back);
}

}  // namespace

double SilhouetteFitter::other_edge(const SilhouetteFit& state, std::size_t side, std::size_t row,
                                    double here) const {
    const double width = outwards(1 - side) * (crossing(rows_[1 - side][row], 1 - side) - here);
    return width < 10.0 * state.blur + 4.0 ? std::max(width, 1.0) : 0.0;
}

void SilhouetteFitter::measure(const SilhouetteFit& state, BlurEvidence* blur) {
    for (std::size_t side = 0; side < 2; ++side) {
        if (!edges_[side]) continue;
        for (std::size_t i = 0; i < rows_[side].size(); ++i) {
            EdgeRow& row = rows_[side][i];
            if (!row.seen) continue;
            const double here = crossing(row, side);
            row.edge = static_cast<float>(here);
            measure_row(row, profile_, here, outwards(side), other_edge(state, side, i, here),
                        state.noise[side], blur);
        }
    }
}

void SilhouetteFitter::smooth(const SilhouetteFit& state) {
    for (std::size_t side = 0; side < 2; ++side)
        if (edges_[side]) smoother_.smooth(rows_[side], state.noise[side]);
}

void SilhouetteFitter::measure_apart(const SilhouetteFit& state) {
    constexpr float apart = 0.4F, reach = 3.0F;  // px
    for (std::size_t side = 0; side < 2; ++side) {
        for (std::size_t i = 0; i < rows_[side].size(); ++i) {
            EdgeRow& row = rows_[side][i];
            if (!row.seen || !(std::abs(row.offset) > apart)) continue;
            const EdgeRow before = row;
            const double here = crossing(row, side);
            double own = here;
            for (int round = 0; round < 3; ++round) {
                own += outwards(side) * static_cast<double>(std::clamp(row.offset, -1.0F, 1.0F));
                if (!(std::abs(own - here) < static_cast<double>(reach))) break;
                measure_row(row, profile_, own, outwards(side), other_edge(state, side, i, own),
                            state.noise[side], nullptr);
            }
            const double offset = outwards(side) * (own - here) +
                                  static_cast<double>(std::abs(row.offset) < 1.0F ? row.offset : 0.0F);
            if (!(std::abs(offset) < static_cast<double>(reach)) || !(row.information > 0.0F)) {
                row = before;
                continue;
            }
            row.offset = static_cast<float>(offset);
        }
    }
}

void SilhouetteFitter::turns(const SilhouetteFit& state) {
    for (std::size_t side = 0; side < 2; ++side) {
        const Eigen::Vector3d change = state.post.plane_change(sides[side]).col(silhouette_part::roll);
        for (EdgeRow& row : rows_[side]) {
            const double miss = crossing(row, side) - row.ray.x;
            const Eigen::Vector3d ray = row.ray.ray + miss * row.ray.slope;
            row.turn =
                static_cast<float>(-outwards(side) * change.dot(ray) / planes_[side].dot(row.ray.slope));
        }
    }
}

void SilhouetteFitter::fit_blur(SilhouetteFit& state, BlurEvidence& evidence) {
    // The share lies between 0 and 1: what is known of it before.
    constexpr double share_sigma = 0.5;
    Eigen::Matrix2d information = evidence.information;
    information(1, 0) = information(0, 1);
    information(1, 1) += 1.0 / (share_sigma * share_sigma);
    evidence.pull[1] -= (state.digital - 0.5) / (share_sigma * share_sigma);
    const Eigen::Vector2d change = information.ldlt().solve(evidence.pull);
    if (!change.allFinite()) return;
    state.blur = std::clamp(state.blur + std::clamp(change[0], -0.3 * state.blur, state.blur), narrowest_blur,
                            widest_blur);
    state.digital = std::clamp(state.digital + change[1], 0.0, 1.0);
}

SilhouetteFit SilhouetteFitter::fit(YuyvView image, const Intrinsics& camera, const PostColour& colour,
                                    const PostSilhouette& start, const SilhouettePrior& prior,
                                    const RowLayout& layout, const std::array<bool, 2>& edges,
                                    double least_contrast) {
    constexpr int most_iterations = 10;
    constexpr int most_readings = 3;
    constexpr int settled = 5;
    SilhouetteFit state;
    state.post = start;
    state.blur = 0.9;
    edges_ = edges;
    RowLayout reading = layout;
    int readings = 0;
    bool read_anew = true;
    Information information = Information::Zero(), prior_information = Information::Zero();
    SilhouetteStep pull = SilhouetteStep::Zero(), prior_pull = SilhouetteStep::Zero();
    constexpr double rough = edge_roughness * edge_roughness;
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
        for (std::size_t side = 0; side < 2; ++side) planes_[side] = state.post.plane(sides[side]);
        profile_.set_blur(state.blur, state.digital);
        const int readings_before = readings;
        if (read_anew) {
            reading.inner = 3.0 * state.blur + 2.0;
            reading.outer = 4.0 * state.blur + 3.0;
            reader_.read(image, camera, state.post, colour, reading, state.blur, least_contrast, rows_);
            for (std::size_t side = 0; side < 2; ++side)
                for (EdgeRow& row : rows_[side]) row.seen = row.seen && edges_[side], row.weight = 1.0F;
            measure(state, nullptr);
            smooth(state);
            ++readings;
            read_anew = false;
        }
        BlurEvidence blur;
        const bool just_read = readings_before != readings;
        const bool blur_open = iteration > 0 && iteration <= settled;
        measure(state, blur_open ? &blur : nullptr);
        const bool ask_all = iteration == 2 || iteration == 4 || (just_read && iteration > 4);
        if (ask_all) measure_apart(state);
        // Rows that come and go with the step would keep it from settling.
        if (iteration < settled || just_read) gate_.weigh(rows_, state.noise, profile_, iteration > 0);
        if (ask_all) {
            turns(state);
            state.consensus = consensus_.find(rows_, roll_from(prior.up, state.post), prior.roll_sigma);
        }
        smooth(state);

        information.setZero();
        pull.setZero();
        for (std::size_t side = 0; side < 2; ++side) {
            if (!edges_[side]) continue;
            const Eigen::Matrix<double, 3, 4> change = state.post.plane_change(sides[side]);
            for (const EdgeRow& row : rows_[side]) {
                if (!row.seen || !(row.weight > 0.0F)) continue;
                const Eigen::Vector3d ray = row.ray.ray + (crossing(row, side) - row.ray.x) * row.ray.slope;
                const SilhouetteStep j = -(change.transpose() * ray) / planes_[side].dot(row.ray.slope);
                const double w =
                    static_cast<double>(row.weight) / (1.0 / static_cast<double>(row.information) + rough);
                information += w * j * j.transpose();
                const double limit = 1.5 * state.blur + 1.0;
                pull += w * std::clamp(outwards(side) * static_cast<double>(row.offset), -limit, limit) * j;
            }
        }
        prior_information.setZero();
        prior_pull.setZero();
        using namespace silhouette_part;
        const double lean_weight = 1.0 / (prior.lean_sigma * prior.lean_sigma);
        prior_information(lean, lean) = lean_weight;
        prior_pull[lean] -= lean_weight * lean_from(prior.up, state.post);
        const double roll_weight = 1.0 / (prior.roll_sigma * prior.roll_sigma);
        prior_information(roll, roll) = roll_weight;
        prior_pull[roll] -= roll_weight * roll_from(prior.up, state.post);
        if (prior.half_angle_sigma > 0.0) {
            const double weight = 1.0 / (prior.half_angle_sigma * prior.half_angle_sigma);
            prior_information(half_angle, half_angle) = weight;
            prior_pull[half_angle] += weight * (prior.half_angle - state.post.half_angle);
        }
        const SilhouetteStep step = step_of(information + prior_information, pull + prior_pull);
        if (!step.allFinite() || step.norm() > 0.5) return state;
        state.post = upright(state.post.moved(step), prior);
        ++state.iterations;
        if (!(state.post.half_angle > 0.0) || state.post.half_angle > 1.2) return state;

        if (blur_open) fit_blur(state, blur);
        const double moved = camera.fx * step.cwiseAbs().maxCoeff();
        const bool left_windows = moved > 1.0 || 3.0 * state.blur > reading.outer;
        if (left_windows && readings < most_readings) {
            read_anew = true;
            continue;
        }
        constexpr double still = 0.004;  // px
        const double shift = camera.fx * std::max({std::abs(step[swing]), std::abs(step[half_angle]),
                                                   std::abs(step[roll]) * 0.3});
        // What is still to gain, in units of the whole misfit: a fifth of a sigma.
        constexpr double little = 0.05;
        if (iteration >= 3 && (shift < still || (pull + prior_pull).dot(step) < little)) {
            state.converged = true;
            break;
        }
    }
    state.scatter = row_scatter(rows_);
    if (!state.scatter.enough) {
        state.converged = false;
        return state;
    }
    const double scale = 1.0 / (std::max(state.scatter.variance, 0.5) * state.scatter.correlation);
    state.covariance = (scale * information + prior_information).ldlt().solve(Information::Identity());
    // Rows that go together say less against what is known before than each on its own.
    const SilhouetteStep step = state.covariance * (scale * pull + prior_pull);
    if (step.allFinite() && step.norm() < 0.5) state.post = upright(state.post.moved(step), prior);
    if (!(state.post.half_angle > 0.0) || state.post.half_angle > 1.2) {
        state.converged = false;
        state.covariance.setZero();
    }
    return state;
}

}  // namespace goalmouth
