#pragma once

#include <algorithm>
#include <cmath>

namespace goalmouth {

/// Share of a pixel's square that lies on the positive side of a straight edge, exactly. The signed distance
/// of the pixel's centre is s(u, v) = value, in any unit, with gradients gu and gv per pixel.
class EdgeCoverage {
  public:
    EdgeCoverage(float gu, float gv) {
        const float a = std::abs(gu);
        const float b = std::abs(gv);
        small_ = std::min(a, b);
        large_ = std::max(a, b);
        outer_ = 0.5F * (large_ + small_);
        inner_ = 0.5F * (large_ - small_);
    }

    float operator()(float s) const {
        const float a = std::abs(s);
        if (a >= outer_) return s >= 0.0F ? 1.0F : 0.0F;  // most pixels: divisions only where the edge cuts
        // The square seen along the edge's normal is a trapezoid: flat within inner_, sloping to outer_.
        float beyond_half;
        if (a <= inner_) {
            beyond_half = a / large_;
        } else {
            const float rest = outer_ - a;
            beyond_half = 0.5F - 0.5F * rest * rest / (small_ * large_);
        }
        return s >= 0.0F ? 0.5F + beyond_half : 0.5F - beyond_half;
    }

    /// Largest |s| at which the edge still crosses the pixel.
    float reach() const { return outer_; }

  private:
    float outer_;
    float inner_;
    float small_;
    float large_;
};

/// Share covered by a strip between two parallel edges, from the shares inside each.
inline float strip_coverage(float inside_one, float inside_other) {
    return std::max(0.0F, inside_one + inside_other - 1.0F);
}

}  // namespace goalmouth
