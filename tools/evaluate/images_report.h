#pragma once

#include "tools/evaluate/images_run.h"

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>
#include <opencv2/core.hpp>

namespace goalmouth {

/// An evaluation of images with what is needed to make it again.
struct ImagesResult {
    std::string version;
    std::string command;
    ImagesOptions options;
    std::vector<ImageSetResult> sets;

    bool complete() const;
};

/// What `--json` writes: figures for each set and detector, then every picture with what became of each
/// annotated post and of each detection.
nlohmann::ordered_json images_json(const ImagesResult& result);

/// For a terminal: what was found, how far edges are off, and distances where places are known.
std::string images_text(const ImagesResult& result);

/// The picture with the annotated posts (found, missed) and the detections (right, wrong, ignored), each in a
/// colour of its own, and border and edge points behind them. `picture` is BGR.
void draw_scored_picture(cv::Mat& picture, const ScoredPicture& scored);

/// index.html with tables, figures and every picture in which something failed; overlays/SET/DETECTOR/ with
/// all of them. Throws ConfigurationError.
void write_images_report(const ImagesResult& result, const std::filesystem::path& folder);

}  // namespace goalmouth
