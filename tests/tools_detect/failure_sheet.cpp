#include "tests/tools_detect/failure_sheet.h"

#include "core/imaging/conversion.h"
#include "tools/goalmouth/overlay.h"

#include <algorithm>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace goalmouth::test {
namespace {

constexpr int tile_width = 640;  // px
constexpr int tile_height = 480;
constexpr int caption_height = 24;
constexpr int columns = 3;
const cv::Scalar green(0, 220, 0);
const cv::Scalar white(255, 255, 255);

void draw_edge(cv::Mat& picture, const Eigen::Vector2d& top, const Eigen::Vector2d& base) {
    cv::line(picture, cv::Point2d(top.x(), top.y()), cv::Point2d(base.x(), base.y()), green,
             std::max(1, picture.cols / tile_width), cv::LINE_AA);
}

}  // namespace

void FailureSheet::add(const AnnotatedImage& annotated, YuyvView image, const ImageResult& result,
                       const Score& score) {
    if (score.missed + score.wrong == 0) return;
    cv::Mat picture = bgr_from_yuyv(image);
    draw_border(picture, result.border);
    draw_posts(picture, result.posts);
    draw_candidates(picture, result.candidates);
    for (const AnnotatedPost& post : annotated.posts) {
        draw_edge(picture, post.left_top, post.left_base);
        draw_edge(picture, post.right_top, post.right_base);
    }
    cv::Mat tile(tile_height + caption_height, tile_width, CV_8UC3, cv::Scalar(0, 0, 0));
    cv::Mat inner = tile(cv::Rect(0, 0, tile_width, tile_height));
    cv::resize(picture, inner, inner.size(), 0, 0, cv::INTER_AREA);
    const std::string name = std::filesystem::path(annotated.file).stem().string();
    cv::putText(tile,
                name + ": " + std::to_string(score.found) + " found, " + std::to_string(score.missed) +
                    " missed, " + std::to_string(score.wrong) + " wrong",
                {6, tile_height + 17}, cv::FONT_HERSHEY_SIMPLEX, 0.45, white, 1, cv::LINE_AA);
    tiles_.push_back({score.missed + score.wrong, tile});
}

void FailureSheet::write(const std::filesystem::path& file) const {
    if (tiles_.empty()) return;
    std::vector<Tile> sorted = tiles_;
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const Tile& a, const Tile& b) { return a.mistakes > b.mistakes; });
    const int count = static_cast<int>(sorted.size());
    const int rows = (count + columns - 1) / columns;
    cv::Mat sheet(rows * (tile_height + caption_height), std::min(count, columns) * tile_width, CV_8UC3,
                  cv::Scalar(40, 40, 40));
    for (int i = 0; i < count; ++i) {
        const cv::Mat& tile = sorted[static_cast<std::size_t>(i)].picture;
        tile.copyTo(
            sheet(cv::Rect((i % columns) * tile.cols, (i / columns) * tile.rows, tile.cols, tile.rows)));
    }
    std::filesystem::create_directories(file.parent_path());
    cv::imwrite(file.string(), sheet);
}

}  // namespace goalmouth::test
