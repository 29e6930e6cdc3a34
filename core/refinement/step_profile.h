#pragma once

#include <algorithm>
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
///
/// Kept as some thirty polynomials: cubics that have E and its slope at both their ends, within 2e-4 of it.
/// (E_d has bends at whole px, where pieces end; with the widest blurs, of which pieces are longer, it has
/// none to speak of.)
class StepProfile {
  public:
    struct Value {
        float step;     // E
        float slope;    // dE/dx, per px
        float blur;     // dE/dσ, per px
        float digital;  // E_d − E_o
    };

    /// Polynomials of pieces, x [px] from a piece's start on: a table over all pieces for each factor. E has
    /// the first four, from the lowest power on, dE/dσ two and E_d − E_o two.
    static constexpr std::size_t most_pieces = 32, blur_factors = 4, digital_factors = 6;
    using Tables = std::array<std::array<float, most_pieces>, 8>;

    /// σ [px] > 0, along the row; digital share 0…1.
    void set_blur(double sigma, double digital_share);
    /// Beyond this many px from the edge E is 0 or 1.
    float reach() const { return reach_; }

    /// The piece that x [px] lies in is number ⌊(x + reach())·per_px()⌋ + 1; what lies beyond both ends has
    /// the first and the last.
    const Tables& tables() const { return tables_; }
    std::size_t count() const { return count_; }
    float per_px() const { return per_px_; }

    Value at(float x) const {
        const float place = std::min(static_cast<float>(count_) - 0.5F,
                                     std::max(0.0F, (x + reach_) * per_px_ + 1.0F));  // NaN: 0
        const auto i = static_cast<std::size_t>(place);
        const float way = (place - static_cast<float>(i)) / per_px_;
        const auto factor = [&](std::size_t k) { return tables_[k][i]; };
        const float c1 = factor(1), c2 = factor(2), c3 = factor(3);
        return {factor(0) + way * (c1 + way * (c2 + way * c3)), c1 + way * (2.0F * c2 + way * (3.0F * c3)),
                factor(blur_factors) + way * factor(blur_factors + 1),
                factor(digital_factors) + way * factor(digital_factors + 1)};
    }

  private:
    double sigma_ = 0.0;
    double digital_ = 0.0;
    float reach_ = 0.0F;
    float per_px_ = 1.0F;
    std::size_t count_ = 1;
    alignas(64) Tables tables_{};
};

}  // namespace goalmouth
