#include "core/extraction/extraction.h"
#include "core/random/random.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

/// Rows and columns of random runs of colours.
Segments random_segments(Random& random) {
    Segments segments;
    segments.width = static_cast<int>(1 + random.index(200));
    segments.height = static_cast<int>(1 + random.index(150));
    const double goal = random.uniform();
    const std::uint32_t longest = 1 + random.index(40);
    const int spacing = static_cast<int>(1 + random.index(8));
    const auto add = [&](Orientation orientation, int position, int size) {
        ScanLine line{orientation, position, static_cast<int>(segments.segments.size()), 0};
        Colour before = Colour::ball;
        for (int x = 0; x < size; ++line.count) {
            const int end = std::min(size - 1, x + static_cast<int>(random.index(longest)));
            Colour colour = random.uniform() < goal ? Colour::goal : Colour::field;
            if (colour == before) colour = colour == Colour::goal ? Colour::field : Colour::unclassified;
            const float shift = x == 0 ? 0.F : static_cast<float>(random.uniform(-0.5, 0.5));
            segments.segments.push_back({static_cast<std::int16_t>(x), static_cast<std::int16_t>(end), colour,
                                         static_cast<float>(x) - 0.5F + shift});
            before = colour;
            x = end + 1;
        }
        segments.lines.push_back(line);
    };
    for (int y = 0; y < segments.height; y += spacing) add(Orientation::horizontal, y, segments.width);
    for (int x = 0; x < segments.width; x += spacing) add(Orientation::vertical, x, segments.height);
    return segments;
}

CandidateParameters random_parameters(Random& random) {
    CandidateParameters p;
    p.largest_gap = static_cast<int>(random.index(4));
    p.gap_share = 0.2 * random.index(3);
    p.shortest = static_cast<int>(1 + random.index(5));
    p.longest = random.index(2) ? 1.0 : random.uniform();
    p.must_reach_border = random.index(2) == 1;
    p.border_tolerance = random.uniform(0, 0.2);
    p.region_gap = static_cast<int>(1 + random.index(6));
    p.least_rows = static_cast<int>(1 + random.index(8));
    return p;
}

struct PlainRun {
    CandidateSegment segment;
    int row = 0;
    int region = 0;
};

/// The runs of the rows whose region is good, by the plainest way: each run takes on the smallest number
/// among those it touches until nothing changes.
std::vector<CandidateSegment> good_rows(const Segments& segments, const FieldBorder& border,
                                        const CandidateParameters& parameters) {
    std::vector<PlainRun> runs;
    int row = -1;
    for (const ScanLine& line : segments.lines) {
        if (line.orientation != Orientation::horizontal) continue;
        ++row;
        std::vector<PlainRun> on_row;
        for (int i = line.first; i < line.first + line.count; ++i) {
            const Segment& s = segments.segments[static_cast<std::size_t>(i)];
            if (s.colour != Colour::goal) continue;
            const int gap = on_row.empty() ? 0 : s.start - on_row.back().segment.end - 1;
            if (!on_row.empty() &&
                (gap <= parameters.largest_gap ||
                 gap <= parameters.gap_share * (on_row.back().segment.length() + s.length())))
                on_row.back().segment.end = s.end;
            else
                on_row.push_back({{Orientation::horizontal, line.position, s.start, s.end}, row, 0});
        }
        for (PlainRun& run : on_row) {
            if (run.segment.length() < parameters.shortest ||
                run.segment.length() > parameters.longest * segments.width)
                continue;
            run.region = static_cast<int>(runs.size());
            runs.push_back(run);
        }
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (PlainRun& a : runs) {
            for (PlainRun& b : runs) {
                const int apart = std::abs(a.row - b.row);
                if (apart == 0 || apart > parameters.region_gap || a.region <= b.region ||
                    a.segment.start > b.segment.end + 1 || b.segment.start > a.segment.end + 1)
                    continue;
                a.region = b.region;
                changed = true;
            }
        }
    }
    std::vector<CandidateSegment> good;
    for (const PlainRun& run : runs) {
        std::vector<int> rows;
        bool stands = !parameters.must_reach_border || border.empty();
        for (const PlainRun& other : runs) {
            if (other.region != run.region) continue;
            rows.push_back(other.row);
            const Eigen::Vector2d centre = other.segment.centre();
            stands = stands ||
                     centre.y() >= border.y_at(centre.x()) - parameters.border_tolerance * segments.height;
        }
        const auto different = std::unique(rows.begin(), rows.end()) - rows.begin();
        if (stands && different >= parameters.least_rows) good.push_back(run.segment);
    }
    return good;
}

bool same(const CandidateSegment& a, const CandidateSegment& b) {
    return a.orientation == b.orientation && a.line == b.line && a.start == b.start && a.end == b.end;
}

bool same(const Candidates& a, const Candidates& b) {
    return std::equal(a.segments.begin(), a.segments.end(), b.segments.begin(), b.segments.end(),
                      [](const auto& x, const auto& y) { return same(x, y); }) &&
           a.left_edges == b.left_edges && a.right_edges == b.right_edges;
}

TEST(Extraction, KeepsTheRowsThatThePlainestGroupingKeeps) {
    std::size_t kept = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        Random random(seed);
        const Segments segments = random_segments(random);
        const CandidateParameters parameters = random_parameters(random);
        const FieldBorder border = find_border(segments, {});
        const Candidates found = extract_candidates(segments, border, parameters);
        const auto expected = good_rows(segments, border, parameters);
        kept += expected.size();
        const auto columns = std::find_if(found.segments.begin(), found.segments.end(), [](const auto& s) {
            return s.orientation == Orientation::vertical;
        });
        ASSERT_TRUE(std::equal(found.segments.begin(), columns, expected.begin(), expected.end(),
                               [](const auto& a, const auto& b) { return same(a, b); }))
            << "seed " << seed;
    }
    EXPECT_GT(kept, 10000U);
}

TEST(Extraction, DoesNotAskForTheOrderOfTheLines) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        Random random(seed);
        Segments segments = random_segments(random);
        const FieldBorder border = find_border(segments, {});
        const Candidates found = extract_candidates(segments, border, {});
        for (std::size_t i = segments.lines.size(); i > 1; --i)
            std::swap(segments.lines[i - 1], segments.lines[random.index(static_cast<std::uint32_t>(i))]);
        EXPECT_EQ(find_border(segments, {}).hull, border.hull);
        EXPECT_TRUE(same(extract_candidates(segments, border, {}), found)) << "seed " << seed;
    }
}

TEST(Extraction, ForgetsTheLastFrame) {
    Random random(5);
    BorderFinder finder({});
    CandidateExtractor extractor({});
    for (int frame = 0; frame < 200; ++frame) {
        const Segments segments = random_segments(random);
        const FieldBorder& border = finder.find(segments);
        EXPECT_EQ(border.hull, find_border(segments, {}).hull);
        EXPECT_TRUE(same(extractor.extract(segments, border), extract_candidates(segments, border, {})));
    }
}

}  // namespace
}  // namespace goalmouth
