#pragma once

#include "core/imaging/colour_labels.h"
#include "core/imaging/colour_training.h"
#include "tools/goalmouth/annotations.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace goalmouth {

/// What a table is made of, learnt from annotated pictures; `each` sees the labels of every one, by its
/// place. Throws ConfigurationError, which begins with `what`, where nothing can be learnt from them.
ColourTrainer learn_colours(std::span<const LabelledScene> scenes, const ColourTrainingParameters& parameters,
                            const std::string& what,
                            const std::function<void(std::size_t, const cv::Mat&)>& each = {});

struct TrainColoursOptions {
    std::filesystem::path annotations;
    std::string set;
    std::optional<Fold> fold;                   // left out
    std::vector<std::filesystem::path> images;  // files or folders; empty: the whole set
    std::filesystem::path parameters;           // YAML for ColourTrainingParameters; empty: defaults
    std::filesystem::path labels;               // folder for pictures of the labels; empty: none
    std::filesystem::path output;
    std::string name;  // empty: the output's
    int bits = 6;
};

/// Trains, writes the table and prints what it learnt from and how it does. Throws ConfigurationError and
/// FileError.
int train_colours(const TrainColoursOptions& options);

}  // namespace goalmouth
