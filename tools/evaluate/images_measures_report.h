#pragma once

#include "tools/evaluate/images_report.h"
#include "tools/evaluate/report/html_page.h"

#include <filesystem>

namespace goalmouth {

/// Sections of the page: how far edges lie from the outlines, and, where the robot's places are known, how
/// far distances are from the true ones; each with its worst posts as pictures. Figures go to `folder`.
/// Throws ConfigurationError.
void add_measures(HtmlPage& page, const ImagesResult& result, const std::filesystem::path& folder);

}  // namespace goalmouth
