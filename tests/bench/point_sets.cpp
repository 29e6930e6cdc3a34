#include "tests/bench/point_sets.h"

#include "core/detection/line_search.h"
#include "core/detection/ransac_parameters.h"
#include "core/random/random.h"
#include "tests/bench/rounds.h"
#include "tests/reference/literal_ransac.h"

#include <fmt/format.h>
#include <iterator>
#include <memory>

namespace goalmouth::bench {
namespace {

constexpr std::size_t sets = 64;   // of each number of points
constexpr std::size_t block = 16;  // sets in a turn
constexpr double width = 1600.0;   // px
constexpr double height = 1200.0;  // px

using Points = std::vector<Eigen::Vector2d>;

/// Points along an edge, as scan-lines cut it.
void add_edge(Points& points, std::size_t count, Random& random, double length) {
    const double x = random.uniform(0.2 * width, 0.8 * width);
    const double top = random.uniform(0.0, height - length);
    const double lean = random.uniform(-0.2, 0.2);
    for (std::size_t i = 0; i < count; ++i) {
        const double along = length * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
        points.emplace_back(x + lean * along + 0.5 * random.normal(), top + along);
    }
}

/// Searches the lines of a set of points; they are valid until the next search.
using Search = std::function<const std::vector<EdgeLine>&(const Points&, Random&)>;

Search our_search() {
    const auto search = std::make_shared<LineSearch>(RansacParameters{});
    return [search](const Points& points, Random& random) -> const std::vector<EdgeLine>& {
        return search->find(points, random);
    };
}

Search literal_search() {
    const auto lines = std::make_shared<std::vector<EdgeLine>>();
    return [lines](const Points& points, Random& random) -> const std::vector<EdgeLine>& {
        return *lines = find_lines_literally(points, RansacParameters{}, random);
    };
}

struct PointSets {
    std::vector<Points> sets;
    std::uint64_t seed;

    const std::vector<EdgeLine>& search(const Search& way, std::size_t item) const {
        Random random(seed + item);
        return way(sets[item], random);
    }
};

Contender searching(const std::shared_ptr<const PointSets>& data, const char* name, const Search& way) {
    Contender contender;
    contender.name = fmt::format("{}_{}", name, data->sets.front().size());
    contender.label = contender.name;
    contender.run = [data, way](std::size_t item, std::vector<double>&) { data->search(way, item); };
    return contender;
}

/// Whether both find the same in every set, and how many lines on average.
void compare(const PointSets& data, PointRow& row) {
    const Search ours = our_search();
    const Search literal = literal_search();
    std::size_t lines = 0;
    row.same_consensus = true;
    for (std::size_t i = 0; i < data.sets.size(); ++i) {
        const std::vector<EdgeLine>& plain = data.search(literal, i);
        row.same_consensus = row.same_consensus && same_lines(data.search(ours, i), plain);
        lines += plain.size();
    }
    row.lines = static_cast<double>(lines) / static_cast<double>(data.sets.size());
}

Turns turns_of_sets() {
    return share_turns(sets, block, 2 * std::size(point_counts));
}

}  // namespace

std::vector<Eigen::Vector2d> edge_point_set(std::size_t points, std::uint64_t seed) {
    Random random(seed);
    Points result;
    add_edge(result, points * 45 / 100, random, 0.7 * height);
    add_edge(result, points * 25 / 100, random, 0.6 * height);
    add_edge(result, points / 10, random, 0.1 * height);
    while (result.size() < points)
        result.emplace_back(random.uniform(0.0, width), random.uniform(0.0, height));
    return result;
}

bool same_lines(const std::vector<EdgeLine>& a, const std::vector<EdgeLine>& b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a[i].support != b[i].support || a[i].rms != b[i].rms ||
            a[i].segment.upper != b[i].segment.upper || a[i].segment.lower != b[i].segment.lower)
            return false;
    }
    return true;
}

std::size_t point_steps(const PointOptions& options) {
    const Turns turns = turns_of_sets();
    return options.repetitions * turns.blocks * turns.contenders;
}

std::vector<PointRow> run_point_sets(const PointOptions& options) {
    const Turns turns = turns_of_sets();
    std::vector<PointRow> rows;
    std::vector<Contender> contenders;
    for (const std::size_t count : point_counts) {
        auto data = std::make_shared<PointSets>();
        data->seed = options.seed;
        for (std::size_t i = 0; i < turns.items(); ++i)
            data->sets.push_back(edge_point_set(count, options.seed + i));
        PointRow row;
        row.points = count;
        compare(*data, row);
        rows.push_back(row);
        contenders.push_back(searching(data, "ransac_search", our_search()));
        contenders.push_back(searching(data, "ransac_literal", literal_search()));
    }
    const std::vector<Timing> timings = run_rounds(
        contenders, turns, {options.repetitions, options.stop, options.step, StopwatchClock::wall});
    if (timings.empty()) return {};
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].ours = timings[2 * i];
        rows[i].literal = timings[2 * i + 1];
    }
    return rows;
}

}  // namespace goalmouth::bench
