#include "core/edges/strip_seeds.h"

#include "core/edges/frame_scale.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {
namespace {

/// Shares of the rows in which what is said of a pair of chains must hold.
constexpr double most = 0.6;

/// From edge to edge a surface may look this much more unlike than from row to row, and shade counts hardly
/// at all: light falls on a post from one side, and two things light it that are not of one colour.
constexpr double across = 1.5;
constexpr float shade_across = 0.1F;

/// An edge between two others counts as an interruption when it is this distinct beside them.
constexpr double interruption = 0.6;

}  // namespace

const std::vector<StripSeed>& StripSeedFinder::find(const FrameEdges& frame, std::span<const EdgeChain> left,
                                                    std::span<const EdgeChain> right, float chroma_weight,
                                                    double straightness, int width) {
    frame_ = &frame;
    chroma_weight_ = chroma_weight;
    straightness_ = straightness;
    narrowest_ = narrowest_px(parameters_, width);
    widest_ = parameters_.widest * width;
    looks_ = 0;
    seeds_.clear();
    from_left_.assign(frame.edges.size(), -1.F);
    from_right_.assign(frame.edges.size(), -1.F);
    right_chain_.assign(frame.edges.size(), none);
    met_.assign(right.size(), 0);
    for (std::size_t c = 0; c < right.size(); ++c)
        for (const ChainPoint& point : right[c].points) right_chain_[point.edge] = c;

    for (const EdgeChain& l : left) {
        candidates_.clear();
        for (const ChainPoint& point : l.points) meet(static_cast<std::size_t>(point.row), point.edge);
        std::sort(candidates_.begin(), candidates_.end());
        for (const std::size_t c : candidates_) {
            if (const auto found = seed(l, right[c], met_[c])) seeds_.push_back(*found);
            met_[c] = 0;
        }
    }
    std::stable_sort(seeds_.begin(), seeds_.end(), [](const StripSeed& a, const StripSeed& b) {
        return a.rows * a.contrast > b.rows * b.contrast;
    });
    return seeds_;
}

/// Counts the right chains that a left edge meets on its row with no interruption in between.
void StripSeedFinder::meet(std::size_t row, std::size_t left) {
    const std::vector<RowEdge>& edges = frame_->edges;
    const auto x = [&](std::size_t i) { return static_cast<double>(edges[i].x); };
    const double own = from_left(left);
    const double farthest = x(left) + (1.0 + parameters_.largest_taper) * widest_ + straightness_;
    const std::size_t end = frame_->first[row + 1];
    double between = 0.0;  // the most distinct edge there, of those that came before `next`
    std::size_t next = left + 1;
    for (std::size_t i = left + 1; i < end && x(i) <= farthest; ++i) {
        ++looks_;
        for (; x(next) < x(i) - straightness_; ++next)
            if (x(next) > x(left) + straightness_) between = std::max(between, from_left(next));
        if (between > interruption * own) return;
        const std::size_t c = right_chain_[i];
        if (c == none || between > interruption * from_right(i)) continue;
        if (met_[c]++ == 0) candidates_.push_back(c);
    }
}

std::optional<StripSeed> StripSeedFinder::seed(const EdgeChain& left, const EdgeChain& right, int whole) {
    StripSeed s;
    s.first_row = std::max(left.points.front().row, right.points.front().row);
    s.last_row = std::min(left.points.back().row, right.points.back().row);
    const int common = s.last_row - s.first_row + 1;
    const double least = std::max(static_cast<double>(parameters_.least_rows), most * common);
    if (common < parameters_.least_rows || whole < most * least) return std::nullopt;
    const double upper = right.line.at(frame_->y(s.first_row)) - left.line.at(frame_->y(s.first_row));
    const double lower = right.line.at(frame_->y(s.last_row)) - left.line.at(frame_->y(s.last_row));
    const double mean = 0.5 * (upper + lower);
    if (mean < narrowest_ || mean > widest_ || std::min(upper, lower) <= 0.0) return std::nullopt;
    if (std::abs(upper - lower) > parameters_.largest_taper * mean + straightness_) return std::nullopt;

    int alike = 0;
    UprightFit left_fit, right_fit;
    Appearance inside;
    auto l = left.points.begin();
    auto r = right.points.begin();
    while (l != left.points.end() && r != right.points.end()) {
        ++looks_;
        if (l->row != r->row || l->edge >= r->edge) {
            ++(l->row < r->row ? l : r);
            continue;
        }
        const RowEdge& a = frame_->edges[l->edge];
        const RowEdge& b = frame_->edges[r->edge];
        const double distinct = std::min(from_left(l->edge), from_right(r->edge));
        alike += unlike(a.right, b.left, shade_across) < across * parameters_.sameness * distinct;
        left_fit.add(static_cast<double>(a.x), frame_->y(l->row));
        right_fit.add(static_cast<double>(b.x), frame_->y(r->row));
        inside = inside + (a.right + b.left) * 0.5F;
        s.contrast += distinct;
        ++s.rows;
        ++l;
        ++r;
    }
    if (s.rows < least || alike < most * s.rows || whole < most * s.rows) return std::nullopt;
    s.left = left_fit.line();
    s.right = right_fit.line();
    s.inside = inside * (1.F / static_cast<float>(s.rows));
    s.contrast /= s.rows;
    return s;
}

double StripSeedFinder::unlike(const Appearance& a, const Appearance& surface, float shade) const {
    return static_cast<double>(std::sqrt(squared_unlikeness(a, surface, chroma_weight_, shade)));
}

double StripSeedFinder::from_left(std::size_t edge) {
    const RowEdge& e = frame_->edges[edge];
    if (from_left_[edge] < 0.F)
        from_left_[edge] = std::sqrt(squared_unlikeness(e.left, e.right, chroma_weight_));
    return static_cast<double>(from_left_[edge]);
}

double StripSeedFinder::from_right(std::size_t edge) {
    const RowEdge& e = frame_->edges[edge];
    if (from_right_[edge] < 0.F)
        from_right_[edge] = std::sqrt(squared_unlikeness(e.right, e.left, chroma_weight_));
    return static_cast<double>(from_right_[edge]);
}

}  // namespace goalmouth
