#pragma once

#include "core/imaging/colour.h"
#include "core/imaging/shrink.h"
#include "core/imaging/yuyv.h"

#include <cstdint>

#include <opencv2/core.hpp>

namespace goalmouth {

/// Pictures are labelled shrunk to this width or less [px]; posts 6 m away still are 9 px wide there.
inline constexpr int widest_labelled = 640;

/// A picture as it was taken, whose labels (CV_8UC1) are those of the shrunk one: what a table will see has
/// more noise than means of it.
struct Lesson {
    YuyvView picture;
    cv::Mat labels;

    /// Calls visit(Ycbcr, class number) for each pixel of the picture that teaches something.
    template <class Visit>
    void each(Visit visit) const {
        const int factor = shrink_factor(picture, widest_labelled);
        for (int y = 0; y < labels.rows * factor; ++y) {
            const std::uint8_t* row = labels.ptr<std::uint8_t>(y / factor);
            for (int x = 0; x < labels.cols * factor; ++x)
                if (const std::uint8_t label = row[x / factor]; label < colour_count)
                    visit(picture.at(x, y), label);
        }
    }
};

}  // namespace goalmouth
