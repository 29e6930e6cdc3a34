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
inline constexpr float chromaticity_dark = 16.F;  // grey levels
inline Chromaticity chromaticity(const Appearance& a) {
    return {a.cb / (a.y + chromaticity_dark), a.cr / (a.y + chromaticity_dark)};
}

/// The field's colour in one frame, found in the frame itself.
class FieldColour {
  public:
    /// a·du² + b·du·dv + c·dv² < 1 holds for its chromaticities (u + du, v + dv); luma lies in a range.
    struct Ellipse {
        float u = 0.F, v = 0.F;
        float a = 0.F, b = 0.F, c = 0.F;
        float darkest = 0.F, brightest = 0.F;  // grey levels
    };

    bool contains(const Appearance& s) const {
        // Both sides times the luma's square.
        const float luma = s.y + chromaticity_dark;
        const float p = s.cb - e_.u * luma;
        const float q = s.cr - e_.v * luma;
        return e_.a * (p * p) + e_.b * (p * q) + e_.c * (q * q) < luma * luma && s.y >= e_.darkest &&
               s.y <= e_.brightest;
    }
    const Ellipse& ellipse() const { return e_; }
    float luma() const { return luma_; }  // grey levels, median

  private:
    friend class FieldColourFinder;
    Ellipse e_;
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
/// `least_share` of the samples, or is the slope of a peak about grey.
class FieldColourFinder {
  public:
    std::optional<FieldColour> find(const std::vector<FieldSample>& samples, float least_share);

  private:
    struct Greenish {
        Chromaticity chromaticity;
        float down;
    };
    std::vector<Greenish> greenish_;   // samples that may belong to it
    std::vector<float> fields_, all_;  // histograms over (u, v): of these, and of every sample
    std::vector<float> lumas_;
};

}  // namespace goalmouth
