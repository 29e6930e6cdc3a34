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

    /// The same without branches, for loops over pixels.
    float branchless(float s) const {
        const float magnitude = s < 0.0F ? -s : s;
        const float a = magnitude < outer_ ? magnitude : outer_;
        const float rest = outer_ - a;
        const float flat = a / large_;
        const float sloping = 0.5F - 0.5F * rest * rest / (small_ * large_);
        const float beyond_half = a <= inner_ ? flat : sloping;
        return s >= 0.0F ? 0.5F + beyond_half : 0.5F - beyond_half;
    }

    /// Mean share where the edge is blurred: a ramp `width` wide about s = 0, as the penumbra of an even
    /// lamp; the exact share for width 0.
    float ramp(float s, float width) const {
        const float half = 0.5F * width;
        if (std::abs(s) >= outer_ + half) return s >= 0.0F ? 1.0F : 0.0F;
        // A difference of nearly equal numbers would be noise; so narrow a ramp is an edge.
        if (half <= 0.005F * outer_) return (*this)(s);
        return (integral(s + half) - integral(s - half)) / width;
    }

    /// Largest |s| at which the edge still crosses the pixel.
    float reach() const { return outer_; }

  private:
    /// Of the share, from −∞ to s.
    float integral(float s) const {
        const float a = std::abs(s);
        if (a >= outer_) return std::max(s, 0.0F);
        float even;  // what it is above s/2
        if (a <= inner_) {
            even = 0.5F * (inner_ + (a * a - inner_ * inner_ + small_ * small_ / 3.0F) / large_);
        } else {
            const float rest = outer_ - a;
            even = 0.5F * a + rest * rest * rest / (6.0F * small_ * large_);
        }
        return 0.5F * s + even;
    }

    float outer_;
    float inner_;
    float small_;
    float large_;
};

/// Share covered by a strip between two parallel edges, from the shares inside each.
inline float strip_coverage(float inside_one, float inside_other) {
    return std::max(0.0F, inside_one + inside_other - 1.0F);
}

/// A pixel on the ground: its centre and how far the pixels to the right and below are [m].
struct Footprint {
    float x, y, xu, yu, xv, yv;
};

}  // namespace goalmouth
