#include "core/extraction/extraction.h"

#include <algorithm>
#include <numeric>
#include <optional>

namespace goalmouth {
namespace {

/// Segments of the post's colour on one line, small gaps bridged.
struct Run {
    CandidateSegment segment;
    std::optional<double> entry;  // px along the line; nothing at the image border
    std::optional<double> exit;
    int row = 0;  // number of the horizontal scan-line, from the top
};

bool belong_together(const CandidateSegment& a, const Segment& b, const CandidateParameters& parameters) {
    const int gap = b.start - a.end - 1;
    return gap <= parameters.largest_gap || gap <= parameters.gap_share * (a.length() + b.length());
}

std::vector<Run> runs_on_line(const Segments& all, const ScanLine& line,
                              const CandidateParameters& parameters) {
    const int size = line.orientation == Orientation::horizontal ? all.width : all.height;
    std::vector<Run> runs;
    for (int i = line.first; i < line.first + line.count; ++i) {
        const Segment& s = all.segments[static_cast<std::size_t>(i)];
        if (s.colour != Colour::goal) continue;
        if (runs.empty() || !belong_together(runs.back().segment, s, parameters)) {
            runs.push_back(
                {{line.orientation, line.position, s.start, s.end}, std::nullopt, std::nullopt, 0});
            if (i > line.first) runs.back().entry = s.transition;
        }
        runs.back().segment.end = s.end;
        runs.back().exit.reset();
        if (i + 1 < line.first + line.count) {
            runs.back().exit = all.segments[static_cast<std::size_t>(i) + 1].transition;
        }
    }
    const double longest = parameters.longest * size;
    std::erase_if(runs, [&](const Run& r) {
        return r.segment.length() < parameters.shortest || r.segment.length() > longest;
    });
    return runs;
}

/// Sets that merge (union-find with path halving).
class Regions {
  public:
    explicit Regions(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    }
    std::size_t find(std::size_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void merge(std::size_t a, std::size_t b) { parent_[find(a)] = find(b); }

  private:
    std::vector<std::size_t> parent_;
};

bool overlap(const CandidateSegment& a, const CandidateSegment& b) {
    return a.start <= b.end + 1 && b.start <= a.end + 1;
}

bool crosses(const CandidateSegment& vertical, const CandidateSegment& horizontal) {
    return vertical.line >= horizontal.start && vertical.line <= horizontal.end &&
           horizontal.line >= vertical.start && horizontal.line <= vertical.end;
}

/// The runs whose region is large enough and stands on the field. `runs` are horizontal, from top to bottom.
std::vector<Run> in_good_regions(const std::vector<Run>& runs, const FieldBorder& border, int image_height,
                                 const CandidateParameters& parameters) {
    Regions regions(runs.size());
    for (std::size_t i = 0; i < runs.size(); ++i) {
        for (std::size_t j = i; j-- > 0 && runs[i].row - runs[j].row <= parameters.region_gap;) {
            if (runs[j].row < runs[i].row && overlap(runs[i].segment, runs[j].segment)) regions.merge(j, i);
        }
    }

    struct Region {
        int rows = 0;
        int last_row = -1;
        bool stands = false;
    };
    std::vector<Region> found(runs.size());
    const bool judge_position = parameters.must_reach_border && !border.empty();
    const double tolerance = parameters.border_tolerance * image_height;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        Region& region = found[regions.find(i)];
        region.rows += runs[i].row != region.last_row;
        region.last_row = runs[i].row;
        const Eigen::Vector2d centre = runs[i].segment.centre();
        region.stands |= !judge_position || centre.y() >= border.y_at(centre.x()) - tolerance;
    }

    std::vector<Run> kept;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const Region& region = found[regions.find(i)];
        if (region.stands && region.rows >= parameters.least_rows) kept.push_back(runs[i]);
    }
    return kept;
}

}  // namespace

Candidates extract_candidates(const Segments& segments, const FieldBorder& border,
                              const CandidateParameters& parameters) {
    std::vector<ScanLine> lines = segments.lines;
    std::stable_sort(lines.begin(), lines.end(),
                     [](const ScanLine& a, const ScanLine& b) { return a.position < b.position; });
    std::vector<Run> horizontal;
    std::vector<Run> vertical;
    int row = 0;
    for (const ScanLine& line : lines) {
        const bool is_row = line.orientation == Orientation::horizontal;
        for (auto& run : runs_on_line(segments, line, parameters)) {
            run.row = row;
            (is_row ? horizontal : vertical).push_back(run);
        }
        if (is_row) ++row;
    }

    horizontal = in_good_regions(horizontal, border, segments.height, parameters);
    std::erase_if(vertical, [&](const Run& v) {
        const auto below = std::lower_bound(horizontal.begin(), horizontal.end(), v.segment.start,
                                            [](const Run& h, int y) { return h.segment.line < y; });
        const auto beyond = std::upper_bound(below, horizontal.end(), v.segment.end,
                                             [](int y, const Run& h) { return y < h.segment.line; });
        return std::none_of(below, beyond, [&](const Run& h) { return crosses(v.segment, h.segment); });
    });

    Candidates candidates;
    candidates.width = segments.width;
    candidates.height = segments.height;
    for (const Run& run : horizontal) {
        candidates.segments.push_back(run.segment);
        if (run.entry) candidates.left_edges.emplace_back(*run.entry, run.segment.line);
        if (run.exit) candidates.right_edges.emplace_back(*run.exit, run.segment.line);
    }
    for (const Run& run : vertical) candidates.segments.push_back(run.segment);
    return candidates;
}

}  // namespace goalmouth
