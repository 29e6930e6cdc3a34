#include "tools/evaluate/paper_failures.h"

#include "core/evaluation/cell_renderer.h"
#include "core/imaging/conversion.h"
#include "tools/evaluate/scored_overlay.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <string>

namespace goalmouth {
namespace {

constexpr std::size_t of_each_kind = 2;

std::string caption_of(const FrameRecord& frame, const DetectorRecord& record, const CellFrame& drawn) {
    const EvaluationCell cell = evaluation_cell(frame.place.cell);
    std::string text =
        fmt::format("{} cm, {}°, frame {}: {} of {} posts found, {} false", cell.distance_cm, cell.tilt_deg,
                    frame.place.index, record.detected, record.posts, record.false_posts);
    if (record.in_line.distance_error)
        text +=
            fmt::format(", post in line estimated {:+.0f} cm off", 100.0 * *record.in_line.distance_error);
    if (drawn.view.occluder) text += ", robot in front";
    return text;
}

}  // namespace

std::vector<std::size_t> worst_frames(const PaperResult& result, std::size_t detector, std::size_t scene) {
    std::vector<std::size_t> chosen;
    const auto take = [&](const std::function<double(const FrameRecord&, const DetectorRecord&)>& badness) {
        std::vector<std::pair<double, std::size_t>> bad;
        for (std::size_t i = 0; i < result.records.size(); ++i) {
            const FrameRecord& frame = result.records[i];
            if (static_cast<std::size_t>(frame.place.scene) != scene) continue;
            const double value = badness(frame, frame.detectors[detector]);
            if (value > 0.0 && std::find(chosen.begin(), chosen.end(), i) == chosen.end())
                bad.emplace_back(value, i);
        }
        std::stable_sort(bad.begin(), bad.end(),
                         [](const auto& a, const auto& b) { return a.first > b.first; });
        for (std::size_t i = 0; i < std::min(of_each_kind, bad.size()); ++i) chosen.push_back(bad[i].second);
    };
    take([](const FrameRecord&, const DetectorRecord& r) {
        return std::abs(r.in_line.distance_error.value_or(0.0));
    });
    take([](const FrameRecord& frame, const DetectorRecord& r) {
        return (r.posts - r.detected) / evaluation_cell(frame.place.cell).distance();
    });
    take([](const FrameRecord&, const DetectorRecord& r) { return static_cast<double>(r.false_posts); });
    return chosen;
}

std::vector<PagePicture> failure_pictures(const PaperResult& result, const PaperSetup& setup,
                                          std::size_t detector, std::size_t scene) {
    const PaperGrid& grid = setup.grid;
    const std::vector<std::size_t> frames = worst_frames(result, detector, scene);
    if (frames.empty()) return {};
    CellRenderer renderer(grid.scenes[scene], grid.field, grid.camera, grid.seed);
    const DetectPosts detect = setup.detectors[detector].make();
    std::vector<PagePicture> pictures;
    for (const std::size_t i : frames) {
        const FrameRecord& frame = result.records[i];
        const CellFrame drawn = renderer.render(frame.place.cell, frame.place.index);
        const std::vector<Post> posts =
            detect(drawn.image.view(), frame_number(frame.place.cell, frame.place.index), drawn.view.told);
        const std::vector<ReferencePost> truth = drawn.outlines();
        cv::Mat picture = bgr_from_yuyv(drawn.image.view());
        draw_scored_posts(picture, truth, posts, match_posts(truth, posts, grid.rule));
        pictures.push_back(page_picture(picture, caption_of(frame, frame.detectors[detector], drawn),
                                        PictureFormat::jpeg, 640));
    }
    return pictures;
}

}  // namespace goalmouth
