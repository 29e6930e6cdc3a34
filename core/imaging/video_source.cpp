#include "core/imaging/video_source.h"

#include "core/imaging/conversion.h"
#include "core/imaging/file_error.h"

#include <cmath>
#include <utility>

#include <opencv2/videoio.hpp>

namespace goalmouth {

struct VideoSource::Decoder {
    cv::VideoCapture capture;
    cv::Mat bgr;
};

VideoSource::VideoSource(const std::filesystem::path& file, bool loop, SourceLog log, FrameMemory* memory)
    : file_(file), loop_(loop), log_(std::move(log)), decoder_(std::make_unique<Decoder>()), buffer_(memory) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
        throw FileError(file.string() + ": no such video file");
    if (std::filesystem::file_size(file, error) == 0) throw FileError(file.string() + ": is empty (0 bytes)");
    if (!open()) throw FileError(file.string() + ": not a video OpenCV can read, or a damaged one");
    const double rate = decoder_->capture.get(cv::CAP_PROP_FPS);
    if (std::isfinite(rate) && rate > 0.0 && rate <= 1000.0) frames_per_second_ = rate;
}

VideoSource::~VideoSource() = default;

bool VideoSource::open() {
    any_this_round_ = false;
    try {
        // Other readers of OpenCV would take the name for a pattern of many files, a camera or a pipeline.
        return decoder_->capture.open(file_.string(), cv::CAP_FFMPEG) ||
               decoder_->capture.open(file_.string(), cv::CAP_OPENCV_MJPEG);
    } catch (const cv::Exception&) {
        return false;
    }
}

ImageSource::Outcome VideoSource::next(Captured& frame, std::chrono::milliseconds) {
    frame = {};
    for (;;) {
        bool read = false;
        try {
            read = decoder_->capture.read(decoder_->bgr) && !decoder_->bgr.empty();
        } catch (const cv::Exception& error) {
            if (counters_.unreadable++ == 0 && log_)
                log_(file_.string() + ": a frame cannot be decoded: " + error.what());
        }
        if (read) break;
        if (!loop_ || !any_this_round_ || !open()) return Outcome::ended;
    }
    any_this_round_ = true;
    yuyv_from_bgr(decoder_->bgr, buffer_.prepare(frame, decoder_->bgr.cols, decoder_->bgr.rows));
    return Outcome::captured;
}

}  // namespace goalmouth
