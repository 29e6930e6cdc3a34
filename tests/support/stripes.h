#pragma once

#include "core/imaging/conversion.h"
#include "core/imaging/yuyv.h"

#include <opencv2/imgproc.hpp>

/// A picture to teach colours from, 90×60 in three stripes of 30: carpet, a yellow post, a wall.
namespace goalmouth::test {

inline cv::Mat stripes_bgr() {
    cv::Mat picture(60, 90, CV_8UC3, cv::Scalar(60, 120, 50));
    cv::rectangle(picture, {30, 0, 30, 60}, cv::Scalar(34, 184, 226), cv::FILLED);
    cv::rectangle(picture, {60, 0, 30, 60}, cv::Scalar(150, 158, 160), cv::FILLED);
    return picture;
}

inline YuyvImage stripes() {
    return yuyv_from_bgr(stripes_bgr());
}

}  // namespace goalmouth::test
