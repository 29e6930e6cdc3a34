#pragma once

#include "core/imaging/yuyv.h"
#include "tests/tools_detect/annotations.h"
#include "tools/goalmouth/image_chain.h"

#include <filesystem>
#include <vector>

#include <opencv2/core.hpp>

namespace goalmouth::test {

/// Pictures in which something was missed or wrong, on one sheet: border, edge points and posts as found, the
/// hand-marked posts in green, file and figures below.
class FailureSheet {
  public:
    void add(const AnnotatedImage& annotated, YuyvView image, const ImageResult& result, const Score& score);
    /// Writes the sheet, the worst first; nothing where nothing failed. Folders are made.
    void write(const std::filesystem::path& file) const;

  private:
    struct Tile {
        int mistakes;
        cv::Mat picture;
    };
    std::vector<Tile> tiles_;
};

}  // namespace goalmouth::test
