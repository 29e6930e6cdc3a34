#include "core/refinement/edge_rows.h"

#include <algorithm>

namespace goalmouth {

void EdgeRows::assign(std::size_t rows) {
    count = rows;
    pixels.resize(blocks());
    for (RowColumn<float>* numbers : {&pairs,
                                      &other_edge,
                                      &background[0],
                                      &background[1],
                                      &background[2],
                                      &inner,
                                      &outer,
                                      &inner_variance,
                                      &outer_variance,
                                      &far_inner,
                                      &far_outer,
                                      &far_inner_pairs,
                                      &far_outer_pairs,
                                      &far_inner_weight,
                                      &far_outer_weight,
                                      &stray,
                                      &dark,
                                      &clean,
                                      &weight,
                                      &outvoted,
                                      &turn})
        numbers->assign(rows);
    for (RowColumn<double>* numbers : {&first, &column, &row, &ray_x, &ray_y, &slope_x, &slope_y, &edge})
        numbers->assign(rows);
    measured.assign(rows);
}

RowLayout layout_rows(int first_row, int last_row, int most_rows) {
    RowLayout layout;
    layout.first_row = first_row;
    layout.last_row = last_row;
    const int rows = std::max(0, last_row - first_row + 1);
    layout.bin = std::clamp((rows + most_rows - 1) / most_rows, 1, RowLayout::most_averaged);
    layout.count = std::min(rows / layout.bin, most_rows);
    const int span = rows - layout.bin;
    layout.pitch =
        layout.count > 1 ? std::max<double>(layout.bin, static_cast<double>(span) / (layout.count - 1)) : 1.0;
    return layout;
}

}  // namespace goalmouth
