#pragma once

#include "core/imaging/colour_table.h"
#include "tools/evaluate/images_measures.h"
#include "tools/evaluate/images_score.h"

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace goalmouth {

struct ImagesOptions {
    std::filesystem::path folder;       // the pictures' names count from it
    std::filesystem::path annotations;  // "": annotations.json in the folder
    std::vector<std::string> sets;      // empty: every one
    std::vector<std::string> detectors{"ransac", "refined", "tuned", "histogram"};  // graphs
    std::filesystem::path colours;  // "": tables are learnt from the other folds of the same set …
    bool without_labels = false;    // … and whether without looking at their annotations
    int folds = 4;
    std::map<std::string, std::filesystem::path> cameras;  // by set; "" for all others
    std::map<std::string, std::filesystem::path> fields;   // likewise
    std::map<std::string, std::string> poses;  // by set: the pattern of its file names (PlacePattern)
    int jobs = 1;
};

/// Distances that belong together.
struct DistanceGroup {
    std::string detector;  // "": the outlines themselves
    std::string of;        // MeasuredGroup::name
    std::vector<DistanceSample> samples;
};

/// What was made of one set.
struct ImageSetResult {
    std::string set;
    std::filesystem::path camera;         // "": each graph's own
    std::filesystem::path field;          // "": each graph's own
    std::optional<Field> goals;           // that field, where the robot's places are known
    std::vector<ScoredPicture> pictures;  // by name; each with every detector, in their order
    bool complete = true;

    std::vector<const ScoredPicture*> of(const std::string& detector) const;
    ImageScore score(const std::string& detector) const;
    std::vector<MeasuredPost> measured(const std::string& detector) const;
    /// Where the robot's places are known: what the outlines themselves would say, then each detector's
    /// groups.
    std::vector<DistanceGroup> distances(const std::vector<std::string>& detectors) const;
};

struct ImagesProgress {
    std::function<void(std::size_t pictures)> expect;  // in all; before the first
    std::function<void()> step;                        // after each picture; from any thread
    std::function<bool()> stop;                        // no further picture and no further table is begun
};

/// The sets `options` asks for, and how many pictures they have in all. Throw as evaluate_images().
std::vector<std::string> sets_of(const ImagesOptions& options);
std::size_t pictures_of(const ImagesOptions& options);

/// A table learnt from all pictures of a set, for others: from its annotations, or `without_labels`.
ColourTable table_of_set(const ImagesOptions& options, const std::string& set);

/// Runs every detector on every picture of the sets. A picture's result depends on nothing but the picture,
/// its table and its camera. Throws ConfigurationError for every mistake in the options and the files.
std::vector<ImageSetResult> evaluate_images(const ImagesOptions& options,
                                            const ImagesProgress& progress = {});

}  // namespace goalmouth
