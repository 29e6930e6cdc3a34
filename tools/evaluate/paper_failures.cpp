#include "tools/evaluate/paper_failures.h"

#include "core/evaluation/cell_renderer.h"
#include "core/imaging/conversion.h"
#include "tools/evaluate/scored_overlay.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace goalmouth {
namespace {

constexpr std::size_t of_each_kind = 2;
constexpr int widest_picture = 960;  // px

/// "distance 4.97 m short", "distance 31 cm long".
std::string error_text(double error_m) {
    const double size = std::abs(error_m);
    const char* way = error_m < 0.0 ? "short" : "long";
    if (size < 0.005) return "distance right";
    return size < 0.995 ? fmt::format("distance {:.0f} cm {}", 100.0 * size, way)
                        : fmt::format("distance {:.2f} m {}", size, way);
}

/// How bad a frame is in one respect; 0: not at all.
double badness(WorstFrame::Kind kind, const FrameRecord& frame, const DetectorRecord& record) {
    switch (kind) {
        case WorstFrame::Kind::distance:
            return std::abs(record.in_line.distance_error.value_or(0.0));
        case WorstFrame::Kind::missed:
            return (record.posts - record.detected) / evaluation_cell(frame.place.cell).distance();
        case WorstFrame::Kind::false_posts:
            return record.false_posts;
    }
    return 0.0;
}

}  // namespace

std::vector<WorstFrame> worst_frames(const PaperResult& result, std::size_t detector, std::size_t scene) {
    std::vector<WorstFrame> chosen;
    for (const WorstFrame::Kind kind :
         {WorstFrame::Kind::distance, WorstFrame::Kind::missed, WorstFrame::Kind::false_posts}) {
        std::vector<std::pair<double, std::size_t>> bad;
        for (std::size_t i = 0; i < result.records.size(); ++i) {
            const FrameRecord& frame = result.records[i];
            if (static_cast<std::size_t>(frame.place.scene) != scene) continue;
            const double value = badness(kind, frame, frame.detectors[detector]);
            const bool taken = std::any_of(chosen.begin(), chosen.end(),
                                           [&](const WorstFrame& each) { return each.record == i; });
            if (value > 0.0 && !taken) bad.emplace_back(value, i);
        }
        std::stable_sort(bad.begin(), bad.end(),
                         [](const auto& a, const auto& b) { return a.first > b.first; });
        for (std::size_t i = 0; i < std::min(of_each_kind, bad.size()); ++i)
            chosen.push_back({bad[i].second, kind, i});
    }
    return chosen;
}

std::string failure_caption(const FrameRecord& frame, const DetectorRecord& record,
                            const WorstFrame& chosen) {
    const EvaluationCell cell = evaluation_cell(frame.place.cell);
    std::string text = fmt::format("{} cm, {}°: {} of {} found", cell.distance_cm, cell.tilt_deg,
                                   record.detected, record.posts);
    if (record.false_posts > 0) text += fmt::format(", {} false", record.false_posts);
    if (record.in_line.distance_error) text += ", " + error_text(*record.in_line.distance_error);
    if (record.detected == record.posts && record.false_posts == 0)
        text = (chosen.rank == 0 ? "Largest distance error: " : "Second largest distance error: ") + text;
    return text;
}

std::vector<PagePicture> failure_pictures(const PaperResult& result, const PaperSetup& setup,
                                          std::size_t detector, std::size_t scene) {
    const PaperGrid& grid = setup.grid;
    const std::vector<WorstFrame> frames = worst_frames(result, detector, scene);
    if (frames.empty()) return {};
    CellRenderer renderer(grid.scenes[scene], grid.field, grid.camera, grid.seed);
    const DetectPosts detect = setup.detectors[detector].make();
    std::vector<PagePicture> pictures;
    for (const WorstFrame& chosen : frames) {
        const FrameRecord& frame = result.records[chosen.record];
        const CellFrame drawn = renderer.render(frame.place.cell, frame.place.index);
        const std::vector<Post> posts =
            detect(input_of(drawn, frame_number(frame.place.cell, frame.place.index)));
        const std::vector<ReferencePost> truth = drawn.outlines();
        cv::Mat picture = bgr_from_yuyv(drawn.image.view());
        draw_scored_posts(picture, truth, posts, match_posts(truth, posts, grid.rule));
        std::string caption = failure_caption(frame, frame.detectors[detector], chosen);
        if (drawn.view.occluder) caption += ", robot in front";
        PagePicture& shown =
            pictures.emplace_back(page_picture(picture, caption, PictureFormat::jpeg, widest_picture));
        shown.hint = fmt::format("frame {} of cell {}", frame.place.index, frame.place.cell);
    }
    return pictures;
}

}  // namespace goalmouth
