#pragma once

#include "core/detection/upright_view.h"

#include <vector>

namespace goalmouth {

/// Azimuth at slope 0 that many edge points have in common, for one roll.
struct AzimuthPeak {
    double azimuth = 0.0;  // rad, the mean of theirs
    int points = 0;        // within the window
    int near = 0;          // within twice the tolerance of it
};

/// Where edge points pile up when each votes for azimuth − roll·slope: within windows of ± `tolerance` [rad],
/// those with most points first, none nearer to a better one than a window's width. At most `most`, each of
/// `least` points.
class AzimuthVotes {
  public:
    void find(const std::vector<UprightPoint>& points, double roll, double tolerance, int least,
              std::size_t most, std::vector<AzimuthPeak>& peaks);

  private:
    struct Window {
        int points;
        std::size_t first;
    };
    std::vector<double> places_;
    std::vector<Window> windows_;
};

}  // namespace goalmouth
