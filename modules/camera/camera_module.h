#pragma once

#include "core/geometry/camera.h"
#include "core/imaging/capture_buffer.h"
#include "core/imaging/frame_clock.h"
#include "core/imaging/jpeg.h"
#include "core/imaging/source.h"
#include "core/messaging/camera_info_output.h"
#include "core/messaging/image_output.h"
#include "core/parameters/parameters.h"
#include "core/process/module.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace goalmouth {

struct CameraParameters {
    std::string source = "v4l2";
    std::string device = "/dev/video0";
    std::string path;
    int width = 640;
    int height = 480;
    std::string format = "yuyv";
    double frames_per_second = 30.0;
    bool loop = false;
    std::string camera;
    std::string camera_name = "camera";
    int buffers = 4;
    int readable_frames = 8;
    double linger = 1.0;
    double start_time = 0.0;
};

template <class Visitor>
void describe_parameters(Visitor& v, CameraParameters& p) {
    v("source", p.source, Choice{"v4l2", "directory", "video"}, "where images come from");
    v("device", p.device, Text{}, "source v4l2: the camera");
    v("path", p.path, File{.may_be_empty = true},
      "sources directory and video: folder of images, image or video file");
    v("width", p.width, Range{1, 16384}, "px",
      "image width asked of the camera, and that of raw images in a folder");
    v("height", p.height, Range{1, 16384}, "px", "image height, likewise");
    v("format", p.format, Choice{"yuyv", "mjpeg"}, "source v4l2: pixel format asked of the camera");
    v("frames_per_second", p.frames_per_second, Range{0, 1000}, "1/s",
      "rate asked of the camera, or at which files are sent; 0: the source's own (30 where it has none)");
    v("loop", p.loop, "sources directory and video: start again at the end");
    v("camera", p.camera, File{.may_be_empty = true},
      "calibration; empty: a camera 60° wide without distortion is assumed");
    v("camera_name", p.camera_name, Text{}, "name of the camera in messages");
    v("buffers", p.buffers, Range{2, 32}, "1", "source v4l2: frames the driver may hold");
    v("readable_frames", p.readable_frames, Range{2, 32}, "1",
      "how many of the last frames stay readable; memory is for these and those the driver holds");
    v("linger", p.linger, Range{0, 60}, "s",
      "how long the pixels of the last image stay readable after a source has ended");
    v("start_time", p.start_time, Range{0, 1e10}, "s",
      "sources directory and video: capture time of the first image since 1970 UTC; 0: now");
}

/// A ring as memory for images of files, whose headers may say anything: a slot of the ring there is or, for
/// the first image, of one for images of at most `most_first_bytes`. Larger ones are decoded elsewhere and
/// copied, so that only an image that is one, and that the calibration is for, ever makes the ring larger.
class SlotsForFiles : public FrameMemory {
  public:
    static constexpr std::size_t most_first_bytes = std::size_t{1} << 26;

    explicit SlotsForFiles(ImageOutput& output) : output_(output) {}
    FrameSlot open(std::size_t bytes) override {
        const std::size_t most = output_.slot_bytes() > 0 ? output_.slot_bytes() : most_first_bytes;
        return bytes <= most ? output_.open(bytes) : FrameSlot();
    }
    int slots() const override { return output_.slots(); }

  private:
    void abandon(int) noexcept override {}  // they are the output's
    ImageOutput& output_;
};

/// Publishes the images of a source with their capture time.
class CameraModule : public Module {
  public:
    using Parameters = CameraParameters;

    static ModuleInfo info();
    CameraModule(ModuleContext& context, const Parameters& parameters);

    std::chrono::microseconds tick() override;
    bool finished() const override;

  private:
    using Clock = std::chrono::steady_clock;

    bool fetch();
    ImageSource::Outcome next_image();
    std::chrono::microseconds send_when_due();
    std::chrono::microseconds fetch_in_time();
    std::chrono::microseconds time_left() const;
    void send(std::int64_t utime);
    void announce_camera(std::int64_t utime);
    std::optional<Intrinsics> intrinsics_for(int width, int height);
    bool decode();
    void report_counters();

    ModuleContext& context_;
    Parameters parameters_;
    ImageOutput output_;  // before the source, which writes into it
    SlotsForFiles slots_for_files_{output_};
    std::unique_ptr<ImageSource> source_;
    CameraInfoOutput info_output_;
    std::optional<Intrinsics> calibration_;
    std::optional<Intrinsics> intrinsics_;  // of the image fetched last

    JpegDecoder decoder_;
    CaptureBuffer decoded_{&output_};
    Captured captured_;  // fetched last
    bool fetched_ = false;

    std::int64_t seq_ = 0;
    double rate_ = 0.0;
    std::optional<FrameClock> clock_;  // of files, from the first image on
    Clock::time_point start_{};
    std::chrono::microseconds lead_{0};  // so long before it is due a file's image is fetched
    std::optional<Clock::time_point> end_;
    SourceCounters reported_;
    bool said_damaged_jpeg_ = false;
    bool said_wrong_shape_ = false;
    bool said_no_memory_ = false;
};

}  // namespace goalmouth
