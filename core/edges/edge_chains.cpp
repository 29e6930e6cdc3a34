#include "core/edges/edge_chains.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {
namespace {

/// Points a prediction rests on, and how many it takes to know the direction.
constexpr std::size_t points_ahead = 12;
constexpr std::size_t points_of_a_direction = 4;

/// So few are counted more quickly than halved.
constexpr std::size_t few_places = 24;

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
    links_.clear();
    tracks_.clear();
    const double largest_slope = std::tan(parameters_.largest_lean);
    for (std::size_t row = 0; row < frame.rows.size(); ++row) {
        const auto edges = frame.of(row);
        claimed_.assign(edges.size(), 0);
        places_.clear();
        for (const RowEdge& edge : edges) places_.push_back(static_cast<double>(edge.x));
        std::size_t kept = 0;
        for (Track& track : tracks_) {
            const double step = frame.rows[row] - frame.y(track.last_row);
            const bool has_direction = track.points >= points_of_a_direction;
            double tolerance = straightness_;
            if (!has_direction) tolerance += std::max(0.0, largest_slope - std::abs(track.ahead.b)) * step;
            const RowEdge* next = next_edge(edges, track, track.ahead.at(frame.rows[row]), tolerance);
            bool goes_on = false;
            if (next != nullptr) {
                extend(track, row, static_cast<std::size_t>(next - edges.data()));
                goes_on = !has_direction || std::abs(track.ahead.b) <= largest_slope;
            } else {
                goes_on = has_direction && static_cast<int>(row) - track.last_row <= parameters_.largest_gap;
            }
            if (!goes_on) {
                end(track);
                continue;
            }
            if (&track != &tracks_[kept]) tracks_[kept] = track;
            ++kept;
        }
        tracks_.resize(kept);
        begin_chains(row);
    }
    for (const Track& track : tracks_) end(track);
    return {chains_.data(), straighten()};
}

/// The likeliest edge within `tolerance` of x that no chain has claimed.
const RowEdge* ChainFinder::next_edge(std::span<const RowEdge> edges, const Track& track, double x,
                                      double tolerance) const {
    const RowEdge* best = nullptr;
    double least = 0.0;
    std::size_t begin = 0;
    if (places_.size() <= few_places) {
        for (const double each : places_) begin += each < x - tolerance ? 1 : 0;
    } else {
        begin = static_cast<std::size_t>(std::lower_bound(places_.begin(), places_.end(), x - tolerance) -
                                         places_.begin());
    }
    for (std::size_t i = begin; i < edges.size() && places_[i] <= x + tolerance; ++i) {
        const RowEdge* e = &edges[i];
        if (claimed_[i] || inside_is_field(*e, side_)) continue;
        const double bound = parameters_.sameness * static_cast<double>(e->strength);
        const auto squared =
            static_cast<double>(squared_unlikeness(inside_of(*e, side_), track.inside, chroma_weight_));
        if (squared > bound * bound) continue;
        const double off = (places_[i] - x) / tolerance;
        const double cost = squared / (bound * bound) + off * off;
        if (best != nullptr && cost >= least) continue;
        best = e;
        least = cost;
    }
    return best;
}

double ChainFinder::x_of(const Link& link) const {
    return static_cast<double>(frame_->edges[link.point.edge].x);
}

void ChainFinder::extend(Track& track, std::size_t row, std::size_t edge) {
    claimed_[edge] = 1;
    links_[track.last].after = links_.size();
    links_.push_back({{static_cast<int>(row), frame_->first[row] + edge}, track.last, 0});
    track.last = links_.size() - 1;
    track.last_row = static_cast<int>(row);
    ++track.points;
    const float share = std::max(1.F / static_cast<float>(track.points), 0.1F);
    track.inside = track.inside * (1.F - share) + inside_of(frame_->of(row)[edge], side_) * share;
    lead_on(track);
}

void ChainFinder::lead_on(Track& track) {
    const Link& last = links_[track.last];
    track.latest.add(x_of(last), frame_->y(last.point.row));
    if (track.points > points_ahead) {
        const Link& oldest = links_[track.oldest];
        track.latest.take_away(x_of(oldest), frame_->y(oldest.point.row));
        track.oldest = oldest.after;
    }
    track.ahead = track.latest.line();
    if (track.points < points_of_a_direction) {
        // Half of what few points say of the direction, from the latest on.
        track.ahead.b *= 0.5;
        track.ahead.a = x_of(last) - track.ahead.b * frame_->y(last.point.row);
    }
}

/// One chain from each edge that continues none.
void ChainFinder::begin_chains(std::size_t row) {
    const auto edges = frame_->of(row);
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const Appearance& inside = inside_of(edges[i], side_);
        if (claimed_[i] || inside_is_field(edges[i], side_) || inside.y < darkest_) continue;
        Track track;
        track.last = track.oldest = links_.size();
        track.points = 1;
        track.latest.add(static_cast<double>(edges[i].x), frame_->rows[row]);
        track.ahead = {static_cast<double>(edges[i].x), 0.0};
        track.last_row = static_cast<int>(row);
        track.inside = inside;
        tracks_.push_back(track);
        links_.push_back({{static_cast<int>(row), frame_->first[row] + i}, 0, 0});
    }
}

/// Most end after a point or two: only the others become chains.
void ChainFinder::end(const Track& track) {
    if (track.points < static_cast<std::size_t>(parameters_.least_rows)) return;
    if (count_ == chains_.size()) chains_.emplace_back();
    EdgeChain& chain = chains_[count_++];
    chain.points.resize(track.points);
    std::size_t link = track.last;
    for (auto point = chain.points.rbegin(); point != chain.points.rend(); ++point) {
        *point = links_[link].point;
        link = links_[link].before;
    }
}

/// In the order in which they begin; a line through each chain, and off with the points beside it. Returns
/// how many chains are left.
std::size_t ChainFinder::straighten() {
    const auto least = static_cast<std::size_t>(parameters_.least_rows);
    const auto x = [&](const ChainPoint& p) { return static_cast<double>(frame_->edges[p.edge].x); };
    std::sort(
        chains_.begin(), chains_.begin() + static_cast<std::ptrdiff_t>(count_),
        [](const EdgeChain& a, const EdgeChain& b) { return a.points.front().edge < b.points.front().edge; });
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
