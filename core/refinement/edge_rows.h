#pragma once

#include "core/imaging/yuyv.h"
#include "core/refinement/pixel_rays.h"
#include "core/refinement/post_colour.h"
#include "core/refinement/post_silhouette.h"
#include "core/refinement/step_profile.h"

#include <array>
#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// px, sigma of edges as cameras show them, from row to row, beside what noise explains.
inline constexpr double edge_roughness = 0.02;

/// How bright one side of an edge is in a row, from the rows about it.
struct EdgeLevel {
    float value = 0.0F;
    float variance = 0.0F;  // of the level in this row, were its own pixels not known
};

/// The same from the row's own pixels well away from the edge.
struct OwnLevel {
    float value = 0.0F;
    float weight = 0.0F;  // pixels it is the mean of
};

/// The pixels of one row (or a few neighbouring ones, averaged) about one edge, made one number each: how far
/// from the post's colour towards the background's, shading left out, in sigmas of the noise.
struct EdgeRow {
    static constexpr int most_pairs = 20;

    bool seen = false;  // enough pixels inside the picture, and the background differs
    float row = 0.0F;   // px
    int pairs = 0;
    float first = 0.0F;  // px, middle of the first pair; the next ones come 2 px further each
    std::array<float, most_pairs> values{};
    std::array<float, most_pairs> strays{};  // the same square to it: 0 with post and background alike
    std::array<float, most_pairs> lumas{};
    RowRay ray;               // where the edge was when the row was read
    float other_edge = 0.0F;  // what lies beyond the other edge, on the same scale

    EdgeLevel inner, outer;  // levels inside and outside

    std::array<float, 3> background{};  // what lies outside, less the post's colour

    float edge = 0.0F;  // px, where it was supposed last

    // As measured last:
    OwnLevel own_inner, own_outer;
    float offset = 0.0F;       // px, outwards from where the edge was supposed
    float information = 0.0F;  // 1/px², one over the offset's variance
    float misfit = 0.0F;       // mean square of what the edge model leaves, for each degree of freedom
    float freedom = 0.0F;      // degrees of freedom of misfit
    float weight = 0.0F;       // 0…1, of the row in the fit
    float stray = 0.0F;        // as misfit, of the strays
    bool outvoted = false;     // EdgeConsensus: another place of the edge has more evidence
    float dark = 0.0F;         // px inside the edge that are black, in all, or as good as
    float clean = 1.0F;        // 0…1, how far its pixels are those of one step
    float turn = 0.0F;         // px outwards for each rad of roll (SilhouetteStep)
};

/// How rows of a picture are gathered.
struct RowLayout {
    int first_row = 0;
    int last_row = 0;
    int bin = 1;         // neighbouring rows averaged
    double pitch = 1.0;  // px from one bin to the next
    int count = 0;       // bins
    double inner = 4.0;  // px to look inside an edge
    double outer = 6.0;  // and outside

    double row(int i) const { return first_row + 0.5 * (bin - 1) + i * pitch; }
};

/// Rows for at most `most_rows` measurements of each edge between two rows. More rows than that are averaged
/// in pairs, which keeps their information; of still more, some are left out.
RowLayout layout_rows(int first_row, int last_row, int most_rows);

/// Reads the rows about both edges of a post.
///
/// The background's colour is looked up on each side in the neighbouring rows as well, so that the weights w
/// = M·e hardly depend on a single row's noise; e: background less post. M is that of the mean of the post's
/// noise and the background's on this side, which is what an edge's pixels have, texture included. A pair of
/// pixels of colour z becomes w·(z − post) / √(eᵀMe): 0 with post, √(eᵀMe) with background, noise about 1.
/// What is square both to w and to the shade direction, in the noise's metric, says whether there is only
/// post and background: every mixture of the two has 0 there, and a third thing's colour has not.
class EdgeRowReader {
  public:
    void read(YuyvView image, const Intrinsics& camera, const PostSilhouette& post, const PostColour& colour,
              const RowLayout& layout, double blur, double least_contrast,
              std::array<std::vector<EdgeRow>, 2>& rows);

  private:
    struct Window {
        int first = 0;  // pair
        int pairs = 0;
        int outside_first = 0, outside_last = -1;             // of these, well outside the edge
        std::array<PairColour, EdgeRow::most_pairs> colours;  // less the post's
        Eigen::Vector3f background = Eigen::Vector3f::Zero();
        float background_pairs = 0.0F;
    };
    struct Difference {
        Eigen::Vector3f colour;
        float size;
    };
    Eigen::Matrix3f background_noise(std::size_t side, const Eigen::Matrix3f& like);
    void read_window(YuyvView image, const RowLayout& layout, int top, double edge, double outwards,
                     double inner, double blur, const PostColour& colour, Window& window) const;

    std::array<std::vector<Window>, 2> windows_;
    std::array<std::vector<Eigen::Vector3f>, 2> backgrounds_;
    std::vector<Difference> differences_;
};

}  // namespace goalmouth
