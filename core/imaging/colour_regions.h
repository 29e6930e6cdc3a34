#pragma once

#include "core/imaging/colour.h"
#include "core/imaging/yuyv.h"

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

// What learning colours, with labels and without, asks of pictures: which chroma a surface has, and where the
// pitch is. Masks are CV_8UC1, 255 inside. Lengths are meant for images 640 px wide and scale with
// image_scale().
namespace goalmouth {

/// Region of the chroma plane that a surface of one colour fills, as a map of 64×64 cells, [Cb / 4][Cr / 4].
struct ChromaRegion {
    cv::Mat cells;      // CV_8UC1, 255 inside
    double cb = 128.0;  // its mode
    double cr = 128.0;
    bool holds(Ycbcr p) const { return cells.at<std::uint8_t>(p.cb >> 2, p.cr >> 2) != 0; }
};

/// How often each chroma was seen, whatever the brightness.
class ChromaHistogram {
  public:
    ChromaHistogram() : cells_(cv::Mat::zeros(64, 64, CV_32F)) {}

    void add(Ycbcr p, float weight = 1.0F) { cells_.at<float>(p.cb >> 2, p.cr >> 2) += weight; }
    bool empty() const { return cv::countNonZero(cells_) == 0; }
    /// The cells joined to the mode of the smoothed histogram that reach 2 % of its height. Requires a
    /// sample.
    ChromaRegion region_around_mode() const;
    /// The same and, where it is lit differently elsewhere, the surface there: other joined cells of that
    /// height which hold a twentieth or more of the samples and whose peak has the mode's hue to 14°. None
    /// for a mode nearer to grey than 10 levels. Requires a sample.
    ChromaRegion shades_of_mode() const;
    /// `region` less the cells from which the way uphill in this histogram, of all that the pictures show,
    /// ends at another surface's peak: one not half as far from grey as the region's mode, seen in the mode's
    /// hue. What lies between two colours (blur, noise) joins their regions, a wall's to the carpet's; the
    /// shaded parts of one surface have peaks too, but in its hue.
    ChromaRegion without_rivals(const ChromaRegion& region) const;
    /// (Cb, Cr) of the highest cell of the smoothed histogram within two cells of this chroma.
    cv::Point2d highest_near(double cb, double cr) const;

  private:
    cv::Mat smoothed() const;
    cv::Mat cells_;
};

double image_scale(int width);
/// The odd number of pixels nearest below `value`, at least 1.
int odd(double value);
/// For morphology.
cv::Mat disc(double radius);

cv::Mat luma_of(YuyvView image);

template <class Wanted>
cv::Mat mask_of(YuyvView image, Wanted wanted) {
    cv::Mat mask(image.height, image.width, CV_8UC1);
    for (int y = 0; y < image.height; ++y) {
        std::uint8_t* row = mask.ptr<std::uint8_t>(y);
        for (int x = 0; x < image.width; ++x) row[x] = wanted(image.at(x, y)) ? 255 : 0;
    }
    return mask;
}

/// Everything from the upper rim of the pitch down, column by column. The pitch is the largest field-coloured
/// area, and others that reach into the lowest quarter of the picture (lines cut it apart), each a fiftieth
/// of the picture or more; nothing where there is none.
cv::Mat pitch_mask(const cv::Mat& field_coloured, double scale);

/// Local mean of the luma of field-coloured pixels, CV_32F; 0 where there are none near.
cv::Mat field_luma_around(const cv::Mat& luma, const cv::Mat& field_coloured, double scale);

/// Pixels that paint on the carpet can be: white paint reflects two to four times as much as green carpet,
/// which a camera's gamma of 2.2 turns into 1.3 to 1.9 times the luma. Mask of luma ≥ 1.2 × that of the field
/// around, and 8 levels above it (noise).
cv::Mat brighter_than_field(YuyvView image, const cv::Mat& field_coloured);

/// Connected areas of a mask (8 neighbours).
struct Blobs {
    cv::Mat labels;  // CV_32S, 0 outside
    cv::Mat stats;   // rows of cv::ConnectedComponentsTypes
    int count = 0;   // with the outside
    int area(int i) const;
    cv::Rect box(int i) const;
};
Blobs blobs_of(const cv::Mat& mask);

/// Keeps blobs of `mask` that are neither specks nor too large or too long for a ball.
cv::Mat ball_sized(const cv::Mat& mask, double scale);

}  // namespace goalmouth
