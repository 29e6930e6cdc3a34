#pragma once

#include "tools/evaluate/light_run.h"
#include "tools/evaluate/paper_result.h"

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace goalmouth {

/// What `goalmouth evaluate light` was asked for, as the command line gives it.
struct LightOptions {
    LightOptions();
    PaperOptions paper;
    std::vector<double> brightness = {0.3, 0.5, 0.7, 1.5, 2.0, 3.0};  // × the scene's own
    std::vector<double> temperatures = {2700.0, 3200.0, 5000.0, 5700.0, 6500.0, 7500.0};  // K
};

/// One way of one detector in one light.
struct LightShare {
    int posts = 0;
    int found = 0;
    int false_posts = 0;
    int frames = 0;
    /// Posts that the detector finds in the scene's own light without adapting, and those of them it finds
    /// here.
    int known = 0;
    int kept = 0;

    double found_share() const { return posts > 0 ? static_cast<double>(found) / posts : 0.0; }
    double kept_share() const { return known > 0 ? static_cast<double>(kept) / known : 0.0; }
    double false_per_frame() const { return frames > 0 ? static_cast<double>(false_posts) / frames : 0.0; }
};

struct LightResult {
    std::string version;  // of goalmouth
    std::string command;
    LightOptions options;
    std::string scene;
    std::vector<std::string> detectors;  // names
    nlohmann::ordered_json settings;
    std::vector<LightPlace> lights;                       // the first is the scene's own
    std::vector<std::optional<LightSequence>> sequences;  // beside them

    bool complete() const;
    /// Nothing where the light's sequence, or that of the scene's own light, was not run to its end. `cell`:
    /// of one alone.
    std::optional<LightShare> share(std::size_t detector, std::size_t light, bool adapting,
                                    std::optional<int> cell = std::nullopt) const;
};

/// The share of the posts that acceptance asks for in every light, with adaptation.
inline constexpr double wanted_in_any_light = 0.97;

/// What came of a detector: in the scene's own light, in the worst light with and without adaptation, the
/// worst cell, and whether what is asked holds.
std::string light_headline(const LightResult& result, std::size_t detector);

/// For a terminal: headlines, and a line for each light.
std::string light_table(const LightResult& result);

std::string light_json(const LightResult& result);

}  // namespace goalmouth
