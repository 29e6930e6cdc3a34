#include "core/segmentation/segmentation.h"

#include <algorithm>

namespace goalmouth {
namespace {

/// Rows that are dealt with together: they stay in the nearest cache, or almost.
constexpr int band = 16;
static_assert(band <= ColumnScan::largest_band);

}  // namespace

Segmenter::Segmenter(const ColourTable& table) : table_(table) {}

const Segments& Segmenter::segment(YuyvView image, const ScanLayout& layout) {
    segments_.clear();
    segments_.width = image.width;
    segments_.height = image.height;
    if (image.empty()) return segments_;

    inside_.clear();
    for (const int x : layout.columns)
        if (x >= 0 && x < image.width) inside_.push_back(x);
    columns_.begin(image, inside_);
    auto next_row = layout.rows.begin();
    for (int y = 0; y < image.height; y += band) {
        const int end = std::min(y + band, image.height);
        columns_.scan(table_, end - y);
        for (; next_row != layout.rows.end() && (*next_row < end || end == image.height); ++next_row)
            if (*next_row >= 0 && *next_row < image.height) rows_.scan(table_, image, *next_row, segments_);
    }
    columns_.append_to(segments_);
    return segments_;
}

Segments segment_frame(YuyvView image, const ColourTable& table, const ScanLayout& layout) {
    return Segmenter(table).segment(image, layout);
}

}  // namespace goalmouth
