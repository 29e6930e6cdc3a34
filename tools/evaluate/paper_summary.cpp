#include "tools/evaluate/paper_summary.h"

#include "core/evaluation/cell.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {
namespace {

PostSummary summarise_post(const std::vector<const DetectorRecord*>& records,
                           PostRecord DetectorRecord::*which, bool only_good) {
    PostSummary summary;
    std::vector<double> errors;
    std::vector<double> all_errors;
    std::vector<double> bounds;
    double squared_bounds = 0.0;
    double normalised = 0.0;
    int good = 0;
    std::array<double, 2> edges{};
    double bearings = 0.0;
    for (const DetectorRecord* record : records) {
        const PostRecord& post = record->*which;
        if (!post.counts) continue;
        ++summary.posts;
        if (post.found) ++summary.detected;
        if (post.identified) ++summary.identified;
        if (post.distance_error) all_errors.push_back(*post.distance_error);
        if (post.distance_error && (post.good || !only_good)) {
            errors.push_back(*post.distance_error);
            if (post.bound) {
                bounds.push_back(*post.bound);
                squared_bounds += *post.bound * *post.bound;
            }
        }
        if (post.both_edges) ++summary.both_edges;
        if (post.both_edges && post.identified) ++summary.both_edges_identified;
        if (post.both_edges && post.good) ++summary.good;
        if (post.normalised_error) {
            normalised += *post.normalised_error;
            ++good;
        }
        if (post.edges) {
            edges[0] += (*post.edges)[0];
            edges[1] += (*post.edges)[1];
        }
        if (post.bearing_error) bearings += *post.bearing_error * *post.bearing_error;
    }
    summary.measured = static_cast<int>(errors.size());
    summary.distance = error_statistics(errors);
    summary.all_measured = static_cast<int>(all_errors.size());
    summary.all = error_statistics(all_errors);
    if (!bounds.empty()) {
        summary.bound = std::sqrt(squared_bounds / static_cast<double>(bounds.size()));
        summary.bound_median = percentile(bounds, 0.5);
    }
    if (good > 0) summary.normalised_error = normalised / good;
    if (summary.detected > 0) {
        summary.edges = {edges[0] / summary.detected, edges[1] / summary.detected};
        summary.bearing_rmse = std::sqrt(bearings / summary.detected);
    }
    return summary;
}

}  // namespace

std::optional<double> PostSummary::rmse_to_bound() const {
    if (!distance || !bound) return std::nullopt;
    return distance->rmse / *bound;
}

std::optional<double> PostSummary::median_to_bound() const {
    constexpr double median_of_normal = 0.67448975;  // of |x|, σ 1
    if (!distance || !bound_median) return std::nullopt;
    return distance->median_abs / (median_of_normal * *bound_median);
}

std::optional<double> PostSummary::good_share() const {
    if (both_edges == 0) return std::nullopt;
    return static_cast<double>(good) / both_edges;
}

Summary summarise(const std::vector<const DetectorRecord*>& records, bool refines) {
    Summary summary;
    for (const DetectorRecord* record : records) {
        ++summary.frames;
        summary.posts += record->posts;
        summary.detected += record->detected;
        summary.identified += record->identified;
        summary.false_posts += record->false_posts;
    }
    summary.in_line = summarise_post(records, &DetectorRecord::in_line, refines);
    summary.second = summarise_post(records, &DetectorRecord::second, false);
    return summary;
}

RecordTable::RecordTable(const std::vector<FrameRecord>& records, std::size_t scenes,
                         std::vector<bool> refining)
    : cells_(scenes * cell_count), refines_(std::move(refining)) {
    for (const FrameRecord& record : records) {
        cells_[static_cast<std::size_t>(record.place.scene * cell_count + record.place.cell)].push_back(
            &record);
        refines_.resize(std::max(refines_.size(), record.detectors.size()));
        for (std::size_t d = 0; d < record.detectors.size(); ++d)
            refines_[d] = refines_[d] || record.detectors[d].in_line.good;
    }
}

Summary RecordTable::cell(std::size_t detector, std::size_t scene, int cell) const {
    std::vector<const DetectorRecord*> records;
    for (const FrameRecord* frame : cells_[scene * cell_count + static_cast<std::size_t>(cell)])
        records.push_back(&frame->detectors[detector]);
    return summarise(records, refines(detector));
}

Summary RecordTable::tilt(std::size_t detector, std::size_t scene, std::size_t tilt) const {
    std::vector<const DetectorRecord*> records;
    for (std::size_t i = 0; i < cell_distances_cm.size(); ++i)
        for (const FrameRecord* frame : cells_[scene * cell_count + tilt * cell_distances_cm.size() + i])
            records.push_back(&frame->detectors[detector]);
    return summarise(records, refines(detector));
}

Summary RecordTable::whole(std::size_t detector, std::size_t scene) const {
    std::vector<const DetectorRecord*> records;
    for (std::size_t i = 0; i < cell_count; ++i)
        for (const FrameRecord* frame : cells_[scene * cell_count + i])
            records.push_back(&frame->detectors[detector]);
    return summarise(records, refines(detector));
}

std::optional<RecordTable::Comparison> RecordTable::compare(std::size_t detector, std::size_t other,
                                                            std::size_t scene) const {
    Comparison sums;
    for (std::size_t i = 0; i < cell_count; ++i) {
        for (const FrameRecord* frame : cells_[scene * cell_count + i]) {
            const PostRecord& mine = frame->detectors[detector].in_line;
            const PostRecord& theirs = frame->detectors[other].in_line;
            if (!mine.distance_error || !theirs.distance_error) continue;
            if (refines(detector) && !mine.good) continue;
            ++sums.frames;
            sums.rmse += *mine.distance_error * *mine.distance_error;
            sums.other_rmse += *theirs.distance_error * *theirs.distance_error;
        }
    }
    if (sums.frames == 0) return std::nullopt;
    sums.rmse = std::sqrt(sums.rmse / sums.frames);
    sums.other_rmse = std::sqrt(sums.other_rmse / sums.frames);
    return sums;
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
