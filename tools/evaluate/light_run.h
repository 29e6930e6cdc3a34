#pragma once

#include "core/evaluation/cell.h"
#include "tools/evaluate/paper_run.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace goalmouth {

/// Light of the hall as an evaluation changes it.
struct LightPlace {
    double brightness = 1.0;   // × the scene's own
    double temperature = 0.0;  // K
    bool operator==(const LightPlace&) const = default;
};

/// "×0.3, 2700 K".
std::string light_text(const LightPlace& light);

/// Factors on red, green and blue light that turn the scene's own light, of `own_temperature` [K], into
/// `light`: black bodies (light_colour()), green as bright as the brightness says.
Rgb light_factors(const LightPlace& light, double own_temperature);

/// The light `share` (0…1) of the way from one to the other: equal ratios of brightness and equal steps of
/// the temperature's reciprocal, both of which look even.
LightPlace light_between(const LightPlace& from, const LightPlace& to, double share);

// What a sequence is: the scene's own light, then a slow change, then the other light; frames at even
// times. Those of the last part are judged. Each has a view and a hall of its own.
inline constexpr double light_frame_interval = 0.5;  // s
inline constexpr int frames_before = 24;             // of the scene's own light
inline constexpr int frames_of_change = 30;          // 15 s
inline constexpr int frames_of_settling = 10;        // in the new light, not judged

/// A detector twice: with a colour table that follows the light, and without.
struct LightDetector {
    std::string name;
    std::function<DetectPosts()> adapting;
    std::function<DetectPosts()> fixed;
};

/// What is run: a sequence to each light, with so many judged frames in each of the 18 cells.
struct LightGrid {
    PaperGrid paper;                 // one scene
    std::vector<LightPlace> lights;  // the first is the scene's own
    int judged() const { return cell_count * paper.frames_per_cell; }
};

/// One way of one detector in one judged frame.
struct LightVerdict {
    std::vector<bool> found;  // beside the posts that count
    int false_posts = 0;
};

/// One judged frame. Posts that do not count are left out.
struct LightFrame {
    int cell = 0;
    std::vector<LightVerdict> adapting;  // beside the detectors
    std::vector<LightVerdict> fixed;
};

/// The judged frames of one light, in order: the same views of the same halls for every light.
using LightSequence = std::vector<LightFrame>;

struct LightWork {
    int jobs = 1;
    std::function<bool()> stop = {};  // asked before each frame
    std::function<void()> step = {};  // called after each, by any thread
};

/// Frames of a sequence, judged or not.
std::size_t sequence_frames(const LightGrid& grid);

/// By light; nothing where it was stopped before the sequence's end. The same whatever `jobs` is.
std::vector<std::optional<LightSequence>> run_light(const LightGrid& grid,
                                                    const std::vector<LightDetector>& detectors,
                                                    const LightWork& work);

}  // namespace goalmouth
