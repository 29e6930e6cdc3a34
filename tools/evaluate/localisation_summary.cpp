#include "tools/evaluate/localisation_summary.h"

#include "core/evaluation/statistics.h"
#include "core/random/random.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace goalmouth {
namespace {

constexpr int bootstrap_draws = 4000;

using Value = std::function<double(const DetectorWalk&)>;

std::vector<double> values(const LocalisationResult& result, std::size_t detector, const Value& value) {
    std::vector<double> all;
    for (const LocalisationRun& run : result.done) all.push_back(value(run.detectors[detector]));
    return all;
}

MeanSigma mean_sigma(const std::vector<double>& sample) {
    MeanSigma result;
    if (sample.empty()) return result;
    const auto n = static_cast<double>(sample.size());
    for (const double v : sample) result.mean += v / n;
    double squares = 0.0;
    for (const double v : sample) squares += (v - result.mean) * (v - result.mean);
    if (sample.size() > 1) result.sigma = std::sqrt(squares / (n - 1.0));
    return result;
}

QualitySummary summary_of(const LocalisationResult& result, std::size_t detector,
                          PoseQuality DetectorWalk::*part) {
    const auto of = [&](double PoseQuality::*value) {
        return values(result, detector, [=](const DetectorWalk& walk) { return walk.*part.*value; });
    };
    QualitySummary summary;
    const std::vector<double> position = of(&PoseQuality::position_error);
    const std::vector<double> heading = of(&PoseQuality::heading_error);
    summary.position_error = mean_sigma(position);
    summary.heading_error = mean_sigma(heading);
    summary.position_sigma = mean_sigma(of(&PoseQuality::position_sigma));
    summary.heading_sigma = mean_sigma(of(&PoseQuality::heading_sigma));
    summary.position_median = percentile(position, 0.5).value_or(0.0);
    summary.heading_median = percentile(heading, 0.5).value_or(0.0);
    return summary;
}

double reduction(double ours, double theirs) {
    return theirs > 0.0 ? 1.0 - ours / theirs : 0.0;
}

Reduction bootstrap(const std::vector<double>& ours, const std::vector<double>& theirs, std::uint64_t seed) {
    const auto sum = [](const std::vector<double>& v) {
        double total = 0.0;
        for (const double x : v) total += x;
        return total;
    };
    Random random(seed);
    std::vector<double> drawn;
    for (int draw = 0; draw < bootstrap_draws; ++draw) {
        double a = 0.0;
        double b = 0.0;
        for (std::size_t i = 0; i < ours.size(); ++i) {
            const std::uint32_t run = random.index(static_cast<std::uint32_t>(ours.size()));
            a += ours[run];
            b += theirs[run];
        }
        drawn.push_back(reduction(a, b));
    }
    return {reduction(sum(ours), sum(theirs)), percentile(drawn, 0.025).value_or(0.0),
            percentile(drawn, 0.975).value_or(0.0)};
}

}  // namespace

std::vector<DetectorSummary> summarise(const LocalisationResult& result) {
    std::vector<DetectorSummary> summaries;
    for (std::size_t d = 0; d < result.detectors.size(); ++d) {
        DetectorSummary summary;
        summary.detector = result.detectors[d];
        summary.runs = static_cast<int>(result.done.size());
        summary.walk = summary_of(result, d, &DetectorWalk::walk);
        summary.end = summary_of(result, d, &DetectorWalk::end);
        std::int64_t frames = 0;
        std::int64_t posts = 0;
        int lost = 0;
        for (const LocalisationRun& run : result.done) {
            frames += run.frames;
            posts += run.detectors[d].posts;
            if (run.detectors[d].end.position_error > lost_beyond) ++lost;
        }
        if (summary.runs > 0) summary.lost = static_cast<double>(lost) / summary.runs;
        if (frames > 0) summary.posts_per_frame = static_cast<double>(posts) / static_cast<double>(frames);
        summaries.push_back(summary);
    }
    return summaries;
}

std::vector<DetectorComparison> compare(const LocalisationResult& result) {
    std::vector<DetectorComparison> comparisons;
    if (result.done.size() < 2) return comparisons;
    const auto histogram = std::find(result.detectors.begin(), result.detectors.end(), "histogram");
    const auto baseline = histogram == result.detectors.end()
                              ? std::size_t{0}
                              : static_cast<std::size_t>(histogram - result.detectors.begin());
    for (std::size_t d = 0; d < result.detectors.size(); ++d) {
        if (d == baseline) continue;
        const auto of = [&](PoseQuality DetectorWalk::*part, double PoseQuality::*value) {
            const Value get = [=](const DetectorWalk& walk) { return walk.*part.*value; };
            return bootstrap(values(result, d, get), values(result, baseline, get), result.seed);
        };
        DetectorComparison c;
        c.detector = result.detectors[d];
        c.against = result.detectors[baseline];
        c.walk_position_error = of(&DetectorWalk::walk, &PoseQuality::position_error);
        c.walk_heading_error = of(&DetectorWalk::walk, &PoseQuality::heading_error);
        c.end_position_error = of(&DetectorWalk::end, &PoseQuality::position_error);
        c.end_heading_error = of(&DetectorWalk::end, &PoseQuality::heading_error);
        c.walk_position_sigma = of(&DetectorWalk::walk, &PoseQuality::position_sigma);
        c.walk_heading_sigma = of(&DetectorWalk::walk, &PoseQuality::heading_sigma);
        c.end_position_sigma = of(&DetectorWalk::end, &PoseQuality::position_sigma);
        c.end_heading_sigma = of(&DetectorWalk::end, &PoseQuality::heading_sigma);
        comparisons.push_back(c);
    }
    return comparisons;
}

}  // namespace goalmouth
