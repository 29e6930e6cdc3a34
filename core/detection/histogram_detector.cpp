#include "core/detection/histogram_detector.h"

#include "core/detection/histogram.h"

#include <algorithm>

namespace goalmouth {
namespace {

/// Smallest upright box around segments, to the outer borders of their pixels [px].
struct Box {
    double left, right, top, bottom;

    static Box around(const CandidateSegment& s) {
        if (s.orientation == Orientation::horizontal)
            return {s.start - 0.5, s.end + 0.5, s.line - 0.5, s.line + 0.5};
        return {s.line - 0.5, s.line + 0.5, s.start - 0.5, s.end + 0.5};
    }
    void add(const Box& other) {
        left = std::min(left, other.left);
        right = std::max(right, other.right);
        top = std::min(top, other.top);
        bottom = std::max(bottom, other.bottom);
    }
};

Post post_from(const Box& box, int segments, int image_width) {
    Post post;
    post.left_top = {box.left, box.top};
    post.left_base = {box.left, box.bottom};
    post.right_top = {box.right, box.top};
    post.right_base = {box.right, box.bottom};
    post.support_left = post.support_right = segments;
    const bool at_left = box.left <= -0.5;
    const bool at_right = box.right >= image_width - 0.5;
    if (at_left) post.flags |= post_flag::left_edge_missing | post_flag::cut_left;
    if (at_right) post.flags |= post_flag::right_edge_missing | post_flag::cut_right;
    if (at_left && at_right) post.flags |= post_flag::fills_image;
    return post;
}

std::vector<Post> detected(const Candidates& candidates, const Intrinsics& camera, double diameter,
                           const HistogramParameters& parameters) {
    const auto segments = without_outsized(candidates.segments, parameters.length_limit);
    if (segments.empty()) return {};
    const Histogram histogram = build_histogram(segments, candidates.width, parameters.bins);

    const double area = static_cast<double>(candidates.width) * candidates.height / (640.0 * 480.0);

    std::vector<Post> posts;
    for (const PeakGroup& group : group_peaks(histogram.counts, parameters.peak_threshold * area)) {
        std::vector<Box> boxes;
        for (const CandidateSegment& s : segments) {
            const std::size_t bin = histogram.bin(s.centre().x());
            if (bin >= group.first && bin <= group.last) boxes.push_back(Box::around(s));
        }
        Box box = boxes.front();
        for (const Box& b : boxes) box.add(b);
        Post post = post_from(box, static_cast<int>(boxes.size()), candidates.width);
        measure_post(post, camera, diameter, parameters.edge_sigma, parameters.edge_sigma,
                     parameters.measurement);
        posts.push_back(post);
    }
    assign_sides(posts, candidates, parameters.sides);
    return posts;
}

}  // namespace

const std::vector<Post>& HistogramDetector::detect(const Candidates& candidates, const Intrinsics& camera) {
    posts_ = detected(candidates, camera, diameter_, parameters_);
    return posts_;
}

std::vector<Post> detect_posts_by_histogram(const Candidates& candidates, const Intrinsics& camera,
                                            double diameter, const HistogramParameters& parameters) {
    return HistogramDetector(parameters, diameter).detect(candidates, camera);
}

}  // namespace goalmouth
