#include "tools/evaluate/light_run.h"

#include "tools/evaluate/parallel.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace goalmouth {
namespace {

/// A frame of a sequence, by its place in it.
struct SequenceFrame {
    LightPlace light;
    int cell = 0;
    int index = 0;
    bool judged = false;
};

SequenceFrame sequence_frame(const LightGrid& grid, const LightPlace& last, int place) {
    const int unjudged = frames_before + frames_of_change + frames_of_settling;
    const double share = static_cast<double>(place - frames_before + 1) / frames_of_change;
    SequenceFrame frame;
    frame.light = light_between(grid.lights.front(), last, std::clamp(share, 0.0, 1.0));
    frame.judged = place >= unjudged;
    const int number = frame.judged ? place - unjudged : place;
    frame.cell = number % cell_count;
    // Views before are none of those that are judged.
    frame.index = number / cell_count + (frame.judged ? 0 : grid.paper.frames_per_cell);
    return frame;
}

LightVerdict verdict_of(const CellFrame& frame, const std::vector<Post>& posts, const MatchingRule& rule) {
    const std::vector<ReferencePost> outlines = frame.outlines();
    const PostMatching matching = match_posts(outlines, posts, rule);
    LightVerdict verdict;
    verdict.false_posts = static_cast<int>(matching.wrong_count());
    for (std::size_t i = 0; i < outlines.size(); ++i)
        if (outlines[i].counts) verdict.found.push_back(matching.found[i].has_value());
    return verdict;
}

std::optional<LightSequence> run_sequence(const LightGrid& grid, const LightPlace& light,
                                          const std::vector<LightDetector>& detectors,
                                          const LightWork& work) {
    CellRenderer renderer(grid.paper.scenes.front(), grid.paper.field, grid.paper.camera, grid.paper.seed);
    std::vector<DetectPosts> adapting, fixed;
    for (const LightDetector& detector : detectors) {
        adapting.push_back(detector.adapting());
        fixed.push_back(detector.fixed());
    }
    LightSequence judged;
    for (int place = 0; place < static_cast<int>(sequence_frames(grid)); ++place) {
        if (work.stop && work.stop()) return std::nullopt;
        const SequenceFrame at = sequence_frame(grid, light, place);
        const double time = (place + 1) * light_frame_interval;
        const CellFrame drawn = renderer.render_in(
            {light_factors(at.light, grid.lights.front().temperature), time}, at.cell, at.index);
        DetectorInput input = input_of(drawn, frame_number(at.cell, at.index));
        input.utime = std::llround(time * 1e6);
        LightFrame frame{at.cell, {}, {}};
        for (const DetectPosts& detect : adapting)
            frame.adapting.push_back(verdict_of(drawn, detect(input), grid.paper.rule));
        if (at.judged) {
            for (const DetectPosts& detect : fixed)
                frame.fixed.push_back(verdict_of(drawn, detect(input), grid.paper.rule));
            judged.push_back(std::move(frame));
        }
        if (work.step) work.step();
    }
    return judged;
}

}  // namespace

std::string light_text(const LightPlace& light) {
    return fmt::format("×{:g}, {:g} K", light.brightness, light.temperature);
}

Rgb light_factors(const LightPlace& light, double own_temperature) {
    return static_cast<float>(light.brightness) * light_colour(light.temperature, own_temperature);
}

LightPlace light_between(const LightPlace& from, const LightPlace& to, double share) {
    if (share <= 0.0) return from;
    if (share >= 1.0) return to;
    return {from.brightness * std::pow(to.brightness / from.brightness, share),
            1.0 / ((1.0 - share) / from.temperature + share / to.temperature)};
}

std::size_t sequence_frames(const LightGrid& grid) {
    return static_cast<std::size_t>(frames_before + frames_of_change + frames_of_settling + grid.judged());
}

std::vector<std::optional<LightSequence>> run_light(const LightGrid& grid,
                                                    const std::vector<LightDetector>& detectors,
                                                    const LightWork& work) {
    std::vector<std::optional<LightSequence>> sequences(grid.lights.size());
    for_each_in_parallel(
        grid.lights.size(), work.jobs,
        [&](std::size_t, std::size_t i) {
            sequences[i] = run_sequence(grid, grid.lights[i], detectors, work);
        },
        work.stop);
    return sequences;
}

}  // namespace goalmouth
