#include "core/edges/edge_chains.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {
namespace {

/// Points a prediction rests on, and how many it takes to know the direction.
constexpr std::size_t points_ahead = 12;
constexpr std::size_t points_of_a_direction = 4;

bool inside_is_field(const RowEdge& edge, ChainSide side) {
    return side == ChainSide::left ? edge.right_is_field : edge.left_is_field;
}

}  // namespace

std::span<const EdgeChain> ChainFinder::find(const FrameEdges& frame, ChainSide side,
                                             const EdgeThreshold& threshold, double straightness,
                                             float darkest) {
    frame_ = &frame;
    side_ = side;
    chroma_weight_ = threshold.chroma_weight;
    straightness_ = straightness;
    darkest_ = darkest;
    count_ = 0;
    tracks_.clear();
    const double largest_slope = std::tan(parameters_.largest_lean);
    for (std::size_t row = 0; row < frame.rows.size(); ++row) {
        const auto edges = frame.of(row);
        claimed_.assign(edges.size(), 0);
        std::size_t kept = 0;
        for (Track track : tracks_) {
            const double step = frame.rows[row] - frame.y(track.last_row);
            const std::size_t points = chains_[track.chain].points.size();
            double tolerance = straightness_;
            if (points < points_of_a_direction)
                tolerance += std::max(0.0, largest_slope - std::abs(track.ahead.b)) * step;
            const RowEdge* next = next_edge(edges, track, track.ahead.at(frame.rows[row]), tolerance);
            if (next != nullptr) {
                extend(track, row, static_cast<std::size_t>(next - edges.data()));
                if (points >= points_of_a_direction && std::abs(track.ahead.b) > largest_slope) continue;
            } else if (points < points_of_a_direction ||
                       static_cast<int>(row) - track.last_row > parameters_.largest_gap) {
                continue;
            }
            tracks_[kept++] = track;
        }
        tracks_.resize(kept);
        begin_chains(row);
    }
    return {chains_.data(), straighten()};
}

/// The likeliest edge within `tolerance` of x that no chain has claimed.
const RowEdge* ChainFinder::next_edge(std::span<const RowEdge> edges, const Track& track, double x,
                                      double tolerance) const {
    const RowEdge* best = nullptr;
    double least = 0.0;
    const auto begin =
        std::lower_bound(edges.begin(), edges.end(), x - tolerance,
                         [](const RowEdge& e, double value) { return static_cast<double>(e.x) < value; });
    for (auto e = begin; e != edges.end() && static_cast<double>(e->x) <= x + tolerance; ++e) {
        if (claimed_[static_cast<std::size_t>(e - edges.begin())] || inside_is_field(*e, side_)) continue;
        const double bound = parameters_.sameness * static_cast<double>(e->strength);
        const double unlike =
            static_cast<double>(squared_unlikeness(inside_of(*e, side_), track.inside, chroma_weight_)) /
            (bound * bound);
        if (unlike > 1.0) continue;
        const double off = (static_cast<double>(e->x) - x) / tolerance;
        const double cost = unlike + off * off;
        if (best != nullptr && cost >= least) continue;
        best = &*e;
        least = cost;
    }
    return best;
}

void ChainFinder::extend(Track& track, std::size_t row, std::size_t edge) {
    claimed_[edge] = 1;
    EdgeChain& chain = chains_[track.chain];
    chain.points.push_back({static_cast<int>(row), frame_->first[row] + edge});
    track.last_row = static_cast<int>(row);
    const float share = std::max(1.F / static_cast<float>(chain.points.size()), 0.1F);
    track.inside = track.inside * (1.F - share) + inside_of(frame_->of(row)[edge], side_) * share;
    track.ahead = lead_on(chain);
}

UprightLine ChainFinder::lead_on(const EdgeChain& chain) const {
    const auto& points = chain.points;
    UprightFit fit;
    for (std::size_t i = points.size() - std::min(points.size(), points_ahead); i < points.size(); ++i)
        fit.add(static_cast<double>(frame_->edges[points[i].edge].x), frame_->y(points[i].row));
    UprightLine line = fit.line();
    if (points.size() < points_of_a_direction) {
        // Half of what few points say of the direction, from the latest on.
        line.b *= 0.5;
        line.a =
            static_cast<double>(frame_->edges[points.back().edge].x) - line.b * frame_->y(points.back().row);
    }
    return line;
}

/// One chain from each edge that continues none.
void ChainFinder::begin_chains(std::size_t row) {
    const auto edges = frame_->of(row);
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const Appearance& inside = inside_of(edges[i], side_);
        if (claimed_[i] || inside_is_field(edges[i], side_) || inside.y < darkest_) continue;
        if (count_ == chains_.size()) chains_.emplace_back();
        chains_[count_].points.assign(1, {static_cast<int>(row), frame_->first[row] + i});
        tracks_.push_back({count_, {static_cast<double>(edges[i].x), 0.0}, static_cast<int>(row), inside});
        ++count_;
    }
}

/// A line through each chain, and off with the points beside it. Returns how many chains are left.
std::size_t ChainFinder::straighten() {
    const auto least = static_cast<std::size_t>(parameters_.least_rows);
    const auto x = [&](const ChainPoint& p) { return static_cast<double>(frame_->edges[p.edge].x); };
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i) {
        EdgeChain& chain = chains_[i];
        while (chain.points.size() >= least) {
            UprightFit fit;
            for (const ChainPoint& p : chain.points) fit.add(x(p), frame_->y(p.row));
            chain.line = fit.line();
            double farthest = 0.0;
            for (const ChainPoint& p : chain.points)
                farthest = std::max(farthest, std::abs(x(p) - chain.line.at(frame_->y(p.row))));
            if (farthest <= straightness_) break;
            // The worst first: where a post bends into its crossbar, they have pulled the line over.
            const double too_far = std::max(straightness_, 0.7 * farthest);
            std::erase_if(chain.points, [&](const ChainPoint& p) {
                return std::abs(x(p) - chain.line.at(frame_->y(p.row))) > too_far;
            });
        }
        if (chain.points.size() < least) continue;
        if (i != kept) std::swap(chain, chains_[kept]);
        ++kept;
    }
    return kept;
}

}  // namespace goalmouth
