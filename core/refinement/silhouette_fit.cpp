#include "core/refinement/silhouette_fit.h"

#include "core/refinement/far_levels.h"
#include "core/refinement/level_smoother.h"

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

namespace {

/// px to the other edge from where on it does not matter.
double far_edge(double blur) {
    return 10.0 * blur + 4.0;
}

/// px to the other edge, where that is nearer than `far`; else 0.
double near_edge(double width, double far) {
    return width < far ? std::max(width, 1.0) : 0.0;
}

StepEquations equations_of(const SilhouettePrior& prior, const PostSilhouette& post) {
    using namespace silhouette_part;
    StepEquations known;
    const auto hold = [&](int part, double off, double sigma) {
        known.information(part, part) = 1.0 / (sigma * sigma);
        known.pull[part] = -off / (sigma * sigma);
    };
    hold(lean, lean_from(prior.up, post), prior.lean_sigma);
    hold(roll, roll_from(prior.up, post), prior.roll_sigma);
    if (prior.half_angle_sigma > 0.0)
        hold(half_angle, post.half_angle - prior.half_angle, prior.half_angle_sigma);
    return known;
}

/// Whether any row of a bin is among those.
bool is_left_out(const std::vector<int>& rows, const RowLayout& layout, int bin) {
    const auto at = std::lower_bound(rows.begin(), rows.end(), layout.top(bin));
    return at != rows.end() && *at < layout.top(bin) + layout.bin;
}

bool is_post(const PostSilhouette& post) {
    constexpr double widest = 1.2;  // rad
    return post.half_angle > 0.0 && post.half_angle <= widest;
}

}  // namespace

void SilhouetteFitter::read(const Task& task, RowLayout& layout, const SilhouetteFit& state) {
    layout.inner = 3.0 * state.blur + 2.0;
    layout.outer = 4.0 * state.blur + 3.0;
    reader_.read(task.image, task.camera, state.post, task.colour, layout, state.blur, task.least_contrast,
                 rows_);
    for (std::size_t side = 0; side < 2; ++side) {
        EdgeRows& rows = rows_[side];
        for (std::size_t i = 0; i < rows.count; ++i) {
            if (!edges_[side] || is_left_out(task.left_out[side], layout, static_cast<int>(i)))
                rows.pairs[i] = 0.0F;
            rows.weight[i] = rows.clean[i] = rows.seen(i) ? 1.0F : 0.0F;
        }
        supposed_[side].start.assign(rows.count);
        supposed_[side].across.assign(rows.count);
        blur_[side].assign(rows.count);
    }
    measure(state, false);
    smooth(state);
}

void SilhouetteFitter::measure(const SilhouetteFit& state, bool blur) {
    // The other edge counts where it is hidden as well.
    for (std::size_t side = 0; side < 2; ++side) place_edges(planes_[side], rows_[side]);
    for (std::size_t side = 0; side < 2; ++side) {
        if (!edges_[side]) continue;
        EdgeRows& rows = rows_[side];
        const double out = outwards(side), far = far_edge(state.blur);
        for (std::size_t i = 0; i < rows.count; ++i) {
            const double across = near_edge(rows_[1].edge[i] - rows_[0].edge[i], far);
            const double start = out * (rows.first[i] - rows.edge[i]);
            supposed_[side].start[i] = static_cast<float>(rows.seen(i) ? start : 0.0);
            supposed_[side].across[i] = static_cast<float>(rows.seen(i) ? across : 0.0);
        }
        measure_rows(rows, profile_, supposed_[side], static_cast<float>(out),
                     static_cast<float>(state.noise[side]), nullptr, rows.measured,
                     blur ? &blur_[side] : nullptr);
    }
}

void SilhouetteFitter::smooth(const SilhouetteFit& state) {
    for (std::size_t side = 0; side < 2; ++side)
        if (edges_[side]) smooth_levels(rows_[side], static_cast<float>(state.noise[side]));
}

