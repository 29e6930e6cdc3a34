#include "tests/bench/stages.h"

#include "core/segmentation/scan_lines.h"
#include "core/segmentation/segmentation.h"
#include "tests/bench/others.h"
#include "tests/bench/ours.h"
#include "tests/reference/naive_segmentation.h"
#include "tools/goalmouth/bench_options.h"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>
#include <utility>

namespace goalmouth::bench {
namespace {

constexpr std::size_t block = 8;  // frames in a turn

using Kind = StageRow::Kind;

struct Entry {
    Kind kind;
    int spacing;
    Contender contender;
};

std::vector<Entry> everybody(const FrameSet& frames, const ColourTable& table, std::uint64_t seed) {
    std::vector<Entry> all;
    for (const int spacing : spacings) {
        all.push_back({Kind::ours, spacing, our_segments(frames, table, spacing)});
        all.push_back({Kind::ours, spacing, edge_segments(frames, spacing)});
        all.push_back({Kind::ours, spacing, our_chain(frames, table, spacing, seed)});
        all.push_back({Kind::plain, spacing, naive_segments(frames, table, spacing)});
    }
    all.push_back({Kind::plain, 0, full_lookup(frames, table)});
    all.push_back({Kind::floor, 0, frame_read(frames)});
    all.push_back({Kind::other, 0, hsv_contours(frames)});
    all.push_back({Kind::other, 0, hsv_contours_of_three(frames)});
    all.push_back({Kind::other, 0, canny_hough(frames)});
    all.push_back({Kind::other, 0, sensitive_canny_hough(frames)});
    for (auto& contender : fast_line_detector(frames)) all.push_back({Kind::other, 0, std::move(contender)});
    all.push_back({Kind::other, 0, line_segment_detector(frames)});
    return all;
}

std::size_t contender_count() {
    static const std::size_t count = everybody(FrameSet{}, ColourTable{}, 0).size();
    return count;
}

/// What one finds on each of the different frames, and how many of the true edges. False where stopped.
bool look_at_findings(const FrameSet& frames, const Entry& entry, const StageOptions& options,
                      StageRow& row) {
    std::size_t asked = 0;
    std::size_t seen = 0;
    bool has_edges = false;
    std::vector<double> ignored;
    for (std::size_t i = 0; i < frames.different; ++i) {
        if (options.stop && options.stop()) return false;
        ignored.clear();
        entry.contender.run(i, ignored);
        if (!entry.contender.finding) continue;
        const Finding finding = entry.contender.finding();
        row.found += finding.count / static_cast<double>(frames.different);
        has_edges = has_edges || !finding.edges.empty();
        if (!frames.posts.empty()) count_seen_edges(frames.posts[i], finding.edges, seen, asked);
    }
    if (has_edges && asked > 0) row.edges_seen = static_cast<double>(seen) / static_cast<double>(asked);
    return true;
}

bool equal(const Segments& a, const Segments& b) {
    return std::ranges::equal(a.lines, b.lines,
                              [](const ScanLine& p, const ScanLine& q) {
                                  return p.orientation == q.orientation && p.position == q.position &&
                                         p.first == q.first && p.count == q.count;
                              }) &&
           std::ranges::equal(a.segments, b.segments, [](const Segment& p, const Segment& q) {
               return p.start == q.start && p.end == q.end && p.colour == q.colour &&
                      p.transition == q.transition;
           });
}

bool segments_agree(const FrameSet& frames, const ColourTable& table, const StageOptions& options) {
    Segmenter segmenter(table);
    Segments plain;
    for (const int spacing : spacings) {
        ScanLineParameters parameters;
        parameters.row_spacing = spacing;
        parameters.column_spacing = spacing;
        const ScanLayout layout = image_layout(frames.width(), frames.height(), parameters);
        for (std::size_t i = 0; i < frames.different; ++i) {
            if (options.stop && options.stop()) return true;
            segment_frame_naively(frames.view(i), table, layout, plain);
            if (!equal(segmenter.segment(frames.view(i), layout), plain)) return false;
        }
    }
    return true;
}

std::string ransac_words(const PointRow& row) {
    return fmt::format("literal Algorithm 2, {} points{}", row.points,
                       row.same_consensus ? "" : ", but NOT the same consensus");
}

}  // namespace

const StageRow& SizeResult::row(const std::string& name) const {
    for (const StageRow& each : rows)
        if (each.timing.name == name) return each;
    throw std::out_of_range("no stage " + name);
}

const SizeResult& StagesResult::largest() const {
    return *std::max_element(sizes.begin(), sizes.end(), [](const SizeResult& a, const SizeResult& b) {
        return a.size.width * a.size.height < b.size.width * b.size.height;
    });
}

bool StagesResult::sound() const {
    return same_segments &&
           std::all_of(points.begin(), points.end(), [](const PointRow& row) { return row.same_consensus; });
}

std::vector<Ratio> stage_ratios(const StagesResult& result) {
    std::vector<Ratio> ratios;
    if (!result.complete) return ratios;
    const SizeResult& at = result.largest();
    const double segments = at.median(fmt::format("segments_{}", judged_spacing));
    const double posts = at.median(fmt::format("frame_to_posts_{}", judged_spacing));
    const auto keep = [&](Ratio ratio) {
        ratio.size = fmt::format("{}x{}", at.size.width, at.size.height);
        if (at.size != ImageSize{1600, 1200}) ratio.scope = "at " + ratio.size;
        if (at.frames < static_cast<std::size_t>(least_frames))
            ratio.scope += fmt::format("{}{}", ratio.scope.empty() ? "with " : ", ", not_cold_words());
        ratios.push_back(std::move(ratio));
    };
    const auto add = [&](const char* name, double ours, const char* other, double bar, double stretch) {
        const StageRow& row = at.row(other);
        Ratio ratio = time_ratio(name, ours, row.timing.label, row.timing.median, bar, stretch);
        ratio.spacing = judged_spacing;
        keep(std::move(ratio));
    };
    const std::string naive = fmt::format("naive_segments_{}", judged_spacing);
    add("scan + segments ÷ our naive version", segments, naive.c_str(), 0.33, 0.25);
    add("scan + segments ÷ one read of the frame", segments, "read", 3.5, 2.5);
    const PointRow* worst = nullptr;
    for (const PointRow& row : result.points)
        if (row.points <= largest_judged && (worst == nullptr || row.ratio() > worst->ratio())) worst = &row;
    if (worst != nullptr)
        ratios.push_back(time_ratio("RANSAC ÷ literal, 50–500 points, same consensus", worst->ours.median,
                                    ransac_words(*worst), worst->literal.median, 0.10, 0.05));
    add("frame → posts ÷ HSV + inRange + findContours", posts, "hsv", 0.30, 0.20);
    add("frame → posts ÷ Canny + HoughLinesP", posts, "canny_hough", 0.12, 0.08);
    add("frame → posts ÷ LSD", posts, "lsd", 0.025, 0.015);
    add("segments by edges ÷ scan + segments", at.median(fmt::format("edge_segments_{}", judged_spacing)),
        fmt::format("segments_{}", judged_spacing).c_str(), 1.5, 1.0);
    if (at.refinement) {
        for (Ratio& ratio : refinement_ratios(*at.refinement)) keep(std::move(ratio));
    }
    return ratios;
}

std::string not_cold_words() {
    return fmt::format("fewer than {} frames: not cold", least_frames);
}

Turns stage_turns(std::size_t frames) {
    return share_turns(frames, block, contender_count());
}

std::size_t size_steps(const Turns& turns, const StageOptions& options) {
    return options.repetitions * turns.blocks * turns.contenders + turns.contenders;
}

std::optional<SizeResult> run_size(const FrameSet& frames, const ColourTable& table, const Turns& turns,
                                   const StageOptions& options, bool& same_segments) {
    const std::vector<Entry> all = everybody(frames, table, options.seed);
    SizeResult result{{frames.width(), frames.height()},
                      frames.frames.size(),
                      frames.different,
                      frames.bytes(),
                      0,
                      frames.source,
                      {}};
    std::vector<StageRow> looks(all.size());
    std::size_t none = 0;
    for (const auto& posts : frames.posts) count_seen_edges(posts, {}, none, result.true_edges);
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (!look_at_findings(frames, all[i], options, looks[i])) return std::nullopt;
        if (options.step) options.step();
    }
    if (!segments_agree(frames, table, options)) same_segments = false;

    std::vector<Contender> contenders;
    for (const Entry& entry : all) contenders.push_back(entry.contender);
    const std::vector<Timing> timings = run_rounds(
        contenders, turns, {options.repetitions, options.stop, options.step, StopwatchClock::thread});
    auto timing = timings.begin();
    if (timings.empty()) return std::nullopt;
    for (std::size_t i = 0; i < all.size(); ++i) {
        StageRow row = looks[i];
        row.kind = all[i].kind;
        row.spacing = all[i].spacing;
        row.settings = all[i].contender.settings;
        row.finds = all[i].contender.finds;
        row.timing = *timing++;
        result.rows.push_back(row);
        for (std::size_t p = 0; p < all[i].contender.parts.size(); ++p) {
            StageRow part;
            part.kind = Kind::part;
            part.spacing = all[i].spacing;
            part.timing = *timing++;
            result.rows.push_back(part);
        }
    }
    return result;
}

}  // namespace goalmouth::bench
