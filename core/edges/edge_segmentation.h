#pragma once

#include "core/edges/camera_over_ground.h"
#include "core/edges/chroma_row.h"
#include "core/edges/edge_chains.h"
#include "core/edges/edge_parameters.h"
#include "core/edges/field_colour.h"
#include "core/edges/frame_edges.h"
#include "core/edges/ground.h"
#include "core/edges/row_edges.h"
#include "core/edges/row_stretch.h"
#include "core/edges/segment_writer.h"
#include "core/edges/strip_seeds.h"
#include "core/edges/upright_strip.h"
#include "core/imaging/yuyv.h"
#include "core/segmentation/scan_lines.h"
#include "core/segmentation/segments.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace goalmouth {

/// What became of a strip, for people who look.
struct JudgedStrip {
    UprightStrip strip;
    std::string refused;  // "": taken as a post
};

/// Segments without a colour table: the paper's candidate points "may come from any source", and here they
/// come from gradients.
///
///   1. Survey. A few rows give the frame's noise, and with it what counts as an edge, and the field's
///      colour: a weak prior, learnt from this frame alone (field_colour.h). A noisy frame is blurred along
///      its columns before anything else looks at it: posts are upright.
///   2. Edges. On each horizontal scan-line, where luma and colour differences change (row_edges.h); on the
///      crossings with vertical ones, where the field is (ground.h).
///   3. Strips. Edges followed from row to row (edge_chains.h), paired by opposite polarity and one surface
///      between them (strip_seeds.h), followed up and down (strip_growth.h), judged (post_rules.h).
///
/// What lies between the edges of a strip that passes is Colour::goal on each row that shows an edge of it,
/// with transitions to a fraction of a pixel; an edge that the row does not show lies on its line through the
/// others. The field is Colour::field to a sample's accuracy, where it begins in a column to a pixel's; all
/// else is unclassified. Rows first, then columns, in the layout's order, which has to be ascending; lines
/// outside the picture are left out. Pixels on scan-lines are looked at, and where a column meets the field's
/// border a few between them; of a noisy frame, all.
class EdgeSegmenter {
  public:
    explicit EdgeSegmenter(const EdgeSegmentationParameters& parameters);

    /// `view`: where the camera's pose is known, else null. Valid until the next call.
    const Segments& segment(YuyvView image, const ScanLayout& layout, const CameraOverGround* view = nullptr);

    /// Of the latest frame.
    const std::optional<FieldColour>& field() const { return field_; }
    const EdgeThreshold& threshold() const { return threshold_; }
    const FrameEdges& edges() const { return frame_; }
    const std::vector<JudgedStrip>& strips() const { return strips_; }

  private:
    double survey(YuyvView image);  // samples, threshold; the frame's median step [grey levels]
    void find_edges(YuyvView image);
    void find_posts(YuyvView image, const CameraOverGround* view);

    EdgeSegmentationParameters parameters_;
    FieldColourFinder field_finder_;
    ChainFinder left_finder_, right_finder_;
    StripSeedFinder seed_finder_;
    Ground ground_;
    ChromaRow row_;
    RowStretch stretch_;
    std::vector<float> sampled_steps_;
    std::array<YuyvImage, 2> blurred_;  // a noisy picture, once and twice
    std::vector<FieldSample> samples_;
    std::vector<int> columns_;  // px

    EdgeThreshold threshold_;
    std::optional<FieldColour> field_;
    FrameEdges frame_;
    std::vector<JudgedStrip> strips_;

    std::vector<GoalRun> runs_;  // by row, from left to right
    SegmentWriter writer_;
    Segments segments_;
};

}  // namespace goalmouth
