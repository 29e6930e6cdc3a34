#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace goalmouth {

/// Leaves out every picture whose place in the set (ordered by name, from 0) is ≡ index modulo count.
struct Fold {
    int index = 0;
    int count = 1;
};

/// "0/4"; nothing where the text is not I/N with 0 ≤ I < N and N ≥ 2.
std::optional<Fold> parse_fold(const std::string& text);

struct TrainColoursOptions {
    std::filesystem::path annotations;
    std::string set;
    std::optional<Fold> fold;
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
