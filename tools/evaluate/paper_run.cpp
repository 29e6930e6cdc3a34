#include "tools/evaluate/paper_run.h"

#include "tools/evaluate/parallel.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <Eigen/Dense>

namespace goalmouth {
namespace {

/// What one thread works with. Frames come scene by scene, so the renderer of one scene at a time is enough.
struct Worker {
    std::vector<DetectPosts> detectors;
    int scene = -1;
    std::unique_ptr<CellRenderer> renderer;

    CellRenderer& renderer_of(const PaperGrid& grid, int wanted) {
        if (scene != wanted) {
            renderer = nullptr;
            renderer = std::make_unique<CellRenderer>(grid.scenes[static_cast<std::size_t>(wanted)],
                                                      grid.field, grid.camera, grid.seed);
            scene = wanted;
        }
        return *renderer;
    }
};

/// Where the detection says the post's middle line is, in the row of its own middle.
double bearing_error(const KnownPost& known, const Post& meant, const Intrinsics& camera) {
    const double row = 0.25 * (meant.left_top + meant.left_base + meant.right_top + meant.right_base).y();
    return meant.bearing_rad - bearing_in_row(known.outline, camera, row);
}

double normalised_error(const Eigen::Vector2d& error, const Eigen::Matrix2d& covariance) {
    const Eigen::LLT<Eigen::Matrix2d> factors(covariance);
    if (factors.info() != Eigen::Success) return largest_normalised_error;
    const double value = 0.5 * error.dot(factors.solve(error));
    return std::isfinite(value) ? std::min(value, largest_normalised_error) : largest_normalised_error;
}

PostRecord record_of_post(const KnownPost& known, const Post* meant, bool found, const Intrinsics& camera) {
    PostRecord record;
    record.counts = known.outline.counts;
    if (!record.counts) return record;
    record.found = found;
    record.identified = meant != nullptr;
    if (meant == nullptr) return record;
    if (!meant->has(post_flag::no_distance) && std::isfinite(meant->distance_m))
        record.distance_error = meant->distance_m - known.truth.distance_m;
    if (found) {
        record.edges = edge_offsets(known.outline, *meant);
        record.bearing_error = bearing_error(known, *meant, camera);
    }
    return record;
}

/// What only refined posts and the bound say.
void judge(PostRecord& record, const KnownPost& known, const Post* meant, const Intrinsics& camera,
           const std::optional<PostSight>& sight) {
    if (!record.counts) return;
    if (sight) {
        record.both_edges = sight->both_edges();
        if (sight->bound) record.bound = sight->bound->distance_sigma();
    }
    if (!record.distance_error || !meant->has(post_flag::refined)) return;
    record.good = true;
    record.normalised_error =
        normalised_error({*record.distance_error, bearing_error(known, *meant, camera)}, meant->covariance);
}

}  // namespace

DetectorInput input_of(const CellFrame& frame, std::int64_t seq) {
    return {frame.image.view(), seq, frame.view.told, frame.kinematics};
}

std::int64_t running_number(const FramePlace& place, int frames_per_cell) {
    return (static_cast<std::int64_t>(place.scene) * cell_count + place.cell) * frames_per_cell + place.index;
}

FramePlace frame_place(std::int64_t number, int frames_per_cell) {
    const std::int64_t cell = number / frames_per_cell;
    return {static_cast<int>(cell / cell_count), static_cast<int>(cell % cell_count),
            static_cast<int>(number % frames_per_cell)};
}

DetectorRecord record_of(const CellFrame& frame, const std::vector<Post>& posts, const Intrinsics& camera,
                         const MatchingRule& rule) {
    const std::vector<ReferencePost> outlines = frame.outlines();
    const PostMatching matching = match_posts(outlines, posts, rule);
    DetectorRecord record;
    record.false_posts = static_cast<int>(matching.wrong_count());
    record.detected = static_cast<int>(matching.found_count(outlines));
    for (std::size_t i = 0; i < frame.posts.size(); ++i) {
        const KnownPost& known = frame.posts[i];
        if (known.outline.counts) {
            ++record.posts;
            if (matching.identified[i]) ++record.identified;
        }
        const Post* meant = matching.identified[i] ? &posts[*matching.identified[i]] : nullptr;
        const bool found = matching.found[i].has_value();
        if (known.truth.id == post_in_line) {
            record.in_line = record_of_post(known, meant, found, camera);
            judge(record.in_line, known, meant, camera, frame.sight);
        }
        if (known.truth.id == second_post) record.second = record_of_post(known, meant, found, camera);
    }
    return record;
}

std::size_t frame_count(const PaperGrid& grid, const Shard& shard) {
    const std::int64_t all =
        static_cast<std::int64_t>(grid.scenes.size()) * cell_count * grid.frames_per_cell;
    return static_cast<std::size_t>((all - shard.part + shard.parts) / shard.parts);
}

std::vector<FrameRecord> run_paper(const PaperGrid& grid, const std::vector<Detector>& detectors,
                                   const PaperWork& work) {
    std::vector<Worker> workers(static_cast<std::size_t>(work.jobs));
    for (Worker& worker : workers)
        for (const Detector& detector : detectors) worker.detectors.push_back(detector.make());

    std::vector<std::optional<FrameRecord>> slots(frame_count(grid, work.shard));
    const auto frame = [&](std::size_t number, std::size_t item) {
        Worker& worker = workers[number];
        FrameRecord record;
        record.place = frame_place(static_cast<std::int64_t>(item) * work.shard.parts + work.shard.part - 1,
                                   grid.frames_per_cell);
        CellRenderer& renderer = worker.renderer_of(grid, record.place.scene);
        const CellFrame drawn = renderer.render(record.place.cell, record.place.index);
        const std::int64_t seq = frame_number(record.place.cell, record.place.index);
        for (const DetectPosts& detect : worker.detectors) {
            record.detectors.push_back(
                record_of(drawn, detect(input_of(drawn, seq)), renderer.camera(), grid.rule));
        }
        slots[item] = std::move(record);
        if (work.step) work.step();
    };
    for_each_in_parallel(slots.size(), work.jobs, frame, work.stop);

    std::vector<FrameRecord> done;
    for (auto& slot : slots)
        if (slot) done.push_back(std::move(*slot));
    return done;
}

}  // namespace goalmouth
