#include "core/refinement/post_refiner.h"

#include "core/imaging/chroma_shift.h"
#include "core/refinement/chroma_evidence.h"
#include "core/refinement/fit_quality.h"
#include "core/refinement/refined_measurement.h"
#include "core/refinement/response_evidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace goalmouth {
namespace {

constexpr int least_rows = 8;  // px

double square(double x) {
    return x * x;
}

/// Nothing where the corners are no outline of anything in the picture.
std::optional<RoughOutline> rough_outline(const Post& post, YuyvView image) {
    for (const Eigen::Vector2d* corner : {&post.left_top, &post.left_base, &post.right_top, &post.right_base})
        if (!corner->allFinite() || corner->cwiseAbs().maxCoeff() > 1e5) return std::nullopt;
    RoughOutline outline{post.left_top, post.left_base, post.right_top, post.right_base};
    if (outline.left_top.y() > outline.left_base.y()) std::swap(outline.left_top, outline.left_base);
    if (outline.right_top.y() > outline.right_base.y()) std::swap(outline.right_top, outline.right_base);
    const double top = std::min(outline.left_top.y(), outline.right_top.y());
    const double base = std::max(outline.left_base.y(), outline.right_base.y());
    if (!(outline.left_base.y() - outline.left_top.y() > 1.0) ||
        !(outline.right_base.y() - outline.right_top.y() > 1.0))
        return std::nullopt;
    outline.first_row = std::max(0, static_cast<int>(std::ceil(top)));
    outline.last_row = std::min(image.height - 1, static_cast<int>(std::floor(base)));
    if (outline.last_row - outline.first_row + 1 < least_rows) return std::nullopt;
    return outline;
}

/// Has memory bring the pixels about both edges, all at once: waiting for one row after the other would take
/// longer than working on them. By loads: each row of a large picture lies in a page of its own, and
/// processors drop prefetches from pages whose place they would have to look up first.
void fetch_edges(YuyvView image, const RoughOutline& outline) {
    constexpr int reach = 16;  // px to either side of an edge: a cache line, or parts of two
    // As little work as can be from one load to the next, so that many are under way at once.
    struct Edge {
        float at, per_row;
    };
    const auto edge = [&](auto column) {
        const double first = column(outline.first_row), last = column(outline.last_row);
        return Edge{static_cast<float>(first),
                    static_cast<float>((last - first) / (outline.last_row - outline.first_row))};
    };
    const std::array<Edge, 2> edges = {edge([&](int row) { return outline.left(row); }),
                                       edge([&](int row) { return outline.right(row); })};
    const auto last_column = static_cast<float>(image.width - 1);
    for (int y = outline.first_row; y <= outline.last_row; ++y) {
        const volatile std::uint8_t* const row = image.row(y);  // what is not used is loaded all the same
        const auto rows = static_cast<float>(y - outline.first_row);
        for (const Edge& e : edges) {
            const float x = e.at + rows * e.per_row;
            static_cast<void>(row[2 * static_cast<int>(std::clamp(x - reach, 0.0F, last_column))]);
            static_cast<void>(row[2 * static_cast<int>(std::clamp(x + reach, 0.0F, last_column))]);
        }
    }
}

}  // namespace

PostRefiner::PostRefiner(const RefinementParameters& parameters, const Field& field)
    : parameters_(parameters), field_(field), search_(parameters, field) {}

PostRefiner::Start PostRefiner::start(YuyvView image, const Intrinsics& camera,
                                      const MeasuredVertical& vertical, const Post& post,
                                      CameraResponse response) {
    Start found;
    found.problem = [&]() -> const char* {
        if (post.has(post_flag::fills_image)) return "it fills the picture: no edge in sight";
        const auto outline = rough_outline(post, image);
        if (!outline) return "its corners outline nothing in the picture";
        found.outline = *outline;
        const double width = outline->width();
        if (!(width >= parameters_.least_width)) return "too narrow";
        // Read as light they have been read as levels before.
        if (response == CameraResponse::linear) fetch_edges(image, *outline);
        if (!colours_.estimate(image, *outline, parameters_, response, found.colour))
            return "no colour of its own";
        CoarseSearch search;
        search.tolerance =
            std::max(parameters_.start_tolerance * width, parameters_.start_floor * image.width);
        search.least_contrast = static_cast<float>(parameters_.least_contrast);
        search.up = vertical.up;
        search.lean_sigma = std::sqrt(vertical.covariance.trace() / 3.0);
        found.edges = coarse_.find(image, *outline, found.colour, camera, search);
        return "";
    }();
    return found;
}

double PostRefiner::chroma_shift_of(YuyvView image, const Intrinsics& camera) const {
    if (parameters_.chroma_shift != "auto") return 0.0;
    ChromaEvidence evidence;
    for (const Start& start : starts_)
        if (start.problem.empty())
            evidence += chroma_evidence(image, start.outline, start.colour, camera, start.edges);
    return evidence.shift();
}

CameraResponse PostRefiner::response_of(YuyvView image, const Intrinsics& camera) const {
    if (parameters_.response != "auto")
        return parameters_.response == "srgb" ? CameraResponse::srgb : CameraResponse::linear;
    std::size_t left = 0;
    for (const Start& start : starts_)
        for (const auto& edge : start.edges) left += start.problem.empty() && edge ? 1 : 0;
    ResponseEvidence evidence;
    for (const Start& start : starts_) {
        for (std::size_t side = 0; side < 2; ++side) {
            if (!start.problem.empty() || !start.edges[side]) continue;
            // Mostly the first edges say enough.
            if (!evidence.open(left--)) return CameraResponse::linear;
            CoarseEdgeFinder::Edges one;
            one[side] = start.edges[side];
            evidence += response_evidence(image, start.outline, start.colour, camera, one);
        }
    }
    return evidence.response();
}

