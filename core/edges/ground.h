#pragma once

#include "core/edges/field_colour.h"
#include "core/imaging/yuyv.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// Where a frame shows the field: samples on the crossings of horizontal and vertical scan-lines.
///
/// In each column the field begins where the samples from there down hold the most field against what is
/// none: lines, balls and feet in between do not end it, and a few green things behind it do not begin it.
/// Above that nothing counts as field. The border is the upper convex hull of these places.
class Ground {
  public:
    /// `rows` and `columns` [px] ascending, inside the picture; they are to stay until the next frame.
    void begin(YuyvView image, const std::vector<int>& rows, const std::vector<int>& columns);
    /// The next row, from the top.
    void add_row(const FieldColour& field);
    /// After the last row.
    void finish();

    bool empty() const { return hull_.empty(); }
    /// 1 where the field is, else 0, column by column; label_margin further bytes can be read.
    const std::uint8_t* row(std::size_t row) const { return mask_.data() + row * columns_->size(); }
    /// y of the border in column x [px]; beyond the hull's ends that of the nearer end. Requires a field.
    double border_at(double x) const;

  private:
    YuyvView image_;
    const std::vector<int>* rows_ = nullptr;
    const std::vector<int>* columns_ = nullptr;
    std::size_t rows_seen_ = 0;
    std::vector<std::uint8_t> mask_;
    std::vector<std::int32_t> pairs_;  // of the columns
    std::vector<std::int32_t> begins_;
    std::vector<Eigen::Vector2d> points_, hull_;
};

}  // namespace goalmouth
