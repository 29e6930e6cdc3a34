#include "core/edges/strip_seeds.h"

#include "core/edges/frame_scale.h"

#include <algorithm>
#include <cmath>
#include <optional>

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

class PairOfChains {
  public:
    PairOfChains(const FrameEdges& frame, const StripParameters& parameters, float chroma_weight,
                 double straightness)
        : frame_(frame),
          parameters_(parameters),
          chroma_weight_(chroma_weight),
          straightness_(straightness) {}

    std::optional<StripSeed> seed(const EdgeChain& left, const EdgeChain& right, int width) {
        StripSeed s;
        s.first_row = std::max(left.points.front().row, right.points.front().row);
        s.last_row = std::min(left.points.back().row, right.points.back().row);
        const int common = s.last_row - s.first_row + 1;
        if (common < parameters_.least_rows) return std::nullopt;
        const double upper = right.line.at(frame_.y(s.first_row)) - left.line.at(frame_.y(s.first_row));
        const double lower = right.line.at(frame_.y(s.last_row)) - left.line.at(frame_.y(s.last_row));
        const double mean = 0.5 * (upper + lower);
        if (mean < narrowest_px(parameters_, width) || mean > parameters_.widest * width ||
            std::min(upper, lower) <= 0.0)
            return std::nullopt;
        if (std::abs(upper - lower) > parameters_.largest_taper * mean + straightness_) return std::nullopt;

        int alike = 0;
        int whole = 0;
        UprightFit left_fit, right_fit;
        Appearance inside;
        auto l = left.points.begin();
        auto r = right.points.begin();
        while (l != left.points.end() && r != right.points.end()) {
            if (l->row != r->row || l->edge >= r->edge) {
                ++(l->row < r->row ? l : r);
                continue;
            }
            const RowEdge& a = frame_.edges[l->edge];
            const RowEdge& b = frame_.edges[r->edge];
            const double distinct = std::min(unlike(a.left, a.right), unlike(b.right, b.left));
            alike += unlike(a.right, b.left, shade_across) < across * parameters_.sameness * distinct;
            whole += !interrupted(l->edge, r->edge, distinct);
            left_fit.add(static_cast<double>(a.x), frame_.y(l->row));
            right_fit.add(static_cast<double>(b.x), frame_.y(r->row));
            inside = inside + (a.right + b.left) * 0.5F;
            s.contrast += distinct;
            ++s.rows;
            ++l;
            ++r;
        }
        if (s.rows < parameters_.least_rows || s.rows < most * common) return std::nullopt;
        if (alike < most * s.rows || whole < most * s.rows) return std::nullopt;
        s.left = left_fit.line();
        s.right = right_fit.line();
        s.inside = inside * (1.F / static_cast<float>(s.rows));
        s.contrast /= s.rows;
        return s;
    }

  private:
    double unlike(const Appearance& a, const Appearance& surface, float shade = 0.25F) const {
        return std::sqrt(static_cast<double>(squared_unlikeness(a, surface, chroma_weight_, shade)));
    }

    bool interrupted(std::size_t left, std::size_t right, double distinct) const {
        for (std::size_t i = left + 1; i < right; ++i) {
            const RowEdge& e = frame_.edges[i];
            const auto x = static_cast<double>(e.x);
            const bool between = x > static_cast<double>(frame_.edges[left].x) + straightness_ &&
                                 x < static_cast<double>(frame_.edges[right].x) - straightness_;
            if (between && unlike(e.left, e.right) > interruption * distinct) return true;
        }
        return false;
    }

    const FrameEdges& frame_;
    const StripParameters& parameters_;
    float chroma_weight_;
    double straightness_;
};

}  // namespace

void find_strip_seeds(const FrameEdges& frame, std::span<const EdgeChain> left,
                      std::span<const EdgeChain> right, const StripParameters& parameters,
                      float chroma_weight, double straightness, int width, std::vector<StripSeed>& seeds) {
    seeds.clear();
    PairOfChains pair(frame, parameters, chroma_weight, straightness);
    for (const EdgeChain& l : left)
        for (const EdgeChain& r : right)
            if (const auto seed = pair.seed(l, r, width)) seeds.push_back(*seed);
    std::stable_sort(seeds.begin(), seeds.end(), [](const StripSeed& a, const StripSeed& b) {
        return a.rows * a.contrast > b.rows * b.contrast;
    });
}

}  // namespace goalmouth