void SilhouetteFitter::measure_apart(const SilhouetteFit& state, std::size_t side) {
    constexpr float apart = 0.4F, reach = 3.0F;  // px
    constexpr int rounds = 3;
    EdgeRows& rows = rows_[side];
    const auto is_apart = [&](std::size_t i) { return std::abs(rows.measured.offset[i]) > apart; };
    apart_blocks_.assign(rows.blocks(), false);
    for (std::size_t i = 0; i < rows.count; ++i)
        if (is_apart(i)) apart_blocks_[i / EdgeRows::block] = true;
    if (std::none_of(apart_blocks_.begin(), apart_blocks_.end(), [](bool any) { return any; })) return;
    apart_rows_.assign(rows.count);
    shift_.assign(rows.count);
    apart_edges_ = supposed_[side];
    for (std::size_t i = 0; i < rows.count; ++i) apart_rows_.offset[i] = rows.measured.offset[i];
    const double far = far_edge(state.blur);
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < rows.count; ++i) {
            // Once out of reach it stays there.
            if (!is_apart(i) || !(std::abs(shift_[i]) < reach)) continue;
            shift_[i] += std::clamp(apart_rows_.offset[i], -1.0F, 1.0F);
            apart_edges_.start[i] = supposed_[side].start[i] - shift_[i];
            apart_edges_.across[i] = static_cast<float>(
                near_edge(rows_[1].edge[i] - rows_[0].edge[i] + static_cast<double>(shift_[i]), far));
        }
        measure_rows(rows, profile_, apart_edges_, static_cast<float>(outwards(side)),
                     static_cast<float>(state.noise[side]), &apart_blocks_, apart_rows_, nullptr);
    }
    for (std::size_t i = 0; i < rows.count; ++i) {
        if (!is_apart(i)) continue;
        const float rest = std::abs(apart_rows_.offset[i]) < 1.0F ? apart_rows_.offset[i] : 0.0F;
        const float offset = shift_[i] + rest;
        if (!(std::abs(shift_[i]) < reach) || !(std::abs(offset) < reach) ||
            !(apart_rows_.information[i] > 0.0F))
            continue;
        rows.measured.copy(apart_rows_, i);
        rows.measured.offset[i] = offset;
    }
}

void SilhouetteFitter::turns(const SilhouetteFit& state) {
    for (std::size_t side = 0; side < 2; ++side) {
        const Eigen::Vector3d change = state.post.plane_change(sides[side]).col(silhouette_part::roll);
        EdgeRows& rows = rows_[side];
        for (std::size_t i = 0; i < rows.count; ++i) {
            if (!rows.seen(i)) continue;
            const double miss = rows.edge[i] - rows.column[i];
            const double along = change.x() * (rows.ray_x[i] + miss * rows.slope_x[i]) +
                                 change.y() * (rows.ray_y[i] + miss * rows.slope_y[i]) + change.z();
            const double per_px = planes_[side].x() * rows.slope_x[i] + planes_[side].y() * rows.slope_y[i];
            rows.turn[i] = static_cast<float>(-outwards(side) * along / per_px);
        }
    }
}

void SilhouetteFitter::fit_blur(SilhouetteFit& state) const {
    BlurEvidence evidence;
    for (std::size_t side = 0; side < 2; ++side) {
        if (!edges_[side]) continue;
        const BlurEvidence own = blur_[side].evidence(rows_[side]);
        evidence.information += own.information;
        evidence.pull += own.pull;
    }
    // The share lies between 0 and 1: what is known of it before.
    constexpr double share_sigma = 0.5;
    evidence.information(1, 1) += 1.0 / (share_sigma * share_sigma);
    evidence.pull[1] -= (state.digital - 0.5) / (share_sigma * share_sigma);
    const Eigen::Vector2d change = evidence.information.ldlt().solve(evidence.pull);
    if (!change.allFinite()) return;
    state.blur = std::clamp(state.blur + std::clamp(change[0], -0.3 * state.blur, state.blur), narrowest_blur,
                            widest_blur);
    state.digital = std::clamp(state.digital + change[1], 0.0, 1.0);
}

std::optional<SilhouetteFitter::Stepped> SilhouetteFitter::step_once(const Task& task, SilhouetteFit& state) {
    equations_ = {};
    for (std::size_t side = 0; side < 2; ++side)
        if (edges_[side])
            add_rows(rows_[side], planes_[side], state.post.plane_change(sides[side]), outwards(side),
                     1.5 * state.blur + 1.0, equations_);
    prior_ = equations_of(task.prior, state.post);
    const SilhouetteStep pull = equations_.pull + prior_.pull;
    const SilhouetteStep step = step_of(equations_.information + prior_.information, pull);
    if (!step.allFinite() || step.norm() > 0.5) return std::nullopt;
    state.post = upright(state.post.moved(step), task.prior);
    // What is left to ask for.
    equations_.pull -= equations_.information * step;
    prior_.pull -= prior_.information * step;
    ++state.iterations;
    if (!is_post(state.post)) return std::nullopt;
    return Stepped{step, pull};
}

bool SilhouetteFitter::left_windows(const RowLayout& layout, const SilhouetteFit& state) {
    constexpr double most = 1.0;  // px
    if (2.5 * state.blur > layout.outer) return true;
    for (std::size_t side = 0; side < 2; ++side) {
        if (!edges_[side]) continue;
        EdgeRows& rows = rows_[side];
        place_edges(planes_[side], rows);
        for (std::size_t i = 0; i < rows.count; ++i)
            if (rows.seen(i) && std::abs(rows.edge[i] - rows.column[i]) > most) return true;
    }
    return false;
}