std::string PostRefiner::measure(YuyvView image, const Intrinsics& camera, const MeasuredVertical& vertical,
                                 const Start& found, RefinedPost& refined) {
    if (!found.problem.empty()) return found.problem;
    Post& post = refined.post;
    const std::array<bool, 2> edges = {found.edges[0] && !post.has(post_flag::left_edge_missing),
                                       found.edges[1] && !post.has(post_flag::right_edge_missing)};
    if (!edges[0] && !edges[1]) return "no edge in its pixels";
    const PostColour& colour = found.colour;
    const FoundSilhouette last = search_.find(
        image,
        {camera, vertical, found.outline, colour, post.has(post_flag::cut_left | post_flag::cut_right)},
        found.edges, edges);
    const PostExtent& extent = last.extent;
    const SilhouetteFit& fit = last.fit;
    refined.rows = last.layout.count;
    refined.iterations = fit.iterations;
    if (!last.problem.empty()) return last.problem;
    for (std::size_t side = 0; side < 2; ++side) {
        if (!edges[side]) continue;
        auto& edge = side == 0 ? refined.left : refined.right;
        edge = RefinedEdge{fit.post.plane(side == 0 ? OutlineSide::left : OutlineSide::right),
                           fit.scatter.agreeing[side]};
    }
    refined.quality = fit_quality(fit, last.edges, edges, last.layout.count, last.rivals);
    if (refined.quality < parameters_.least_quality) return "its pixels fit badly";
    if (!edges[0]) post.flags |= post_flag::left_edge_missing;
    if (!edges[1]) post.flags |= post_flag::right_edge_missing;
    const PostEstimate by_width =
        set_measurement(post, fit, extent, edges, camera, 0.5 * field_.post_diameter, parameters_);
    post.flags |= post_flag::refined;

    PostEndFinder finder(image, camera, fit.post, colour,
                         {fit.blur, parameters_.least_contrast, parameters_.end_floor});
    PostEnds ends;
    if (extent.base_seen) ends.base = finder.base(extent.last_row);
    if (extent.top_seen) ends.top = finder.top(extent.first_row);
    if (ends.base) refined.base = ends.base->pixel;
    if (ends.top) refined.top = ends.top->pixel;
    if (!edges[0] || !edges[1]) return "";
    const CombinedDistance all = combine_distances(by_width, fit.post, ends, vertical.camera,
                                                   last.prior.lean_sigma, field_, parameters_);
    refined.cues = all.cues;
    post.distance_m = all.estimate.distance;
    post.bearing_rad = all.estimate.bearing;
    post.covariance = all.estimate.covariance();
    using silhouette_part::lean;
    measured_.push_back({fit.post, all.estimate, fit.covariance.col(lean) / square(last.prior.lean_sigma)});
    measured_of_.push_back(refined_.size() - 1);
    return "";
}

void PostRefiner::use_goals(const MeasuredVertical& vertical) {
    const Eigen::Matrix3d attitude =
        vertical.covariance - square(parameters_.tilt_floor) * Eigen::Matrix3d::Identity();
    for (const GoalPairResult& told :
         pair_up(measured_, attitude, field_.goal_width, parameters_.goal_error)) {
        RefinedPost& refined = refined_[measured_of_[told.post]];
        refined.post.distance_m = told.estimate[0];
        refined.post.bearing_rad = told.estimate[1];
        refined.post.covariance = told.covariance;
        if (told.sigma > 0.0) refined.cues.push_back({DistanceCueKind::goal, told.distance, told.sigma});
    }
}

const std::vector<RefinedPost>& PostRefiner::refine(YuyvView image, const std::vector<Post>& posts,
                                                    const Intrinsics& camera,
                                                    const std::optional<CameraPose>& pose) {
    refined_.clear();
    measured_.clear();
    measured_of_.clear();
    starts_.clear();
    const MeasuredVertical up = measured_vertical(pose, parameters_);
    if (!image.empty())
        for (const Post& post : posts)
            starts_.push_back(start(image, camera, up, post, CameraResponse::linear));
    if (const double shift = chroma_shift_of(image, camera); shift != 0.0) {
        move_chroma_left(image, shift, moved_);
        image = moved_.view();
        for (std::size_t i = 0; i < starts_.size(); ++i)
            starts_[i] = start(image, camera, up, posts[i], CameraResponse::linear);
    }
    // Levels tell whether they are light.
    if (response_of(image, camera) == CameraResponse::srgb)
        for (std::size_t i = 0; i < starts_.size(); ++i)
            starts_[i] = start(image, camera, up, posts[i], CameraResponse::srgb);
    for (std::size_t i = 0; i < posts.size(); ++i) {
        RefinedPost& refined = refined_.emplace_back();
        refined.post = posts[i];
        refined.post.flags &= ~post_flag::refined;  // of an earlier time
        refined.reason = image.empty() ? "no picture" : measure(image, camera, up, starts_[i], refined);
        if (!refined.reason.empty()) {
            refined.post = posts[i];
            refined.post.flags &= ~post_flag::refined;
            refined.left.reset();
            refined.right.reset();
            refined.base.reset();
            refined.top.reset();
            refined.cues.clear();
        }
    }
    if (parameters_.goal_cue) use_goals(up);
    return refined_;
}

}  // namespace goalmouth
