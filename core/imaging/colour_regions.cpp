#include "core/imaging/colour_regions.h"

#include "core/imaging/colour_rules.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <opencv2/imgproc.hpp>

namespace goalmouth {

namespace {

constexpr double region_threshold = 0.02;  // of the mode's frequency
constexpr double least_of_shade = 0.05;    // of all samples
constexpr double same_hue = 14.0;          // [deg]
constexpr double least_hued = 10.0;        // levels of chroma: nearer to grey a cell's middle tells no hue
constexpr double least_of_mode = 0.5;      // a rival's distance from grey in the mode's hue, of the mode's

/// Of the cell and its eight neighbours the highest.
cv::Point uphill(const cv::Mat& heights, cv::Point cell) {
    const cv::Rect near = cv::Rect(cell.x - 1, cell.y - 1, 3, 3) & cv::Rect(0, 0, heights.cols, heights.rows);
    cv::Point highest = cell;
    for (int y = near.y; y < near.br().y; ++y)
        for (int x = near.x; x < near.br().x; ++x)
            if (heights.at<float>(y, x) > heights.at<float>(highest)) highest = {x, y};
    return highest;
}

cv::Point peak_above(const cv::Mat& heights, cv::Point cell) {
    for (cv::Point next = uphill(heights, cell); next != cell; next = uphill(heights, cell)) cell = next;
    return cell;
}

double centre_of_cell(int index) {
    return index * 4.0 + 2.0;
}

/// Of the chroma in a cell's middle.
ChromaPolar polar_of(cv::Point cell) {
    return chroma_polar(128.0, centre_of_cell(cell.y) - 128.0, centre_of_cell(cell.x) - 128.0);
}

/// The cells that reach 2 % of the highest, joined where they touch.
struct JoinedCells {
    explicit JoinedCells(const cv::Mat& heights) {
        double peak = 0.0;
        cv::minMaxLoc(heights, nullptr, &peak, nullptr, &mode);
        const cv::Mat above = heights >= peak * region_threshold;
        count = cv::connectedComponents(above, components, 8, CV_32S);
    }
    ChromaRegion around_mode() const {
        ChromaRegion region;
        region.cells = components == components.at<int>(mode);
        region.cr = centre_of_cell(mode.x);
        region.cb = centre_of_cell(mode.y);
        return region;
    }

    cv::Mat components;  // CV_32S, 0 outside
    int count = 0;       // with the outside
    cv::Point mode;
};

}  // namespace

cv::Mat ChromaHistogram::smoothed() const {
    cv::Mat smooth;
    cv::GaussianBlur(cells_, smooth, {0, 0}, 1.0);
    return smooth;
}

cv::Point2d ChromaHistogram::highest_near(double cb, double cr) const {
    constexpr int reach = 2;  // cells
    const cv::Mat smooth = smoothed();
    const cv::Rect near = cv::Rect(static_cast<int>(cr / 4.0) - reach, static_cast<int>(cb / 4.0) - reach,
                                   2 * reach + 1, 2 * reach + 1) &
                          cv::Rect(0, 0, smooth.cols, smooth.rows);
    cv::Point highest;
    cv::minMaxLoc(smooth(near), nullptr, nullptr, nullptr, &highest);
    highest += near.tl();
    return {centre_of_cell(highest.y), centre_of_cell(highest.x)};
}

ChromaRegion ChromaHistogram::region_around_mode() const {
    return JoinedCells(smoothed()).around_mode();
}

ChromaRegion ChromaHistogram::shades_of_mode() const {
    const cv::Mat smooth = smoothed();
    const JoinedCells joined(smooth);
    ChromaRegion region = joined.around_mode();
    const ChromaPolar mode = polar_of(joined.mode);
    if (mode.chroma < least_hued) return region;
    const double all = cv::sum(cells_)[0];
    for (int i = 1; i < joined.count; ++i) {
        const cv::Mat own = joined.components == i;
        cv::Mat samples = cv::Mat::zeros(cells_.size(), cells_.type());
        cells_.copyTo(samples, own);
        if (cv::sum(samples)[0] < least_of_shade * all) continue;
        cv::Point highest;
        cv::minMaxLoc(smooth, nullptr, nullptr, nullptr, &highest, own);
        const ChromaPolar peak = polar_of(highest);
        if (peak.chroma >= least_hued && std::abs(std::remainder(peak.hue - mode.hue, 360.0)) <= same_hue)
            region.cells.setTo(255, own);
    }
    return region;
}

ChromaRegion ChromaHistogram::without_rivals(const ChromaRegion& region) const {
    const cv::Mat smooth = smoothed();
    const double cb = region.cb - 128.0, cr = region.cr - 128.0;
    const double least = least_of_mode * (cb * cb + cr * cr);
    ChromaRegion cut = region;
    cut.cells = region.cells.clone();
    for (int y = 0; y < cut.cells.rows; ++y) {
        for (int x = 0; x < cut.cells.cols; ++x) {
            if (!cut.cells.at<std::uint8_t>(y, x)) continue;
            const cv::Point peak = peak_above(smooth, {x, y});
            const double along =
                cb * (centre_of_cell(peak.y) - 128.0) + cr * (centre_of_cell(peak.x) - 128.0);
            if (along < least) cut.cells.at<std::uint8_t>(y, x) = 0;
        }
    }
    return cut;
}

double image_scale(int width) {
    return std::max(width / 640.0, 0.25);
}

int odd(double value) {
    return 2 * static_cast<int>(value / 2.0) + 1;
}

cv::Mat disc(double radius) {
    const int size = odd(2.0 * radius + 1.0);
    return cv::getStructuringElement(cv::MORPH_ELLIPSE, {size, size});
}

cv::Mat luma_of(YuyvView image) {
    cv::Mat luma(image.height, image.width, CV_8UC1);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) luma.at<std::uint8_t>(y, x) = image.at(x, y).y;
    return luma;
}

