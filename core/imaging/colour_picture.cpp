#include "core/imaging/colour_picture.h"

#include "core/imaging/conversion.h"

#include <array>
#include <string>

#include <opencv2/imgproc.hpp>

namespace goalmouth {

namespace {

constexpr int slice_side = 192;  // px
constexpr int margin = 8;        // px
constexpr int caption = 18;      // px
constexpr std::array<int, 8> slice_lumas = {16, 48, 80, 112, 144, 176, 208, 240};

const cv::Scalar ink(230, 230, 230);

void write(cv::Mat& picture, const std::string& text, cv::Point where) {
    cv::putText(picture, text, where, cv::FONT_HERSHEY_SIMPLEX, 0.42, ink, 1, cv::LINE_AA);
}

/// Colours of one slice, each pixel the chroma it stands for; (0, bottom) is Cb = Cr = 0.
cv::Mat chroma_plane(int luma) {
    cv::Mat ycrcb(slice_side, slice_side, CV_8UC3);
    for (int row = 0; row < slice_side; ++row) {
        for (int col = 0; col < slice_side; ++col) {
            ycrcb.at<cv::Vec3b>(row, col) = {
                static_cast<std::uint8_t>(luma),
                static_cast<std::uint8_t>((slice_side - 1 - row) * 256 / slice_side),
                static_cast<std::uint8_t>(col * 256 / slice_side)};
        }
    }
    return ycrcb;
}

}  // namespace

cv::Vec3b display_colour(Colour colour) {
    switch (colour) {
        case Colour::field:
            return {40, 130, 30};
        case Colour::line:
            return {255, 255, 255};
        case Colour::ball:
            return {0, 110, 255};
        case Colour::goal:
            return {0, 230, 255};
        case Colour::robot:
            return {220, 60, 180};
        case Colour::unclassified:
            break;
    }
    return {40, 40, 40};
}

cv::Mat segmentation_picture(YuyvView image, const ColourTable& table) {
    cv::Mat picture(image.height, image.width, CV_8UC3);
    for (int y = 0; y < image.height; ++y) {
        auto* row = picture.ptr<cv::Vec3b>(y);
        for (int x = 0; x < image.width; ++x) row[x] = display_colour(table.at(image.at(x, y)));
    }
    return picture;
}

cv::Mat segmentation_beside_image(YuyvView image, const ColourTable& table) {
    cv::Mat beside;
    cv::hconcat(bgr_from_yuyv(image), segmentation_picture(image, table), beside);
    return beside;
}

cv::Mat table_picture(const ColourTable& table) {
    const int columns = static_cast<int>(slice_lumas.size());
    const int width = margin + columns * (slice_side + margin);
    const int legend = 2 * caption;
    cv::Mat picture(legend + 2 * (slice_side + caption) + 2 * margin, width, CV_8UC3, cv::Scalar(20, 20, 20));
    write(picture,
          table.name() + ", " + std::to_string(table.bits()) + " bits an axis; Cb to the right, Cr upwards",
          {margin, caption - 4});
    const auto counts = class_counts(table);
    int x = margin;
    for (int c = 1; c < colour_count; ++c) {
        const cv::Vec3b colour = display_colour(static_cast<Colour>(c));
        cv::rectangle(picture, cv::Rect(x, caption + 3, 12, 12), cv::Scalar(colour[0], colour[1], colour[2]),
                      cv::FILLED);
        const std::string text = std::string(colour_names[static_cast<std::size_t>(c)]) + " " +
                                 std::to_string(counts[static_cast<std::size_t>(c)]);
        write(picture, text, {x + 18, caption + 14});
        x += 160;
    }
    for (int i = 0; i < columns; ++i) {
        const int luma = slice_lumas[static_cast<std::size_t>(i)];
        const int left = margin + i * (slice_side + margin);
        const cv::Mat plane = chroma_plane(luma);
        cv::Mat own;
        cv::cvtColor(plane, own, cv::COLOR_YCrCb2BGR);
        cv::Mat classes(slice_side, slice_side, CV_8UC3);
        for (int row = 0; row < slice_side; ++row) {
            for (int col = 0; col < slice_side; ++col) {
                const auto& p = plane.at<cv::Vec3b>(row, col);
                const Colour colour = table.at({p[0], p[2], p[1]});
                classes.at<cv::Vec3b>(row, col) = display_colour(colour);
                if (colour == Colour::unclassified) own.at<cv::Vec3b>(row, col) /= 4;
            }
        }
        own.copyTo(picture(cv::Rect(left, legend, slice_side, slice_side)));
        classes.copyTo(picture(cv::Rect(left, legend + slice_side + margin, slice_side, slice_side)));
        write(picture, std::string("Y ").append(std::to_string(luma)),
              {left, legend + 2 * slice_side + margin + caption - 4});
    }
    return picture;
}

}  // namespace goalmouth
