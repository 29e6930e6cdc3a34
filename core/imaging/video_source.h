#pragma once

#include "core/imaging/capture_buffer.h"
#include "core/imaging/source.h"

#include <filesystem>
#include <memory>

namespace goalmouth {

/// A video file, whatever OpenCV reads.
class VideoSource : public ImageSource {
  public:
    /// Throws FileError where there is no such file or no video in it. Images are converted straight into
    /// `memory`.
    VideoSource(const std::filesystem::path& file, bool loop, SourceLog log, FrameMemory* memory = nullptr);
    ~VideoSource() override;

    Outcome next(Captured& frame, std::chrono::milliseconds timeout) override;
    double frames_per_second() const override { return frames_per_second_; }

  private:
    struct Decoder;
    bool open();

    std::filesystem::path file_;
    bool loop_;
    SourceLog log_;
    std::unique_ptr<Decoder> decoder_;
    double frames_per_second_ = 0.0;
    bool any_this_round_ = false;
    CaptureBuffer buffer_;
};

}  // namespace goalmouth
