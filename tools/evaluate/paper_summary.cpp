#include "tools/evaluate/paper_summary.h"

#include "core/evaluation/cell.h"

#include <cmath>

namespace goalmouth {
namespace {

PostSummary summarise_post(const std::vector<const DetectorRecord*>& records,
                           PostRecord DetectorRecord::*which) {
    PostSummary summary;
    std::vector<double> errors;
    std::array<double, 2> edges{};
    double bearings = 0.0;
    for (const DetectorRecord* record : records) {
        const PostRecord& post = record->*which;
        if (!post.counts) continue;
        ++summary.posts;
        if (post.found) ++summary.detected;
        if (post.identified) ++summary.identified;
        if (post.distance_error) errors.push_back(*post.distance_error);
        if (post.edges) {
            edges[0] += (*post.edges)[0];
            edges[1] += (*post.edges)[1];
        }
        if (post.bearing_error) bearings += *post.bearing_error * *post.bearing_error;
    }
    summary.measured = static_cast<int>(errors.size());
    summary.distance = error_statistics(errors);
    if (summary.detected > 0) {
        summary.edges = {edges[0] / summary.detected, edges[1] / summary.detected};
        summary.bearing_rmse = std::sqrt(bearings / summary.detected);
    }
    return summary;
}

}  // namespace

Summary summarise(const std::vector<const DetectorRecord*>& records) {
    Summary summary;
    for (const DetectorRecord* record : records) {
        ++summary.frames;
        summary.posts += record->posts;
        summary.detected += record->detected;
        summary.identified += record->identified;
        summary.false_posts += record->false_posts;
    }
    summary.in_line = summarise_post(records, &DetectorRecord::in_line);
    summary.second = summarise_post(records, &DetectorRecord::second);
    return summary;
}

RecordTable::RecordTable(const std::vector<FrameRecord>& records, std::size_t scenes)
    : cells_(scenes * cell_count) {
    for (const FrameRecord& record : records)
        cells_[static_cast<std::size_t>(record.place.scene * cell_count + record.place.cell)].push_back(
            &record);
}

Summary RecordTable::cell(std::size_t detector, std::size_t scene, int cell) const {
    std::vector<const DetectorRecord*> records;
    for (const FrameRecord* frame : cells_[scene * cell_count + static_cast<std::size_t>(cell)])
        records.push_back(&frame->detectors[detector]);
    return summarise(records);
}

Summary RecordTable::tilt(std::size_t detector, std::size_t scene, std::size_t tilt) const {
    std::vector<const DetectorRecord*> records;
    for (std::size_t i = 0; i < cell_distances_cm.size(); ++i)
        for (const FrameRecord* frame : cells_[scene * cell_count + tilt * cell_distances_cm.size() + i])
            records.push_back(&frame->detectors[detector]);
    return summarise(records);
}

Summary RecordTable::whole(std::size_t detector, std::size_t scene) const {
    std::vector<const DetectorRecord*> records;
    for (std::size_t i = 0; i < cell_count; ++i)
        for (const FrameRecord* frame : cells_[scene * cell_count + i])
            records.push_back(&frame->detectors[detector]);
    return summarise(records);
}

WorstCells worst_cells(const RecordTable& table, std::size_t detector, std::size_t scene,
                       std::optional<std::size_t> tilt) {
    constexpr auto distances = static_cast<int>(cell_distances_cm.size());
    const int first = tilt ? static_cast<int>(*tilt) * distances : 0;
    const int end = tilt ? first + distances : cell_count;
    WorstCells worst;
    double lowest_rate = 0.0;
    double its_rmse = 0.0;
    double largest_rmse = 0.0;
    for (int c = first; c < end; ++c) {
        const Summary cell = table.cell(detector, scene, c);
        if (cell.posts == 0) continue;
        const double rmse = cell.in_line.distance ? cell.in_line.distance->rmse : 0.0;
        const double rate = cell.detection_rate();
        if (!worst.detection || rate < lowest_rate || (rate == lowest_rate && rmse > its_rmse)) {
            worst.detection = c;
            lowest_rate = rate;
            its_rmse = rmse;
        }
        if (cell.in_line.distance && (!worst.distance || rmse > largest_rmse)) {
            worst.distance = c;
            largest_rmse = rmse;
        }
    }
    return worst;
}

}  // namespace goalmouth
