#include "tests/bench/refinement_rows.h"

#include "core/detection/ransac_detector.h"
#include "core/extraction/border.h"
#include "core/extraction/extraction.h"
#include "core/random/random.h"
#include "core/refinement/post_refiner.h"
#include "core/segmentation/segmentation.h"
#include "tests/bench/full_fit.h"
#include "tests/bench/graph/quantile.h"
#include "tests/bench/stages.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>

namespace goalmouth::bench {
namespace {

constexpr std::size_t block = 8;  // posts in a turn

using Posts = std::shared_ptr<const std::vector<FoundPost>>;

bool has_both_edges(const Post& post) {
    return !post.has(post_flag::left_edge_missing | post_flag::right_edge_missing | post_flag::fills_image);
}

bool is_true(const Post& post, const std::vector<ReferencePost>& known) {
    return std::any_of(known.begin(), known.end(), [&](const ReferencePost& reference) {
        std::size_t seen = 0;
        std::size_t asked = 0;
        count_seen_edges({reference}, {{post.left_top, post.left_base}, {post.right_top, post.right_base}},
                         seen, asked);
        return asked == 2 && seen == 2;
    });
}

std::optional<CameraPose> pose_in(const FrameSet& frames, std::size_t frame) {
    if (frames.kinematics.empty()) return std::nullopt;
    return frames.kinematics[frame % frames.different];
}

Contender refining(const FrameSet& frames, const Posts& posts) {
    struct Work {
        PostRefiner refiner;
        std::vector<Post> one = std::vector<Post>(1);
    };
    const auto work = std::make_shared<Work>(Work{PostRefiner(RefinementParameters{}, frames.field)});
    Contender contender;
    contender.name = contender.label = "refinement";
    contender.run = [&frames, posts, work](std::size_t item, std::vector<double>&) {
        const FoundPost& found = (*posts)[item % posts->size()];
        work->one[0] = found.post;
        work->refiner.refine(frames.view(found.frame), work->one, frames.camera,
                             pose_in(frames, found.frame));
    };
    return contender;
}

Contender fitting_all(const FrameSet& frames, const Posts& posts) {
    Contender contender;
    contender.name = contender.label = "full least squares";
    contender.run = [&frames, posts](std::size_t item, std::vector<double>&) {
        const FoundPost& found = (*posts)[item % posts->size()];
        fit_all_pixels(frames.view(found.frame), frames.camera, found.post, frames.field.post_diameter,
                       pose_in(frames, found.frame));
    };
    return contender;
}

/// False where it was stopped.
bool compare(const FrameSet& frames, const std::vector<FoundPost>& posts, const RefinementOptions& options,
             RefinementRow& row) {
    PostRefiner refiner(RefinementParameters{}, frames.field);
    std::vector<double> disagreements;
    for (const FoundPost& found : posts) {
        if (found.frame >= frames.different) break;
        if (options.stop && options.stop()) return false;
        ++row.posts;
        const BothDistances both = measure_both(frames, found, refiner);
        if (both.refined) ++row.refined;
        if (const auto disagreement = both.disagreement()) disagreements.push_back(*disagreement);
        if (options.step) options.step();
    }
    row.compared = disagreements.size();
    std::sort(disagreements.begin(), disagreements.end());
    if (!disagreements.empty()) row.disagreement = quantile(disagreements, 0.5);
    return true;
}

Turns refinement_turns(const std::vector<FoundPost>& posts) {
    return share_turns(posts.size(), block, 2);
}

std::size_t count_different(const FrameSet& frames, const std::vector<FoundPost>& posts) {
    return static_cast<std::size_t>(std::count_if(
        posts.begin(), posts.end(), [&](const FoundPost& found) { return found.frame < frames.different; }));
}

}  // namespace

std::vector<FoundPost> found_posts(const FrameSet& frames, const ColourTable& table, std::uint64_t seed) {
    ScanLineParameters spacing;
    spacing.row_spacing = spacing.column_spacing = judged_spacing;
    const ScanLayout layout = image_layout(frames.width(), frames.height(), spacing);
    Segmenter segmenter(table);
    BorderFinder border{BorderParameters{}};
    CandidateExtractor extractor{CandidateParameters{}};
    RansacDetector detector(RansacDetectorParameters{}, frames.field.post_diameter);
    std::vector<std::vector<Post>> found(frames.different);
    for (std::size_t i = 0; i < frames.different; ++i) {
        const Segments& segments = segmenter.segment(frames.view(i), layout);
        const Candidates& candidates = extractor.extract(segments, border.find(segments));
        Random random = random_for_frame(seed, "detection", static_cast<std::int64_t>(i));
        for (const Post& post : detector.detect(candidates, frames.camera, random))
            if (has_both_edges(post) && (frames.posts.empty() || is_true(post, frames.posts[i])))
                found[i].push_back(post);
    }
    std::vector<FoundPost> all;
    for (std::size_t i = 0; i < frames.frames.size(); ++i)
        for (const Post& post : found[i % frames.different]) all.push_back({i, post});
    return all;
}

std::optional<double> BothDistances::disagreement() const {
    if (!refined || !full) return std::nullopt;
    return std::abs(refined->distance - full->distance) / std::hypot(refined->sigma, full->sigma);
}

BothDistances measure_both(const FrameSet& frames, const FoundPost& found, PostRefiner& refiner) {
    const std::optional<CameraPose> pose = pose_in(frames, found.frame);
    const RefinedPost refined =
        refiner.refine(frames.view(found.frame), {found.post}, frames.camera, pose).front();
    BothDistances both;
    if (refined.post.has(post_flag::refined) && refined.left && refined.right) {
        // The planes' normals, both towards the post, add up to 2·sin η along its middle.
        const double sine = 0.5 * (refined.left->plane + refined.right->plane).norm();
        both.refined = {0.5 * frames.field.post_diameter / sine, std::sqrt(refined.post.covariance(0, 0))};
    }
    const auto full =
        fit_all_pixels(frames.view(found.frame), frames.camera, found.post, frames.field.post_diameter, pose);
    if (full) both.full = {full->distance, full->sigma};
    return both;
}

std::vector<Ratio> refinement_ratios(const RefinementRow& row) {
    std::vector<Ratio> ratios = {
        time_ratio("refinement, ms a post", row.ours.median, "one millisecond", 1.0, 0.3, 0.15),
        time_ratio("refinement ÷ full least squares", row.ours.median, "full least squares", row.full.median,
                   0.10, 0.05)};
    for (Ratio& ratio : ratios) {
        ratio.measured = row.measured();
        ratio.note = refinement_words(row);
    }
    return ratios;
}

std::string refinement_words(const RefinementRow& row) {
    if (!row.measured()) return "RANSAC found no post";
    std::string words = fmt::format("{} posts, {} refined", row.posts, row.refined);
    if (row.compared > 0)
        words += fmt::format("; its distance and the full fit's differ by {:.2f} sigma (median of {})",
                             row.disagreement, row.compared);
    return words;
}

std::size_t refinement_steps(const FrameSet& frames, const std::vector<FoundPost>& posts,
                             const RefinementOptions& options) {
    if (posts.empty()) return 0;
    const Turns turns = refinement_turns(posts);
    return count_different(frames, posts) + options.repetitions * turns.blocks * turns.contenders;
}

std::optional<RefinementRow> run_refinement(const FrameSet& frames, const std::vector<FoundPost>& posts,
                                            const RefinementOptions& options) {
    RefinementRow row;
    if (posts.empty()) return row;
    if (!compare(frames, posts, options, row)) return std::nullopt;
    const auto shared = std::make_shared<const std::vector<FoundPost>>(posts);
    const std::vector<Timing> timings =
        run_rounds({refining(frames, shared), fitting_all(frames, shared)}, refinement_turns(posts),
                   {options.repetitions, options.stop, options.step, StopwatchClock::thread});
    if (timings.empty()) return std::nullopt;
    row.ours = timings[0];
    row.full = timings[1];
    return row;
}

}  // namespace goalmouth::bench
