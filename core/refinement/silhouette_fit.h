#pragma once

#include "core/refinement/edge_consensus.h"
#include "core/refinement/edge_row_reader.h"
#include "core/refinement/edge_rows.h"
#include "core/refinement/post_silhouette.h"
#include "core/refinement/row_gate.h"
#include "core/refinement/row_measurement.h"
#include "core/refinement/row_scatter.h"
#include "core/refinement/step_equations.h"
#include "core/refinement/step_profile.h"

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// What is known about a silhouette without looking at its edges.
struct SilhouettePrior {
    Eigen::Vector3d up = -Eigen::Vector3d::UnitY();  // frame C, along the post's axis
    double lean_sigma = 0.02;                        // rad, of `up` within the post's middle plane
    double roll_sigma = 0.3;  // rad, of `up` about the line of sight; what a rolling shutter adds included
    double half_angle = 0.0;
    double half_angle_sigma = 0.0;  // rad; 0: not known
};

struct SilhouetteFit {
    PostSilhouette post;
    Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();  // of a SilhouetteStep
    double blur = 0.0;                                     // px, σ along the rows
    double digital = 0.5;                                  // share of it that pixels underwent (StepProfile)
    std::array<double, 2> noise = {1.0, 1.0};              // variance of the values on either side
    int iterations = 0;
    bool converged = false;
    RowScatter scatter;
    EdgeConsensus::Result consensus;
};

/// Fits the two planes of a silhouette to rows of pixels.
///
/// Gauss–Newton on the four parts of a SilhouetteStep: measure_rows() gives for each row of each edge an
/// offset t and its information I, all pixel-level unknowns eliminated, so that
///     H = Σ ω I J Jᵀ + P,  J = d(crossing) / d(step) = −(ray·dn/dstep) / (n·ray'),
/// is the information of the full fit over all pixels. The prior P holds lean and roll to the measured
/// vertical, whose roll the picture tells far better wherever rows agree; beyond three sigmas neither goes. ω
/// gates rows (RowGate, and EdgeConsensus where they disagree). Blur and noise are fitted along with it,
/// pooled over the rows that count.
///
/// On the way each row's levels have its neighbours' as prior, which its own offset needs to be judged by; an
/// error of theirs is one that rows share, and the sum of their information more than they know. The last
/// step is without that prior, and has pixels farther from the edge tell the levels as well (far_levels.h).
///
/// The covariance is H⁻¹ with the rows' information scaled to the scatter they show, and by how much
/// neighbouring rows' offsets resemble each other (compressed pictures).
class SilhouetteFitter {
  public:
    /// `edges`: which of them to use; `left_out`: the picture's rows (ascending) in which either is not to
    /// be.
    SilhouetteFit fit(YuyvView image, const Intrinsics& camera, const PostColour& colour,
                      const PostSilhouette& start, const SilhouettePrior& prior, const RowLayout& layout,
                      const std::array<bool, 2>& edges, const std::array<std::vector<int>, 2>& left_out,
                      double least_contrast);

  private:
    struct Task {
        YuyvView image;
        const Intrinsics& camera;
        const PostColour& colour;
        const SilhouettePrior& prior;
        const std::array<std::vector<int>, 2>& left_out;
        double least_contrast;
    };
    /// Until rows ask for no more; false where there is no such silhouette.
    bool settle(const Task& task, RowLayout& layout, SilhouetteFit& state);
    /// The last step.
    bool finish(const Task& task, const RowLayout& layout, SilhouetteFit& state);
    struct Stepped {
        SilhouetteStep step, pull;
    };
    /// Gauss–Newton; nothing where there is no such silhouette.
    std::optional<Stepped> step_once(const Task& task, SilhouetteFit& state);
    /// Whether rows' edges, or their blur, no longer lie well within the pixels that were read.
    bool left_windows(const RowLayout& layout, const SilhouetteFit& state);
    void read(const Task& task, RowLayout& layout, const SilhouetteFit& state);
    /// Where each row's edge is supposed to be, and measures it there.
    void measure(const SilhouetteFit& state, bool blur);
    void smooth(const SilhouetteFit& state);
    /// Measures rows whose edge lies apart from the common one where it lies.
    void measure_apart(const SilhouetteFit& state, std::size_t side);
    /// What a roll does to the rows' edges (EdgeRows::turn).
    void turns(const SilhouetteFit& state);
    void fit_blur(SilhouetteFit& state) const;
    void set_covariance(const SilhouettePrior& prior, SilhouetteFit& state) const;

    std::array<bool, 2> edges_{};
    std::array<EdgeRows, 2> rows_;
    std::array<Eigen::Vector3d, 2> planes_;
    std::array<SupposedEdges, 2> supposed_;
    std::array<BlurRows, 2> blur_;
    EdgeRowReader reader_;
    StepProfile profile_;
    RowGate gate_;
    EdgeConsensus consensus_;
    StepEquations equations_, prior_;  // of the last step
    // Of measure_apart:
    SupposedEdges apart_edges_;
    RowMeasurements apart_rows_;
    RowColumn<float> shift_;
    std::vector<bool> apart_blocks_;
};

}  // namespace goalmouth
