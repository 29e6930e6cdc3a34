#include "core/refinement/fit_quality.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {

double fit_quality(const SilhouetteFit& fit, const CoarseEdgeFinder::Edges& coarse,
                   const std::array<bool, 2>& edges, int rows, const std::array<RivalVerdict, 2>& rivals) {
    if (!fit.converged) return 0.0;
    double quality = 1.0;
    for (std::size_t side = 0; side < 2; ++side) {
        if (!edges[side]) continue;
        constexpr double usual_share = 0.3, least_share = 0.15, enough = 16.0, rival_harm = 0.8;
        // Half as many rows again that end elsewhere are just too many for least_quality's default.
        constexpr double end_harm = 1.0 / 3.0;
        const double agreeing = fit.scatter.agreeing[side];
        const double looked = std::max(1, fit.scatter.looked_at[side]);
        quality = std::min({quality, agreeing / (usual_share * looked), agreeing / enough,
                            agreeing / (least_share * std::max(1, rows)),
                            1.0 - rival_harm * coarse[side]->rival, 1.0 - end_harm * rivals[side].rival()});
        if (fit.consensus.disagree) {
            // Odds of e² against the next best place are just enough.
            constexpr double sure = 4.0;
            quality = std::min(quality, (fit.consensus.evidence[side] - fit.consensus.rival[side]) / sure);
        }
    }
    if (edges[0] && edges[1]) {
        // Twice as far off as least_quality's default lets pass: sigma of the distance a twentieth of it.
        constexpr double unsure = 0.025;
        using silhouette_part::half_angle;
        const double sigma =
            std::sqrt(fit.covariance(half_angle, half_angle)) / std::tan(fit.post.half_angle);
        quality = std::min(quality, unsure / sigma);
    }
    return std::clamp(quality, 0.0, 1.0);
}

}  // namespace goalmouth
