#include "core/colour_teaching/colour_mark.h"

#include <algorithm>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

namespace goalmouth {

namespace {

constexpr int luma_factor = 3;  // of a fill's tolerance
constexpr std::size_t most_corners = 1000;

std::string size_text(cv::Size size) {
    return std::to_string(size.width) + "x" + std::to_string(size.height);
}

struct Problem {
    cv::Size picture;

    bool outside(cv::Point p) const { return !cv::Rect({0, 0}, picture).contains(p); }
    std::string reaches_beyond(const char* what) const {
        return std::string("the ") + what + " reaches beyond the picture, which is " + size_text(picture);
    }

    std::string operator()(const MarkedBox& box) const {
        if (box.box.empty()) return "the box is empty";
        return outside(box.box.tl()) || outside(box.box.br() - cv::Point(1, 1)) ? reaches_beyond("box") : "";
    }
    std::string operator()(const MarkedPolygon& polygon) const {
        if (polygon.corners.size() < 3) return "a polygon has at least three corners";
        if (polygon.corners.size() > most_corners)
            return "a polygon has at most " + std::to_string(most_corners) + " corners";
        const bool beyond = std::any_of(polygon.corners.begin(), polygon.corners.end(),
                                        [&](cv::Point p) { return outside(p); });
        return beyond ? reaches_beyond("polygon") : "";
    }
    std::string operator()(const MarkedFill& fill) const {
        if (fill.tolerance < 0 || fill.tolerance > largest_tolerance)
            return "a tolerance is 0…" + std::to_string(largest_tolerance);
        return outside(fill.seed) ? reaches_beyond("fill's seed") : "";
    }
};

cv::Mat ycbcr_planes(YuyvView picture) {
    cv::Mat planes(picture.height, picture.width, CV_8UC3);
    for (int y = 0; y < picture.height; ++y) {
        auto* row = planes.ptr<cv::Vec3b>(y);
        for (int x = 0; x < picture.width; ++x) {
            const Ycbcr p = picture.at(x, y);
            row[x] = {p.y, p.cb, p.cr};
        }
    }
    return planes;
}

struct Pixels {
    YuyvView picture;

    MarkedPixels operator()(const MarkedBox& box) const {
        return {box.box, cv::Mat(box.box.size(), CV_8UC1, cv::Scalar(255))};
    }
    MarkedPixels operator()(const MarkedPolygon& polygon) const {
        const cv::Rect where = cv::boundingRect(polygon.corners);
        cv::Mat mask = cv::Mat::zeros(where.size(), CV_8UC1);
        cv::fillPoly(mask, std::vector<std::vector<cv::Point>>{polygon.corners}, cv::Scalar(255), cv::LINE_8,
                     0, -where.tl());
        return {where, mask};
    }
    MarkedPixels operator()(const MarkedFill& fill) const {
        cv::Mat planes = ycbcr_planes(picture);
        cv::Mat mask = cv::Mat::zeros(planes.rows + 2, planes.cols + 2, CV_8UC1);
        const double t = fill.tolerance;
        const cv::Scalar reach(luma_factor * t, t, t);
        cv::Rect where;
        cv::floodFill(planes, mask, fill.seed, {}, &where, reach, reach,
                      4 | (255 << 8) | cv::FLOODFILL_FIXED_RANGE | cv::FLOODFILL_MASK_ONLY);
        return {where, mask(where + cv::Point(1, 1)).clone()};
    }
};

}  // namespace

std::string shape_problem(const MarkShape& shape, cv::Size picture) {
    return std::visit(Problem{picture}, shape);
}

MarkedPixels marked_pixels(const MarkShape& shape, YuyvView picture) {
    const std::string problem = shape_problem(shape, {picture.width, picture.height});
    if (!problem.empty()) throw std::invalid_argument(problem);
    return std::visit(Pixels{picture}, shape);
}

std::vector<CountedColour> colours_of(const MarkedPixels& pixels, YuyvView picture) {
    std::vector<std::uint32_t> all;  // Y, Cb and Cr as one number
    for (int y = 0; y < pixels.mask.rows; ++y) {
        const std::uint8_t* row = pixels.mask.ptr<std::uint8_t>(y);
        for (int x = 0; x < pixels.mask.cols; ++x) {
            if (row[x] == 0) continue;
            const Ycbcr p = picture.at(pixels.where.x + x, pixels.where.y + y);
            all.push_back((std::uint32_t{p.y} << 16) | (std::uint32_t{p.cb} << 8) | p.cr);
        }
    }
    std::sort(all.begin(), all.end());
    std::vector<CountedColour> colours;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (i == 0 || all[i] != all[i - 1])
            colours.push_back({{static_cast<std::uint8_t>(all[i] >> 16),
                                static_cast<std::uint8_t>(all[i] >> 8), static_cast<std::uint8_t>(all[i])},
                               0});
        ++colours.back().pixels;
    }
    return colours;
}

std::size_t pixels_of(std::span<const CountedColour> colours) {
    std::size_t pixels = 0;
    for (const CountedColour& c : colours) pixels += c.pixels;
    return pixels;
}

}  // namespace goalmouth
