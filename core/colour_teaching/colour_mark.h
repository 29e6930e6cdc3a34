#pragma once

#include "core/imaging/colour.h"
#include "core/imaging/yuyv.h"

#include <cstddef>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <opencv2/core.hpp>

// What a person says of a picture: these pixels show that class. All coordinates in px, (0,0) the picture's
// top-left pixel.
namespace goalmouth {

struct MarkedBox {
    cv::Rect box;
    bool operator==(const MarkedBox&) const = default;
};

/// Everything inside and on its outline. Where the outline crosses itself, what it goes around twice is
/// outside.
struct MarkedPolygon {
    std::vector<cv::Point> corners;  // 3 to 1000
    bool operator==(const MarkedPolygon&) const = default;
};

/// What is joined to the seed, side by side, by pixels whose Cb and Cr are within `tolerance` of the seed's
/// and whose Y is within three times as much: shade changes luma more than chroma.
struct MarkedFill {
    cv::Point seed;
    int tolerance = 0;  // levels
    bool operator==(const MarkedFill&) const = default;
};

inline constexpr int largest_tolerance = 100;  // levels

using MarkShape = std::variant<MarkedBox, MarkedPolygon, MarkedFill>;

struct ColourMark {
    std::size_t picture = 0;  // its number in the list the marks belong to
    Colour colour = Colour::unclassified;
    MarkShape shape;
    bool operator==(const ColourMark&) const = default;
};

/// Why a picture of that size cannot have this shape, to stand after "the picture's name: "; "" where it can.
std::string shape_problem(const MarkShape& shape, cv::Size picture);

/// The pixels of a shape.
struct MarkedPixels {
    cv::Rect where;  // the smallest that holds them all
    cv::Mat mask;    // CV_8UC1 of that size: 255 marked, 0 not
    bool holds(cv::Point p) const { return where.contains(p) && mask.at<std::uint8_t>(p - where.tl()) != 0; }
};

/// Throws std::invalid_argument with shape_problem() where there is one.
MarkedPixels marked_pixels(const MarkShape& shape, YuyvView picture);

/// A colour, and how many pixels show it.
struct CountedColour {
    Ycbcr colour;
    std::size_t pixels = 0;
};

/// The colours of those pixels, each once.
std::vector<CountedColour> colours_of(const MarkedPixels& pixels, YuyvView picture);

/// How many pixels they come from.
std::size_t pixels_of(std::span<const CountedColour> colours);

}  // namespace goalmouth
