#include "core/extraction/extraction.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace goalmouth {
namespace {

/// Rows from top to bottom and columns from left to right, whichever comes between them.
bool in_order(const std::vector<ScanLine>& lines) {
    std::array<int, 2> last;
    last.fill(std::numeric_limits<int>::min());
    for (const ScanLine& line : lines) {
        int& before = last[line.orientation == Orientation::horizontal ? 0 : 1];
        if (line.position < before) return false;
        before = line.position;
    }
    return true;
}

bool crosses(const CandidateSegment& vertical, const CandidateSegment& horizontal) {
    return vertical.line >= horizontal.start && vertical.line <= horizontal.end &&
           horizontal.line >= vertical.start && horizontal.line <= vertical.end;
}

}  // namespace

const Candidates& CandidateExtractor::extract(const Segments& segments, const FieldBorder& border) {
    find_runs(segments);
    regions_.keep_good(horizontal_, border, segments.height, parameters_);

    candidates_.width = segments.width;
    candidates_.height = segments.height;
    candidates_.segments.clear();
    candidates_.left_edges.clear();
    candidates_.right_edges.clear();
    for (const Run& run : horizontal_) {
        candidates_.segments.push_back(run.segment);
        if (run.entry) candidates_.left_edges.emplace_back(*run.entry, run.segment.line);
        if (run.exit) candidates_.right_edges.emplace_back(*run.exit, run.segment.line);
    }
    for (const Run& run : vertical_) {
        if (crosses_any(run)) candidates_.segments.push_back(run.segment);
    }
    return candidates_;
}

void CandidateExtractor::find_runs(const Segments& segments) {
    horizontal_.clear();
    vertical_.clear();
    candidates_.field.clear();
    int row = 0;
    const auto add = [&](const ScanLine& line) {
        const bool is_row = line.orientation == Orientation::horizontal;
        append_runs(segments, line, row, parameters_, is_row ? horizontal_ : vertical_);
        if (is_row) add_field(segments, line);
        row += is_row;
    };
    if (in_order(segments.lines)) {
        for (const ScanLine& line : segments.lines) add(line);
        return;
    }
    order_.resize(segments.lines.size());
    std::iota(order_.begin(), order_.end(), 0U);
    std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
        const int at_a = segments.lines[a].position;
        const int at_b = segments.lines[b].position;
        return at_a < at_b || (at_a == at_b && a < b);
    });
    for (const std::uint32_t i : order_) add(segments.lines[i]);
}

/// Bridged as the post's colour is, so that noise does not make many of one.
void CandidateExtractor::add_field(const Segments& segments, const ScanLine& line) {
    FieldRun run{line.position, 0, -1};
    const auto end_run = [&] {
        if (run.length() >= parameters_.shortest) candidates_.field.push_back(run);
    };
    for (int i = line.first; i < line.first + line.count; ++i) {
        const Segment& s = segments.segments[static_cast<std::size_t>(i)];
        if (s.colour != Colour::field) continue;
        if (run.length() > 0 && s.start - run.end - 1 <= parameters_.largest_gap) {
            run.end = s.end;
            continue;
        }
        end_run();
        run.start = s.start;
        run.end = s.end;
    }
    end_run();
}

/// Among the rows that are left.
bool CandidateExtractor::crosses_any(const Run& vertical) const {
    const auto below = std::lower_bound(horizontal_.begin(), horizontal_.end(), vertical.segment.start,
                                        [](const Run& h, int y) { return h.segment.line < y; });
    for (auto h = below; h != horizontal_.end() && h->segment.line <= vertical.segment.end; ++h) {
        if (crosses(vertical.segment, h->segment)) return true;
    }
    return false;
}

Candidates extract_candidates(const Segments& segments, const FieldBorder& border,
                              const CandidateParameters& parameters) {
    return CandidateExtractor(parameters).extract(segments, border);
}

}  // namespace goalmouth