int Blobs::area(int i) const {
    return stats.at<int>(i, cv::CC_STAT_AREA);
}

cv::Rect Blobs::box(int i) const {
    return {stats.at<int>(i, cv::CC_STAT_LEFT), stats.at<int>(i, cv::CC_STAT_TOP),
            stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT)};
}

Blobs blobs_of(const cv::Mat& mask) {
    Blobs blobs;
    cv::Mat centres;
    blobs.count = cv::connectedComponentsWithStats(mask, blobs.labels, blobs.stats, centres, 8, CV_32S);
    return blobs;
}

cv::Mat pitch_mask(const cv::Mat& field_coloured, double scale) {
    cv::Mat joined;
    cv::morphologyEx(field_coloured, joined, cv::MORPH_OPEN, disc(1.5 * scale));
    cv::morphologyEx(joined, joined, cv::MORPH_CLOSE, disc(6.0 * scale));
    const Blobs blobs = blobs_of(joined);
    cv::Mat pitch = cv::Mat::zeros(joined.size(), CV_8UC1);
    int largest = 0;
    for (int i = 1; i < blobs.count; ++i)
        if (largest == 0 || blobs.area(i) > blobs.area(largest)) largest = i;
    const int least = pitch.rows * pitch.cols / 50;
    if (largest == 0 || blobs.area(largest) < least) return pitch;
    std::vector<bool> is_pitch(static_cast<std::size_t>(blobs.count), false);
    for (int i = 1; i < blobs.count; ++i)
        is_pitch[static_cast<std::size_t>(i)] =
            i == largest || (blobs.area(i) >= least && 4 * blobs.box(i).br().y >= 3 * pitch.rows);
    for (int x = 0; x < pitch.cols; ++x) {
        int y = 0;
        while (y < pitch.rows && !is_pitch[static_cast<std::size_t>(blobs.labels.at<int>(y, x))]) ++y;
        for (; y < pitch.rows; ++y) pitch.at<std::uint8_t>(y, x) = 255;
    }
    return pitch;
}

cv::Mat field_luma_around(const cv::Mat& luma, const cv::Mat& field_coloured, double scale) {
    cv::Mat weight, weighted;
    field_coloured.convertTo(weight, CV_32F, 1.0 / 255.0);
    luma.convertTo(weighted, CV_32F);
    weighted = weighted.mul(weight);
    const cv::Size window(odd(60.0 * scale), odd(60.0 * scale));
    cv::boxFilter(weight, weight, CV_32F, window);
    cv::boxFilter(weighted, weighted, CV_32F, window);
    weight = cv::max(weight, 1e-6);
    return weighted / weight;
}

cv::Mat brighter_than_field(YuyvView image, const cv::Mat& field_coloured) {
    cv::Mat luma = luma_of(image);
    const cv::Mat field_luma = field_luma_around(luma, field_coloured, image_scale(image.width));
    luma.convertTo(luma, CV_32F);
    return (luma >= 1.2 * field_luma) & (luma >= field_luma + 8.0) & (field_luma > 0.0);
}

cv::Mat ball_sized(const cv::Mat& mask, double scale) {
    const Blobs blobs = blobs_of(mask);
    cv::Mat kept = cv::Mat::zeros(mask.size(), CV_8UC1);
    for (int i = 1; i < blobs.count; ++i) {
        const cv::Rect box = blobs.box(i);
        if (blobs.area(i) < 30.0 * scale * scale || blobs.area(i) > 0.05 * mask.rows * mask.cols) continue;
        if (std::max(box.width, box.height) > 2.5 * std::min(box.width, box.height)) continue;
        kept.setTo(255, blobs.labels == i);
    }
    return kept;
}

}  // namespace goalmouth
