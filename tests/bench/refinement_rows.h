#pragma once

#include "core/detection/post.h"
#include "core/imaging/colour_table.h"
#include "core/refinement/post_refiner.h"
#include "tests/bench/contender.h"
#include "tests/bench/frames.h"
#include "tests/bench/ratio.h"
#include "tests/bench/rounds.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace goalmouth::bench {

/// A post that RANSAC found in a frame of a set.
struct FoundPost {
    std::size_t frame = 0;
    Post post;
};

/// The posts with both edges that our chain finds in all frames, in their order; where true posts are known,
/// only those with both edges on one of them.
std::vector<FoundPost> found_posts(const FrameSet& frames, const ColourTable& table, std::uint64_t seed);

/// The distance of one post [m] from the camera to its axis, square to it, and its σ.
struct MeasuredDistance {
    double distance = 0.0;
    double sigma = 0.0;
};

struct BothDistances {
    std::optional<MeasuredDistance> refined;  // where the refiner calls both edges refined
    std::optional<MeasuredDistance> full;     // where the full fit ends

    /// |difference| ÷ σ of the difference, were their errors independent: both look at the same noise, so
    /// equals differ by less.
    std::optional<double> disagreement() const;
};

BothDistances measure_both(const FrameSet& frames, const FoundPost& found, PostRefiner& refiner);

/// What refining a post takes, and what least squares over all its pixels takes (full_fit.h).
struct RefinementRow {
    std::size_t posts = 0;      // in the different frames
    std::size_t refined = 0;    // of them, as the refiner says
    std::size_t compared = 0;   // refined, and the full fit ended, too
    double disagreement = 0.0;  // median of BothDistances::disagreement() over those
    Timing ours;
    Timing full;

    bool measured() const { return posts > 0; }
    double ratio() const { return ours.median / full.median; }
};

/// Its rows of the acceptance table: the time a post takes, and over the full fit's. No stretch is promised:
/// half the bar stands there.
std::vector<Ratio> refinement_ratios(const RefinementRow& row);

/// "40 posts, 38 refined; …": for people.
std::string refinement_words(const RefinementRow& row);

struct RefinementOptions {
    std::size_t repetitions = 1;
    std::function<bool()> stop;
    std::function<void()> step;
};

/// How often run_refinement steps.
std::size_t refinement_steps(const FrameSet& frames, const std::vector<FoundPost>& posts,
                             const RefinementOptions& options);

/// Both on each post, one thread; nothing measured where there are no posts. Nothing where it was stopped.
std::optional<RefinementRow> run_refinement(const FrameSet& frames, const std::vector<FoundPost>& posts,
                                            const RefinementOptions& options);

}  // namespace goalmouth::bench
