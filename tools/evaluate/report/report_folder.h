#pragma once

#include "tools/goalmouth/temporary_folder.h"

#include <filesystem>
#include <optional>
#include <string>

namespace goalmouth {

/// Refuses, before the work, a report's folder that is a file or that cannot be made or written. Makes
/// nothing. Throws ConfigurationError, which begins with `option` and names the folder.
void expect_report_folder(const std::filesystem::path& target, const std::string& option = "--report");

/// A report in the making. Its files are made in a temporary folder beside `target` (inside it where `target`
/// is on another file system or the folder above may not be written), which goes when the object does.
/// publish() moves them to their places: a report that was there is wholly the old one or wholly the new one,
/// and files that we did not make stay.
class ReportFolder {
  public:
    /// Throws as expect_report_folder does.
    explicit ReportFolder(const std::filesystem::path& target, const std::string& option = "--report");

    /// Where files are made: for draw_figure(), write_picture(), …. Folders in it are allowed.
    const std::filesystem::path& path() const { return work_->path(); }

    /// A text file in path(), UTF-8. `name` may not leave the folder.
    void write(const std::string& name, const std::string& text);

    /// Moves everything to the target, file by file, index.html last. Where one cannot be moved, those moved
    /// before it are put back. Throws ConfigurationError naming the folder. To be called once.
    void publish();

  private:
    std::filesystem::path target_;
    std::optional<TemporaryFolder> work_;  // until published
    std::string option_;
};

}  // namespace goalmouth
