#include "core/detection/edge_lines.h"

#include <cmath>
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

std::vector<EdgeLine> find_lines(const std::vector<Eigen::Vector2d>& points,
                                 const RansacParameters& parameters, Random& random) {
    std::vector<EdgeLine> lines;
    for (const auto& [primitive, consensus] : find_primitives<LinePrimitive>(points, parameters, random)) {
        double squares = 0.0;
        for (const auto& p : consensus) squares += std::pow(primitive.line.signed_distance(p), 2);
        const double count = static_cast<double>(consensus.size());
        lines.push_back({segment_on_line(primitive.line, consensus), static_cast<int>(consensus.size()),
                         std::sqrt(squares / count)});
    }
    return lines;
}

}  // namespace goalmouth
