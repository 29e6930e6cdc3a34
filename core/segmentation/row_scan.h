#pragma once

#include "core/imaging/yuyv.h"
#include "core/segmentation/pixel_labels.h"
#include "core/segmentation/segments.h"

#include <cstdint>
#include <vector>

namespace goalmouth {

/// Cuts rows of a frame into segments: labels the whole row, then compares the labels with themselves one
/// pixel on, so that only changes cost more than that. Keeps its memory from row to row.
class RowScan {
  public:
    /// Appends row y's line and segments.
    void scan(const LabelTable& table, YuyvView image, int y, Segments& out);

  private:
    std::vector<std::uint8_t> labels_;
    std::vector<std::int32_t> starts_;
    std::vector<float> transitions_;
};

}  // namespace goalmouth
