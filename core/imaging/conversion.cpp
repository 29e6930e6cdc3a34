#include "core/imaging/conversion.h"

#include <stdexcept>

#include <opencv2/imgproc.hpp>

namespace goalmouth {

namespace {

cv::Vec3b convert_one(const cv::Vec3b& pixel, int code) {
    const cv::Mat in(1, 1, CV_8UC3, cv::Scalar(pixel[0], pixel[1], pixel[2]));
    cv::Mat out;
    cv::cvtColor(in, out, code);
    return out.at<cv::Vec3b>(0, 0);
}

std::uint8_t mean(std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>((a + b + 1) / 2);
}

}  // namespace

Ycbcr ycbcr_from_bgr(const cv::Vec3b& bgr) {
    const cv::Vec3b ycrcb = convert_one(bgr, cv::COLOR_BGR2YCrCb);
    return {ycrcb[0], ycrcb[2], ycrcb[1]};
}

cv::Vec3b bgr_from_ycbcr(Ycbcr colour) {
    return convert_one({colour.y, colour.cr, colour.cb}, cv::COLOR_YCrCb2BGR);
}

void yuyv_from_bgr(const cv::Mat& bgr, std::span<std::uint8_t> to) {
    if (bgr.empty()) return;
    if (bgr.type() != CV_8UC3) throw std::invalid_argument("yuyv_from_bgr wants three channels of 8 bits");
    if (to.size() != static_cast<std::size_t>(yuyv_row_bytes(bgr.cols)) * static_cast<std::size_t>(bgr.rows))
        throw std::invalid_argument("yuyv_from_bgr into memory of another size");
    cv::Mat ycrcb;
    cv::cvtColor(bgr, ycrcb, cv::COLOR_BGR2YCrCb);
    std::uint8_t* out = to.data();
    for (int y = 0; y < bgr.rows; ++y) {
        const auto* in = ycrcb.ptr<cv::Vec3b>(y);
        for (int x = 0; x < bgr.cols; x += 2, out += 4) {
            const cv::Vec3b& first = in[x];
            const cv::Vec3b& second = x + 1 < bgr.cols ? in[x + 1] : first;
            out[0] = first[0];
            out[1] = mean(first[2], second[2]);
            out[2] = second[0];
            out[3] = mean(first[1], second[1]);
        }
    }
}

YuyvImage yuyv_from_bgr(const cv::Mat& bgr) {
    if (bgr.empty()) return {};
    YuyvImage image(bgr.cols, bgr.rows);
    yuyv_from_bgr(bgr, image.data);
    return image;
}

cv::Mat bgr_from_yuyv(YuyvView image) {
    if (image.empty()) return {};
    cv::Mat ycrcb(image.height, image.width, CV_8UC3);
    for (int y = 0; y < image.height; ++y) {
        const std::uint8_t* in = image.row(y);
        auto* out = ycrcb.ptr<cv::Vec3b>(y);
        for (int x = 0; x < image.width; ++x) {
            const std::uint8_t* pair = in + 4 * (x / 2);
            out[x] = {pair[2 * (x & 1)], pair[3], pair[1]};
        }
    }
    cv::Mat bgr;
    cv::cvtColor(ycrcb, bgr, cv::COLOR_YCrCb2BGR);
    return bgr;
}

}  // namespace goalmouth
