#pragma once

#include "core/imaging/colour_labels.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace goalmouth {

/// One picture of an annotated set: with posts, or known to show none.
struct AnnotatedImage {
    std::string set;
    std::string name;            // as the annotation file has it
    std::filesystem::path file;  // where it lies
    int width = 0;               // px; 0 where the annotations do not say
    int height = 0;
    std::vector<PostOutline> posts;
    std::vector<std::optional<double>> edge_sigmas;  // px, beside `posts`: 1 σ of its sides' x, where stated
    std::vector<cv::Rect> ignore;
    bool excluded = false;  // neither positive nor negative: of no use here
};

/// Pictures in which somebody marked the goalposts by hand (their form: docs/colour_tables.md).
class Annotations {
  public:
    /// The pictures' names count from `folder`; "": from where the file lies. Throws FileError where the file
    /// cannot be read, ConfigurationError where it is no annotation file or knows no picture.
    explicit Annotations(const std::filesystem::path& file, const std::filesystem::path& folder = {});

    const std::filesystem::path& file() const { return file_; }
    /// By name.
    std::vector<std::string> sets() const;
    /// The pictures of one set by name, the excluded ones too. Throws ConfigurationError for a set the file
    /// does not know, naming those it does.
    std::vector<AnnotatedImage> pictures(const std::string& set) const;
    /// Those that are of use.
    std::vector<AnnotatedImage> usable_pictures(const std::string& set) const;

  private:
    std::filesystem::path file_;
    std::vector<AnnotatedImage> images_;
};

/// The picture with its posts. Throws FileError.
LabelledScene load_scene(const AnnotatedImage& annotated);

/// One part of a set split into `count` by turns.
struct Fold {
    int index = 0;
    int count = 1;
    /// `place` in the set, its usable pictures ordered by name, from 0.
    bool holds(std::size_t place) const { return static_cast<int>(place) % count == index; }
};

/// "0/4"; nothing where the text is not I/N with 0 ≤ I < N and N ≥ 2.
std::optional<Fold> parse_fold(const std::string& text);

}  // namespace goalmouth
