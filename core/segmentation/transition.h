#pragma once

#include "core/imaging/yuyv.h"
#include "core/segmentation/segments.h"

namespace goalmouth {

/// How many pixels on each side of a class change take part in locating it.
struct TransitionWindow {
    int before = 3;  // px, ≥ 1
    int after = 3;   // px, ≥ 1
};

/// Where along a scan-line the colour changes, to a fraction of a pixel.
///
/// The class changes between pixels boundary − 1 and boundary, which lies up to a pixel or two off the edge:
/// a table cuts a blurred edge wherever the mixed colours happen to fall into another class. So the window's
/// end colours a and b are taken as the two sides, every pixel between is projected on b − a in (Y, Cb, Cr)
/// as a share of "already b", clamped to 0…1, and the shares are summed: the edge is where a step would have
/// the same sum. For a symmetric blur this is unbiased wherever the class happened to change.
///
/// In a 4:2:2 row two pixels share their chroma, which alone leaves an edge ambiguous by a pair. Chroma that
/// is the mean of its pair keeps the sum over whole pairs, so along a row the window is widened to whole
/// pairs; luma, in full resolution, counts with the weight its contrast has in b − a.
///
/// Returns px along the line; 2 px at most from boundary − 0.5. `line` is the row's y or the column's x; 1 ≤
/// boundary < line's length.
float locate_transition(YuyvView image, Orientation orientation, int line, int boundary,
                        TransitionWindow window = {});

}  // namespace goalmouth
