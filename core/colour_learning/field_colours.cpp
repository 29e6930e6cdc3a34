#include "core/colour_learning/field_colours.h"

#include "core/imaging/colour_rules.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace goalmouth {

namespace {

constexpr double greenish_from = 170.8;    // [deg] where green outweighs red …
constexpr double greenish_to = 288.7;      // … and blue
constexpr double neutral_chroma = 6.0;     // levels; noise alone reaches as far from grey
constexpr double least_green = 0.05;       // of a picture's lower half
constexpr double line_slenderness = 4.0;   // length over mean thickness; a disc has 1.3, a square 1
constexpr double widest_line = 48.0;       // px at 640 px width: wider is paper, a robot, a wall
constexpr int fewest_line_pixels = 200;    // in all pictures
constexpr double salient_chroma = 25.0;    // levels; a ball's colour is farther from grey
constexpr double ball_fill = 0.6;          // of its box; a disc fills 0.785
constexpr double ball_aspect = 1.7;        // blur and clipping stretch it
constexpr double ball_surroundings = 0.6;  // of the ring around it that is carpet or line
constexpr double same_colour = 0.5;        // of a blob's pixels
constexpr int fewest_ball_pictures = 2;

bool is_green(Ycbcr p) {
    const ChromaPolar polar = chroma_polar(p);
    return polar.hue >= greenish_from && polar.hue <= greenish_to && polar.chroma >= neutral_chroma;
}

/// Well inside the pitch, and the carpet there.
struct Ground {
    cv::Mat like_field;
    cv::Mat inside;
};

Ground ground_of(const YuyvImage& picture, const ChromaRegion& field) {
    const double scale = image_scale(picture.width);
    Ground ground;
    ground.like_field = mask_of(picture.view(), [&](Ycbcr p) { return field.holds(p); });
    const cv::Mat pitch = pitch_mask(ground.like_field, scale);
    cv::erode(pitch, ground.inside, disc(3.0 * scale), {-1, -1}, 1, cv::BORDER_REPLICATE);
    return ground;
}

bool slender(const Blobs& blobs, int i) {
    const cv::Rect box = blobs.box(i);
    const double length = std::hypot(box.width, box.height);
    return length * length >= line_slenderness * blobs.area(i);
}

cv::Mat thin_and_bright(const YuyvImage& picture, const Ground& ground) {
    const double scale = image_scale(picture.width);
    cv::Mat bright = brighter_than_field(picture.view(), ground.like_field) & ground.inside;
    cv::Mat wide;
    cv::morphologyEx(bright, wide, cv::MORPH_OPEN, disc(0.5 * widest_line * scale));
    bright.setTo(0, wide);
    const Blobs blobs = blobs_of(bright);
    cv::Mat lines = cv::Mat::zeros(bright.size(), CV_8UC1);
    for (int i = 1; i < blobs.count; ++i)
        if (blobs.area(i) >= 20.0 * scale * scale && slender(blobs, i))
            lines(blobs.box(i)).setTo(255, blobs.labels(blobs.box(i)) == i);
    return lines;
}

/// Whether most of the ring around blob `i` is ground.
bool lies_on(const cv::Mat& ground, const Blobs& blobs, int i, double scale) {
    const int ring = std::max(2, static_cast<int>(4.0 * scale));
    const cv::Rect whole(0, 0, ground.cols, ground.rows);
    cv::Rect box = blobs.box(i);
    box = cv::Rect(box.x - ring, box.y - ring, box.width + 2 * ring, box.height + 2 * ring) & whole;
    const cv::Mat own = blobs.labels(box) == i;
    cv::Mat grown;
    cv::dilate(own, grown, disc(ring));
    const cv::Mat around = grown & ~own;
    const int all = cv::countNonZero(around);
    return all > 0 && cv::countNonZero(ground(box) & around) >= ball_surroundings * all;
}

bool compact(const Blobs& blobs, int i) {
    const cv::Rect box = blobs.box(i);
    const int shorter = std::min(box.width, box.height);
    const int longer = std::max(box.width, box.height);
    return longer <= ball_aspect * shorter && blobs.area(i) >= ball_fill * box.width * box.height;
}

}  // namespace

