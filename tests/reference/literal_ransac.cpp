#include "tests/reference/literal_ransac.h"

#include <optional>
#include <span>

namespace goalmouth {
namespace {

/// A straight line as find_primitives() wants its primitives.
struct LinePrimitive {
    static constexpr std::size_t sample_size = 2;
    static std::optional<LinePrimitive> through(std::span<const Eigen::Vector2d> sample) {
        return wrap(line_through(sample[0], sample[1]));
    }
    static std::optional<LinePrimitive> fit(std::span<const Eigen::Vector2d> points) {
        return wrap(fit_line(points));
    }
    double distance(const Eigen::Vector2d& p) const { return line.distance(p); }

    Line line;

  private:
    static std::optional<LinePrimitive> wrap(const std::optional<Line>& line) {
        if (!line) return std::nullopt;
        return LinePrimitive{*line};
    }
};

}  // namespace

std::vector<EdgeLine> find_lines_literally(const std::vector<Eigen::Vector2d>& points,
                                           const RansacParameters& parameters, Random& random) {
    std::vector<EdgeLine> lines;
    for (const auto& [primitive, consensus] : find_primitives<LinePrimitive>(points, parameters, random))
        lines.push_back(edge_line(primitive.line, consensus));
    return lines;
}

}  // namespace goalmouth
