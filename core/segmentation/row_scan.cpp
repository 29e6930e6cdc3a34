#include "core/segmentation/row_scan.h"

#include "core/segmentation/label_changes.h"
#include "core/segmentation/transitions.h"

namespace goalmouth {

void RowScan::scan(const LabelTable& table, YuyvView image, int y, Segments& out) {
    const auto width = static_cast<std::size_t>(image.width);
    const std::size_t before = label_margin;  // the label left of the first pixel, at a vector's border
    if (labels_.size() < before + width + 2 * label_margin) {
        labels_.resize(before + width + 2 * label_margin);
        starts_.resize(width + 1 + transition_margin);
        transitions_.resize(width + transition_margin);
    }
    std::uint8_t* const labels = labels_.data() + before;
    label_row(table, image.row(y), (width + 1) / 2, labels);
    labels[-1] = labels[0];
    starts_[0] = 0;
    const std::size_t count = 1 + find_changes(labels, labels - 1, width, starts_.data() + 1);
    starts_[count] = image.width;
    locate_row_transitions(image.row(y), image.width, count, starts_.data(), transitions_.data());

    const std::size_t first = out.segments.size();
    out.segments.resize(first + count);
    for (std::size_t i = 0; i < count; ++i) {
        out.segments[first + i] = {static_cast<std::int16_t>(starts_[i]),
                                   static_cast<std::int16_t>(starts_[i + 1] - 1),
                                   static_cast<Colour>(labels[starts_[i]]), transitions_[i]};
    }
    out.lines.push_back({Orientation::horizontal, y, static_cast<int>(first), static_cast<int>(count)});
}

}  // namespace goalmouth
