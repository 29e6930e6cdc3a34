#pragma once

#include "core/imaging/colour_table.h"
#include "tests/bench/contender.h"
#include "tests/bench/frames.h"
#include "tests/bench/point_sets.h"
#include "tests/bench/ratio.h"
#include "tests/bench/refinement_rows.h"
#include "tests/bench/rounds.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace goalmouth::bench {

/// Spacings of scan-lines [px] that are timed, and the one of which the acceptance speaks.
inline constexpr int spacings[] = {4, 8, 16};
inline constexpr int judged_spacing = 8;

/// What a stage or one in place of stages took at one size.
struct StageRow {
    enum class Kind { ours, part, plain, other, floor };
    Kind kind = Kind::ours;  // part: of ours; plain: our own plain versions; floor: what nobody can undercut
    int spacing = 0;         // px; 0: looks at every pixel
    std::string settings;
    std::string finds;
    double found = 0.0;                // of these, mean of a frame
    std::optional<double> edges_seen;  // share of the true posts' edges it has an edge at
    Timing timing;
};

struct SizeResult {
    ImageSize size;
    std::size_t frames = 0;
    std::size_t different = 0;
    std::size_t bytes = 0;
    std::size_t true_edges = 0;  // of posts in the different frames; 0: not known
    std::string source;
    std::vector<StageRow> rows;
    std::optional<RefinementRow> refinement = {};  // where it was tried

    /// By the name in timing. Throws std::out_of_range.
    const StageRow& row(const std::string& name) const;
    double median(const std::string& name) const { return row(name).timing.median; }
};

struct StagesResult {
    std::vector<SizeResult> sizes;
    std::vector<PointRow> points;
    bool complete = false;
    std::vector<std::string> left_out = {};  // others that could not take part, and why
    bool same_segments = true;               // naive and fast, on every frame that was compared

    const SizeResult& largest() const;
    /// Whether every fast version gave what its plain version gives.
    bool sound() const;
};

/// The rows of the acceptance tables that are the stages', at the largest size. Of RANSAC the worst number of
/// points up to largest_judged. Refinement's where it was tried.
std::vector<Ratio> stage_ratios(const StagesResult& result);

/// For people, of a run whose frames do not push each other out of the caches.
std::string not_cold_words();

struct StageOptions {
    std::size_t repetitions = 1;
    std::uint64_t seed = 1;
    std::function<bool()> stop;
    std::function<void()> step;
};

/// How everybody's turns on `frames` frames or a few more are shared out.
Turns stage_turns(std::size_t frames);
/// How often run_size steps.
std::size_t size_steps(const Turns& turns, const StageOptions& options);

/// Everybody on the frames of one size, of which there are turns.items(). Nothing where it was stopped.
/// `same_segments` becomes false where the naive and the fast segmentation differ on a frame.
std::optional<SizeResult> run_size(const FrameSet& frames, const ColourTable& table, const Turns& turns,
                                   const StageOptions& options, bool& same_segments);

/// Share of the true posts' edges at which one of `edges` is: at two or more of the heights ¼, ½ and ¾ within
/// a quarter of the post's width (the tolerance of `goalmouth evaluate`). Adds to `seen` and `asked`.
void count_seen_edges(const std::vector<ReferencePost>& posts, const std::vector<SeenEdge>& edges,
                      std::size_t& seen, std::size_t& asked);

}  // namespace goalmouth::bench
