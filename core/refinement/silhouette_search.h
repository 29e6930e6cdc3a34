#pragma once

#include "core/field/field.h"
#include "core/geometry/camera.h"
#include "core/imaging/yuyv.h"
#include "core/refinement/coarse_edges.h"
#include "core/refinement/edge_rivals.h"
#include "core/refinement/edge_rows.h"
#include "core/refinement/measured_vertical.h"
#include "core/refinement/post_colour.h"
#include "core/refinement/post_extent.h"
#include "core/refinement/refinement_parameters.h"
#include "core/refinement/silhouette_fit.h"

#include <array>
#include <string>
#include <vector>

namespace goalmouth {

/// What is known of a post whose silhouette is looked for.
struct SilhouetteTask {
    const Intrinsics& camera;
    const MeasuredVertical& vertical;
    const RoughOutline& outline;
    const PostColour& colour;
    bool cut = false;  // by the picture's border
};

struct FoundSilhouette {
    std::string problem;  // why there is none
    CoarseEdgeFinder::Edges edges;
    SilhouettePrior prior;
    PostExtent extent;
    RowLayout layout;
    SilhouetteFit fit;
    std::array<RivalVerdict, 2> rivals;
};

/// Finds the silhouette of a post from its coarse edges: fits it (silhouette_fit.h) and asks whether rows
/// that show an edge elsewhere are right (edge_rivals.h); if so, fits it there without the rows that are not.
class SilhouetteSearch {
  public:
    SilhouetteSearch(const RefinementParameters& parameters, const Field& field)
        : parameters_(parameters), field_(field) {}

    /// `use`: which of the edges to use, one at least.
    FoundSilhouette find(YuyvView image, const SilhouetteTask& task, const CoarseEdgeFinder::Edges& edges,
                         const std::array<bool, 2>& use);

  private:
    using LeftOut = std::array<std::vector<int>, 2>;
    /// One fit, from `found.edges`.
    void attempt(YuyvView image, const SilhouetteTask& task, const std::array<bool, 2>& use,
                 const LeftOut& left_out, FoundSilhouette& found);

    RefinementParameters parameters_;
    Field field_;
    SilhouetteFitter fitter_;
};

}  // namespace goalmouth