std::optional<ChromaRegion> find_field_colour(std::span<const YuyvImage> pictures) {
    ChromaHistogram green_ones, lower, all;
    double most = 0.0;
    for (const YuyvImage& picture : pictures) {
        const YuyvView image = picture.view();
        const int rows = image.height - image.height / 2;
        const auto vote = static_cast<float>(1.0 / (static_cast<double>(rows) * image.width));
        double green = 0.0;
        for (int y = 0; y < image.height; ++y) {
            const bool in_lower = y >= image.height / 2;
            for (int x = 0; x < image.width; ++x) {
                const Ycbcr p = image.at(x, y);
                all.add(p, vote);
                if (!in_lower) continue;
                lower.add(p, vote);
                if (!is_green(p)) continue;
                green_ones.add(p, vote);
                green += static_cast<double>(vote);
            }
        }
        most = std::max(most, green);
    }
    if (most < least_green) return std::nullopt;
    const ChromaRegion region = green_ones.region_around_mode();
    // Noise makes grey walls a little green, too: they have their peak at grey.
    const cv::Point2d peak = lower.highest_near(region.cb, region.cr);
    if (!is_green({128, static_cast<std::uint8_t>(peak.x), static_cast<std::uint8_t>(peak.y)}))
        return std::nullopt;
    return all.without_rivals(region);
}

std::optional<ChromaRegion> find_line_colour(std::span<const YuyvImage> pictures, const ChromaRegion& field) {
    ChromaHistogram histogram;
    int pixels = 0;
    for (const YuyvImage& picture : pictures) {
        const cv::Mat lines = thin_and_bright(picture, ground_of(picture, field));
        pixels += cv::countNonZero(lines);
        for (int y = 0; y < lines.rows; ++y)
            for (int x = 0; x < lines.cols; ++x)
                if (lines.at<std::uint8_t>(y, x)) histogram.add(picture.view().at(x, y));
    }
    if (pixels < fewest_line_pixels) return std::nullopt;
    return histogram.region_around_mode();
}

std::optional<ChromaRegion> find_ball_colour(std::span<const YuyvImage> pictures, const ChromaRegion& field,
                                             const std::optional<ChromaRegion>& line,
                                             const ChromaRegion& goal) {
    std::vector<std::vector<std::vector<Ycbcr>>> blobs_seen;  // by picture, by blob
    ChromaHistogram histogram;
    for (const YuyvImage& picture : pictures) {
        const double scale = image_scale(picture.width);
        const Ground ground = ground_of(picture, field);
        const cv::Mat other = mask_of(picture.view(), [&](Ycbcr p) {
            return !field.holds(p) && !goal.holds(p) && !(line && line->holds(p)) &&
                   chroma_polar(p).chroma >= salient_chroma;
        });
        cv::Mat on_ground = ground.like_field.clone();
        if (line) on_ground |= brighter_than_field(picture.view(), ground.like_field) & ground.inside;
        const Blobs blobs = blobs_of(ball_sized(other & ground.inside, scale));
        blobs_seen.emplace_back();
        for (int i = 1; i < blobs.count; ++i) {
            if (!compact(blobs, i) || !lies_on(on_ground, blobs, i, scale)) continue;
            std::vector<Ycbcr> pixels;
            const cv::Rect box = blobs.box(i);
            for (int y = box.y; y < box.y + box.height; ++y)
                for (int x = box.x; x < box.x + box.width; ++x)
                    if (blobs.labels.at<int>(y, x) == i) pixels.push_back(picture.view().at(x, y));
            for (const Ycbcr p : pixels) histogram.add(p, 1.0F / static_cast<float>(pixels.size()));
            blobs_seen.back().push_back(std::move(pixels));
        }
    }
    if (histogram.empty()) return std::nullopt;
    const ChromaRegion region = histogram.region_around_mode();
    const auto of_this_colour = [&](const std::vector<Ycbcr>& pixels) {
        const auto inside =
            std::count_if(pixels.begin(), pixels.end(), [&](Ycbcr p) { return region.holds(p); });
        return static_cast<double>(inside) >= same_colour * static_cast<double>(pixels.size());
    };
    const auto with_ball = std::count_if(blobs_seen.begin(), blobs_seen.end(), [&](const auto& blobs) {
        return std::any_of(blobs.begin(), blobs.end(), of_this_colour);
    });
    if (with_ball < fewest_ball_pictures) return std::nullopt;
    return region;
}

}  // namespace goalmouth
