#pragma once

#include "core/edges/appearance.h"

#include <optional>
#include <vector>

namespace goalmouth {

/// Chromaticity: the colour differences over luma. Light falls out of it, so sun and shade on one surface
/// share it, as all exposures do. A few grey levels are added to the luma, so that noise in the dark does not
/// count.
struct Chromaticity {
    float u = 0.F;  // of Cb
    float v = 0.F;  // of Cr
};
inline Chromaticity chromaticity(const Appearance& a) {
    constexpr float dark = 16.F;  // grey levels
    return {a.cb / (a.y + dark), a.cr / (a.y + dark)};
}

/// The field's colour in one frame, found in the frame itself.
class FieldColour {
  public:
    bool contains(const Appearance& a) const {
        if (a.y < darkest_ || a.y > brightest_) return false;
        const Chromaticity c = chromaticity(a);
        const float du = c.u - u_;
        const float dv = c.v - v_;
        return a_ * du * du + 2.F * b_ * du * dv + c_ * dv * dv < 1.F;
    }
    float luma() const { return luma_; }  // grey levels, median

  private:
    friend class FieldColourFinder;
    float u_ = 0.F, v_ = 0.F;
    float a_ = 0.F, b_ = 0.F, c_ = 0.F;  // of the ellipse that holds it
    float darkest_ = 0.F, brightest_ = 0.F;
    float luma_ = 0.F;
};

/// A pixel looked at, and how far down the picture it stands.
struct FieldSample {
    Appearance appearance;
    float down = 0.F;  // 0 the picture's top, 1 its lower end
};

/// Finds the field's colour: the largest cluster of chromaticities that lies low in the picture and is on the
/// green side of neutral, Cr < 128, whatever the light; a weak prior, which no table is needed for.
///
/// The largest bin of a histogram over (u, v), lower samples counting more, gives the cluster's middle; mean,
/// covariance and range of luma follow from the samples about it. Nothing where the cluster holds fewer than
/// `least_share` of the samples.
class FieldColourFinder {
  public:
    std::optional<FieldColour> find(const std::vector<FieldSample>& samples, float least_share);

  private:
    std::vector<float> histogram_;
    std::vector<float> lumas_;
};

}  // namespace goalmouth
