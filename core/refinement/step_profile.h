#pragma once

#include <array>
#include <cstddef>

namespace goalmouth {

/// A blurred edge as pairs of pixels show it: 0 far inside the post, 1 far outside.
///
/// A pixel gathers light over its width of 1 px, and a 4:2:2 sample is the mean of two pixels, so that it
/// gathers over 2 px. Beside that, light or pixels are blurred with σ along the row:
///
/// by the lens, a Gaussian (motion is near enough to it). With Ψ(x) = ∫Φ(x/σ)dx = x·Φ(x/σ) + σ·φ(x/σ) and
/// x [px] from the edge outwards to the middle of the pair
///     E_o(x) = ½ (Ψ(x + 1) − Ψ(x − 1)),  dE_o/dx = ½ (Φ((x+1)/σ) − Φ((x−1)/σ)),
///     dE_o/dσ = ½ (φ((x+1)/σ) − φ((x−1)/σ));
///
/// by what a camera does to its pixels (colour from a mosaic, noise filters, scaling), or a renderer: a
/// Gaussian of weights g_k at whole pixels. With C(x) = ½ (x + 1), within 0 … 1,
///     E_d(x) = Σ g_k C(x + k).
///
/// The two differ by up to a hundredth, which moves an upright edge by as many px, the same in all rows. So
/// the profile is E = E_o + share·(E_d − E_o), and the share is for the picture to say.
/// Kept as a table, read between its places.
class StepProfile {
  public:
    struct Value {
        float step;     // E
        float slope;    // dE/dx, per px
        float blur;     // dE/dσ, per px
        float digital;  // E_d − E_o
    };

    /// σ [px] > 0, along the row; digital share 0…1.
    void set_blur(double sigma, double digital_share);
    /// Beyond this many px from the edge E is 0 or 1.
    float reach() const { return reach_; }

    Value at(float x) const {
        const float place = (x + reach_) * scale_;
        if (!(place > 0.0F)) return {0.0F, 0.0F, 0.0F, 0.0F};
        const auto i = static_cast<std::size_t>(place);
        if (i >= places - 1) return {1.0F, 0.0F, 0.0F, 0.0F};
        const float share = place - static_cast<float>(i);
        const Value& a = table_[i];
        const Value& b = table_[i + 1];
        return {a.step + share * (b.step - a.step), a.slope + share * (b.slope - a.slope),
                a.blur + share * (b.blur - a.blur), a.digital + share * (b.digital - a.digital)};
    }

  private:
    static constexpr std::size_t places = 160;
    double sigma_ = 0.0;
    double digital_ = 0.0;
    float reach_ = 0.0F;
    float scale_ = 0.0F;
    std::array<Value, places> table_{};
};

}  // namespace goalmouth
