#pragma once

#include "core/localisation/belief.h"
#include "core/localisation/observation.h"

#include <cstddef>

#include <Eigen/Core>

namespace goalmouth {

/// Share of a belief's covariance that one of its `particles` stands for: the square of the bandwidth with
/// which a normal kernel about each particle gives a normal density back with the least mean square error,
///
///     h² = (4 / ((d + 2) N))^(2 / (d + 4)),    d = 3 dimensions (x, y, theta)
///
/// (Silverman, Density Estimation for Statistics and Data Analysis, section 4.3; used for particle filters by
/// Musso, Oudjane and Le Gland, in Sequential Monte Carlo Methods in Practice, 2001).
double kernel_share(std::size_t particles);

/// What the frame says to particles that each stand for their neighbourhood: refined observations get the
/// spread of their expectation over one particle's kernel, `share` times the covariance of (x, y, theta) of
/// the belief about `pose`, added to theirs; those without a distance get its turn alone. Of 400 particles
/// none may lie within the centimetre that two refined posts tell; without this the one that happens to be
/// nearest would take all the weight. The turn of the kernel becomes part of the azimuths' common error.
/// Others are left as they are: their errors are wider than any kernel.
FrameObservation widened(const FrameObservation& frame, const PoseHypothesis& belief, double share);

}  // namespace goalmouth
