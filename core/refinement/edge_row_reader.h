#pragma once

#include "core/geometry/camera.h"
#include "core/imaging/yuyv.h"
#include "core/refinement/crossing_curve.h"
#include "core/refinement/edge_rows.h"
#include "core/refinement/post_colour.h"
#include "core/refinement/post_silhouette.h"
#include "core/refinement/row_pixels.h"

#include <array>
#include <vector>

#include <Eigen/Core>

namespace goalmouth {

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
              const RowLayout& layout, double blur, double least_contrast, std::array<EdgeRows, 2>& rows);

    /// What lies beyond the windows of rows as read last (EdgeRows::far_inner, far_outer), where they count.
    void read_far(YuyvView image, const PostColour& colour, const RowLayout& layout,
                  std::array<EdgeRows, 2>& rows) const;

  private:
    /// Where the edge of each row is (EdgeRows::column and the ray there).
    void place(const Intrinsics& camera, const Eigen::Vector3d& plane, const RowLayout& layout, double x_near,
               EdgeRows& rows);
    void read_side(YuyvView image, const PostColour& colour, const RowLayout& layout, double blur,
                   std::size_t side, std::array<EdgeRows, 2>& rows);
    Eigen::Matrix3f background_noise(std::size_t side, const EdgeRows& rows, const Eigen::Matrix3f& like);

    struct Difference {
        Eigen::Vector3f colour;
        float size;
    };
    /// Pairs of a row that lie well outside the edge, numbered from the picture's first.
    struct Outside {
        int window_first = 0, first = 0, last = -1;
    };
    /// Pairs of a row from the picture's `first` on; none: it is not seen.
    struct Window {
        int first = 0, pairs = 0;
    };
    /// The pairs of a block's windows, one before and one behind, from the picture into raw_.
    void copy(YuyvView image, const RowLayout& layout, std::size_t first_row,
              const std::array<Window, EdgeRows::block>& windows);

    CrossingCurve curve_;
    RawPairs raw_;
    using Words = std::array<std::uint8_t, 4 * RawPairs::room>;
    std::array<Words, EdgeRows::block> apart_{};  // of rows at the picture's border
    RowColumn<float> start_;
    std::array<BackgroundSums, 2> sums_;
    std::array<std::array<RowColumn<float>, 3>, 2> backgrounds_;
    std::array<std::vector<Outside>, 2> outside_;
    std::array<RowWeights, 2> weights_;
    std::vector<Difference> differences_;
    std::vector<float> sizes_;
};

}  // namespace goalmouth