bool SilhouetteFitter::settle(const Task& task, RowLayout& layout, SilhouetteFit& state) {
    constexpr int most_iterations = 10;
    constexpr int settled = 4;  // then rows that come and go with the step would keep it from settling
    constexpr int most_readings = 3;  // posts in photographs need the third, if few do
    int readings = 0;
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
        for (std::size_t side = 0; side < 2; ++side) planes_[side] = state.post.plane(sides[side]);
        profile_.set_blur(state.blur, state.digital);
        const bool just_read = readings == 0 || (readings < most_readings && left_windows(layout, state));
        if (just_read) {
            read(task, layout, state);
            ++readings;
        }
        const bool blur_open = iteration > 0 && iteration < settled;
        measure(state, blur_open);
        const bool ask_all = iteration == 1 || iteration == 2 || (just_read && iteration > 2);
        if (ask_all)
            for (std::size_t side = 0; side < 2; ++side)
                if (edges_[side]) measure_apart(state, side);
        if (iteration < settled || just_read) gate_.weigh(rows_, state.noise, profile_, iteration > 0);
        if (ask_all) {
            turns(state);
            state.consensus =
                consensus_.find(rows_, roll_from(task.prior.up, state.post), task.prior.roll_sigma);
        }
        if (iteration < settled) smooth(state);

        const auto stepped = step_once(task, state);
        if (!stepped) return false;
        const auto& [step, pull] = *stepped;

        if (blur_open) fit_blur(state);
        using namespace silhouette_part;
        constexpr double still = 0.004;  // px
        const double shift = task.camera.fx * std::max({std::abs(step[swing]), std::abs(step[half_angle]),
                                                        std::abs(step[roll]) * 0.3});
        // What the step gained, in units of the whole misfit: 0.7 sigma. The next one, which finishes the
        // fit, gains a tenth of that or less.
        constexpr double little = 0.5;
        if (iteration + 1 >= settled && (shift < still || pull.dot(step) < little)) {
            state.converged = true;
            break;
        }
    }
    return true;
}

bool SilhouetteFitter::finish(const Task& task, const RowLayout& layout, SilhouetteFit& state) {
    constexpr float unknown = 1e6F;  // variance: nothing known of a level but by the row's own pixels
    for (std::size_t side = 0; side < 2; ++side) planes_[side] = state.post.plane(sides[side]);
    profile_.set_blur(state.blur, state.digital);
    reader_.read_far(task.image, task.colour, layout, rows_);
    for (std::size_t side = 0; side < 2; ++side) {
        if (!edges_[side]) continue;
        EdgeRows& rows = rows_[side];
        judge_far_levels(rows, static_cast<float>(state.noise[side]));
        for (std::size_t i = 0; i < rows.count; ++i)
            rows.inner_variance[i] = rows.outer_variance[i] = unknown;
    }
    measure(state, false);
    return step_once(task, state).has_value();
}

void SilhouetteFitter::set_covariance(const SilhouettePrior& prior, SilhouetteFit& state) const {
    state.scatter = row_scatter(rows_);
    if (!state.scatter.enough) {
        state.converged = false;
        return;
    }
    const double scale = 1.0 / (std::max(state.scatter.variance, 0.5) * state.scatter.correlation);
    state.covariance =
        (scale * equations_.information + prior_.information).ldlt().solve(Eigen::Matrix4d::Identity());
    // Rows that go together say less against what is known before than each on its own.
    const SilhouetteStep step = state.covariance * (scale * equations_.pull + prior_.pull);
    if (step.allFinite() && step.norm() < 0.5) state.post = upright(state.post.moved(step), prior);
    if (!is_post(state.post)) {
        state.converged = false;
        state.covariance.setZero();
    }
}

SilhouetteFit SilhouetteFitter::fit(YuyvView image, const Intrinsics& camera, const PostColour& colour,
                                    const PostSilhouette& start, const SilhouettePrior& prior,
                                    const RowLayout& layout, const std::array<bool, 2>& edges,
                                    const std::array<std::vector<int>, 2>& left_out, double least_contrast) {
    SilhouetteFit state;
    state.post = start;
    state.blur = 0.9;
    edges_ = edges;
    const Task task{image, camera, colour, prior, left_out, least_contrast};
    RowLayout windows = layout;
    if (settle(task, windows, state) && (!state.converged || finish(task, windows, state)))
        set_covariance(prior, state);
    return state;
}

}  // namespace goalmouth
