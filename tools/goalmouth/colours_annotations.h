#pragma once

#include "core/imaging/colour_labels.h"

#include <filesystem>
#include <string>
#include <vector>

namespace goalmouth {

/// One picture of an annotated set: with posts, or known to show none.
struct AnnotatedImage {
    std::filesystem::path file;
    int width = 0;  // px; 0 where the annotations do not say
    int height = 0;
    std::vector<PostOutline> posts;
    std::vector<cv::Rect> ignore;
    bool excluded = false;  // neither positive nor negative: of no use here
};

/// The pictures of one set of an annotation file (its form: docs/colour_tables.md), ordered by name. Throws
/// ConfigurationError, also for a set the file does not know, naming those it does.
std::vector<AnnotatedImage> load_annotations(const std::filesystem::path& file, const std::string& set);

/// The picture with its posts. Throws FileError.
LabelledScene load_scene(const AnnotatedImage& annotated);

}  // namespace goalmouth
