#include "core/conversion/segments.h"

#include "core/conversion/intrinsics.h"

#include <cmath>
#include <vector>

namespace goalmouth {
namespace {

constexpr std::size_t line_bytes = 5;
constexpr std::size_t segment_bytes = 6;

std::size_t bytes_of(const ScanLine& line) {
    return line_bytes + segment_bytes * static_cast<std::size_t>(line.count);
}

/// The lines that fit into `budget` bytes: `kept` of `all`, evenly spread, as many as possible.
std::vector<ScanLine> lines_that_fit(const std::vector<ScanLine>& all, std::size_t budget) {
    for (std::size_t kept = all.size(); kept > 0; --kept) {
        std::vector<ScanLine> lines;
        std::size_t bytes = 0;
        for (std::size_t i = 0; i < all.size(); ++i) {
            if ((i + 1) * kept / all.size() == i * kept / all.size()) continue;
            lines.push_back(all[i]);
            bytes += bytes_of(all[i]);
        }
        if (bytes <= budget) return lines;
        // Jump most of the way when far off.
        const std::size_t guess = kept * budget / bytes + kept / 50 + 1;
        if (guess < kept) kept = guess + 1;
    }
    return {};
}

std::int8_t hundredths(const Segment& s) {
    return static_cast<std::int8_t>(std::lround(100.F * (s.transition - static_cast<float>(s.start) + 0.5F)));
}

}  // namespace

segments_t to_message(const Segments& segments, std::int64_t utime, std::int64_t seq,
                      const Intrinsics& camera, const std::string& table, std::size_t limit) {
    segments_t m{};
    m.utime = utime;
    m.seq = seq;
    m.intrinsics = to_message(camera);
    m.table = table;
    const auto fixed = static_cast<std::size_t>(m.getEncodedSize());
    const auto lines = lines_that_fit(segments.lines, limit > fixed ? limit - fixed : 0);
    m.lines_left_out = static_cast<std::int32_t>(segments.lines.size() - lines.size());
    m.num_lines = static_cast<std::int32_t>(lines.size());
    for (const ScanLine& line : lines) {
        m.line_orientation.push_back(static_cast<std::int8_t>(line.orientation));
        m.line_position.push_back(static_cast<std::int16_t>(line.position));
        m.line_count.push_back(static_cast<std::int16_t>(line.count));
        for (int i = line.first; i < line.first + line.count; ++i) {
            const Segment& s = segments.segments[static_cast<std::size_t>(i)];
            m.start.push_back(s.start);
            m.end.push_back(s.end);
            m.colour.push_back(static_cast<std::int8_t>(s.colour));
            m.transition_offset.push_back(hundredths(s));
        }
    }
    m.num_segments = static_cast<std::int32_t>(m.start.size());
    return m;
}

Segments from_message(const segments_t& m) {
    Segments segments;
    segments.width = m.intrinsics.width;
    segments.height = m.intrinsics.height;
    int first = 0;
    for (std::size_t i = 0; i < m.line_position.size(); ++i) {
        segments.lines.push_back(
            {static_cast<Orientation>(m.line_orientation[i]), m.line_position[i], first, m.line_count[i]});
        first += m.line_count[i];
    }
    for (std::size_t i = 0; i < m.start.size(); ++i) {
        const float nominal = static_cast<float>(m.start[i]) - 0.5F;
        segments.segments.push_back({m.start[i], m.end[i], static_cast<Colour>(m.colour[i]),
                                     nominal + static_cast<float>(m.transition_offset[i]) / 100.F});
    }
    return segments;
}

}  // namespace goalmouth
