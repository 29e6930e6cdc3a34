#pragma once

#include "core/imaging/capture_buffer.h"
#include "core/imaging/image_file.h"
#include "core/imaging/source.h"

#include <filesystem>
#include <optional>
#include <set>
#include <vector>

namespace goalmouth {

/// The images of a folder ordered by name (PNG, JPEG, PPM, raw .yuyv), or one image file.
/// The list is made once. What cannot be read is skipped, counted at each try and reported once.
class DirectorySource : public ImageSource {
  public:
    /// `size`: of raw images; others must have it too, where it is given. `loop`: start again after the last
    /// image, unless a whole round gave none. Throws FileError where there is no such folder or no file in it
    /// has an image's name. Images are read or decoded straight into `memory`.
    DirectorySource(const std::filesystem::path& path, std::optional<ImageSize> raw_size, bool loop,
                    SourceLog log, FrameMemory* memory = nullptr);

    Outcome next(Captured& frame, std::chrono::milliseconds timeout) override;

    const std::vector<std::filesystem::path>& files() const { return files_; }
    /// The file the last captured image came from.
    const std::filesystem::path& file() const { return file_; }

  private:
    std::vector<std::filesystem::path> files_;
    std::filesystem::path file_;
    std::optional<ImageSize> raw_size_;
    bool loop_;
    SourceLog log_;
    std::size_t at_ = 0;
    bool any_this_round_ = false;
    std::set<std::filesystem::path> reported_;
    CaptureBuffer buffer_;
};

}  // namespace goalmouth
