#include "core/conversion/candidates.h"

#include "core/conversion/intrinsics.h"

#include <vector>

namespace goalmouth {
namespace {

constexpr std::size_t segment_bytes = 7;
constexpr std::size_t field_bytes = 6;
constexpr std::size_t point_bytes = 8;

/// The share budget/needed of the items, evenly spread; all where they fit.
template <class Item>
std::vector<Item> thinned(const std::vector<Item>& items, std::size_t budget, std::size_t needed) {
    if (needed <= budget) return items;
    std::vector<Item> kept;
    for (std::size_t i = 0; i < items.size(); ++i) {
        if ((i + 1) * budget / needed > i * budget / needed) kept.push_back(items[i]);
    }
    return kept;
}

}  // namespace

candidates_t to_message(const Candidates& candidates, std::int64_t utime, std::int64_t seq,
                        const Intrinsics& camera, std::size_t limit) {
    candidates_t m{};
    m.utime = utime;
    m.seq = seq;
    m.intrinsics = to_message(camera);
    const auto fixed = static_cast<std::size_t>(m.getEncodedSize());
    const std::size_t budget = limit > fixed ? limit - fixed : 0;
    const std::size_t needed = segment_bytes * candidates.segments.size() +
                               field_bytes * candidates.field.size() +
                               point_bytes * (candidates.left_edges.size() + candidates.right_edges.size());
    for (const CandidateSegment& s : thinned(candidates.segments, budget, needed)) {
        m.orientation.push_back(static_cast<std::int8_t>(s.orientation));
        m.line.push_back(static_cast<std::int16_t>(s.line));
        m.start.push_back(static_cast<std::int16_t>(s.start));
        m.end.push_back(static_cast<std::int16_t>(s.end));
    }
    for (const FieldRun& f : thinned(candidates.field, budget, needed)) {
        m.field_line.push_back(static_cast<std::int16_t>(f.line));
        m.field_start.push_back(static_cast<std::int16_t>(f.start));
        m.field_end.push_back(static_cast<std::int16_t>(f.end));
    }
    for (const auto& p : thinned(candidates.left_edges, budget, needed)) {
        m.left_x.push_back(static_cast<float>(p.x()));
        m.left_y.push_back(static_cast<float>(p.y()));
    }
    for (const auto& p : thinned(candidates.right_edges, budget, needed)) {
        m.right_x.push_back(static_cast<float>(p.x()));
        m.right_y.push_back(static_cast<float>(p.y()));
    }
    m.num_segments = static_cast<std::int32_t>(m.line.size());
    m.num_field = static_cast<std::int32_t>(m.field_line.size());
    m.num_left = static_cast<std::int32_t>(m.left_x.size());
    m.num_right = static_cast<std::int32_t>(m.right_x.size());
    return m;
}

Candidates from_message(const candidates_t& m) {
    Candidates candidates;
    candidates.width = m.intrinsics.width;
    candidates.height = m.intrinsics.height;
    for (std::size_t i = 0; i < m.line.size(); ++i) {
        candidates.segments.push_back(
            {static_cast<Orientation>(m.orientation[i]), m.line[i], m.start[i], m.end[i]});
    }
    for (std::size_t i = 0; i < m.field_line.size(); ++i)
        candidates.field.push_back({m.field_line[i], m.field_start[i], m.field_end[i]});
    for (std::size_t i = 0; i < m.left_x.size(); ++i)
        candidates.left_edges.emplace_back(m.left_x[i], m.left_y[i]);
    for (std::size_t i = 0; i < m.right_x.size(); ++i)
        candidates.right_edges.emplace_back(m.right_x[i], m.right_y[i]);
    return candidates;
}

}  // namespace goalmouth
