#include "modules/camera/camera_module.h"

#include "core/conversion/intrinsics.h"
#include "core/imaging/calibration.h"
#include "core/imaging/directory_source.h"
#include "core/imaging/file_error.h"
#include "core/imaging/v4l2_source.h"
#include "core/imaging/video_source.h"
#include "core/messaging/channels.h"
#include "core/messaging/clock.h"
#include "core/process/configuration.h"

#include <fmt/format.h>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include <spdlog/spdlog.h>

namespace goalmouth {

namespace {

constexpr std::chrono::milliseconds longest_wait{50};
constexpr std::chrono::milliseconds least_lead{
    2};  // before it is due, an image of a file is fetched at the latest
constexpr double usual_rate = 30.0;

std::unique_ptr<ImageSource> open_source(const CameraParameters& p, FrameMemory& memory,
                                         FrameMemory& for_files) {
    const SourceLog log = [](const std::string& what) { spdlog::warn(what); };
    const ImageSize size{p.width, p.height};
    try {
        if (p.source == "v4l2") {
            V4l2Settings settings;
            settings.device = p.device;
            settings.format = p.format == "mjpeg" ? PixelFormat::jpeg : PixelFormat::yuyv;
            settings.width = p.width;
            settings.height = p.height;
            settings.frames_per_second = p.frames_per_second;
            settings.buffers = p.buffers;
            return std::make_unique<V4l2Source>(settings, log, &memory);
        }
        if (p.path.empty())
            throw ConfigurationError("path: empty, but the source \"" + p.source + "\" needs one");
        if (p.source == "video") return std::make_unique<VideoSource>(p.path, p.loop, log, &for_files);
        return std::make_unique<DirectorySource>(p.path, size, p.loop, log, &for_files);
    } catch (const FileError& error) {
        throw ConfigurationError(error.what());
    }
}

/// Slots of the ring: those that are being written, one at a time where no driver does it, come on top of
/// those readers can count on.
int slots_of(const CameraParameters& p) {
    const bool driver_writes = p.source == "v4l2" && p.format == "yuyv";
    return p.readable_frames + (driver_writes ? p.buffers : 1);
}

double rate_of(const ImageSource& source, const CameraParameters& p) {
    if (source.live()) return source.frames_per_second();
    if (p.frames_per_second > 0.0) return p.frames_per_second;
    return source.frames_per_second() > 0.0 ? source.frames_per_second() : usual_rate;
}

}  // namespace

ModuleInfo CameraModule::info() {
    return {"camera",
            "Images of a camera, a folder or a video file, with their capture time.",
            {},
            {{channels::image, "image_t", "each image, its pixels in a ring of shared memory"},
             {channels::camera_info, "camera_info_t", "once a second: which camera sends"}}};
}

CameraModule::CameraModule(ModuleContext& context, const Parameters& parameters)
    : context_(context),
      parameters_(parameters),
      output_(context.bus, context.channel(channels::image), parameters.camera_name, slots_of(parameters)),
      source_(open_source(parameters, output_, slots_for_files_)),
      info_output_(context.bus, context.channel(channels::camera_info)),
      rate_(rate_of(*source_, parameters)) {
    for (const auto& [name, value] : output_.counters()) context_.status.set(name, value);
    if (!parameters.camera.empty())
        calibration_ = load_parameters<Intrinsics>(std::filesystem::path(parameters.camera));
    if (source_->live() && calibration_ &&
        !calibration_for(*calibration_, parameters.width, parameters.height)) {
        throw ConfigurationError(
            parameters.camera + ": is for images of " + std::to_string(calibration_->width) + "x" +
            std::to_string(calibration_->height) + ", which " + std::to_string(parameters.width) + "x" +
            std::to_string(parameters.height) + " is no scaled copy of");
    }
}

std::optional<Intrinsics> CameraModule::intrinsics_for(int width, int height) {
    if (!calibration_) return assumed_camera(width, height);
    auto fitting = calibration_for(*calibration_, width, height);
    if (!fitting) {
        context_.status.count("wrong_shape");
        if (!std::exchange(said_wrong_shape_, true)) {
            spdlog::warn(fmt::format("skipped: an image of {}x{}, but the calibration {} is for {}x{}", width,
                                     height, parameters_.camera, calibration_->width, calibration_->height));
        }
    }
    return fitting;
}

/// Motion JPEG into pixels. A damaged header must not decide how much memory there is to be.
bool CameraModule::decode() {
    if (captured_.format == PixelFormat::yuyv) return true;
    const auto jpeg = captured_.bytes;
    try {
        const auto [width, height] = decoder_.size_of(jpeg);
        if (width != captured_.width || height != captured_.height) {
            throw std::runtime_error("a JPEG of " + std::to_string(width) + "x" + std::to_string(height) +
                                     " from a camera that sends " + std::to_string(captured_.width) + "x" +
                                     std::to_string(captured_.height));
        }
        decoder_.decode(jpeg, decoded_.prepare(captured_, width, height));
    } catch (const std::runtime_error& error) {
        context_.status.count("damaged_jpeg");
        if (!std::exchange(said_damaged_jpeg_, true))
            spdlog::warn(fmt::format("skipped: a frame: {}", error.what()));
        return false;
    }
    return true;
}

/// A file may be of any size there is: one that memory does not suffice for is left out.
ImageSource::Outcome CameraModule::next_image() {
    try {
        return source_->next(captured_, longest_wait);
    } catch (const std::bad_alloc&) {
        captured_ = {};
        context_.status.count("too_large");
        if (!std::exchange(said_no_memory_, true))
            spdlog::warn("skipped: an image too large for the memory there is");
        return ImageSource::Outcome::nothing;
    }
}

/// Takes the next image that can be used, if there is one by now.
bool CameraModule::fetch() {
    const auto outcome = next_image();
    report_counters();
    if (outcome == ImageSource::Outcome::ended)
        end_ = Clock::now() +
               std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(parameters_.linger));
    if (outcome != ImageSource::Outcome::captured || !decode()) return false;
    intrinsics_ = intrinsics_for(captured_.width, captured_.height);
    return intrinsics_.has_value();
}

void CameraModule::report_counters() {
    const SourceCounters& now = source_->counters();
    if (now.unreadable != reported_.unreadable)
        context_.status.set("unreadable_images", static_cast<double>(now.unreadable));
    if (now.damaged != reported_.damaged)
        context_.status.set("damaged_frames", static_cast<double>(now.damaged));
    if (now.reopened != reported_.reopened)
        context_.status.set("camera_reopened", static_cast<double>(now.reopened));
    context_.status.dropped(now.lost + now.damaged - reported_.lost - reported_.damaged);
    reported_ = now;
}

void CameraModule::send(std::int64_t utime) {
    FrameInfo info;
    info.utime = utime;
    info.seq = seq_++;
    info.intrinsics = to_message(*intrinsics_);
    announce_camera(utime);
    if (output_.publish(info, captured_)) {
        context_.status.output(utime);
    } else {
        context_.status.dropped(1);
    }
    for (const auto& [name, value] : output_.counters()) context_.status.set(name, value);
}

void CameraModule::announce_camera(std::int64_t utime) {
    camera_info_t info{};
    info.utime = utime;
    info.camera = parameters_.camera_name;
    info.source = parameters_.source == "v4l2" ? parameters_.device : parameters_.path;
    info.frames_per_second = rate_;
    info.intrinsics = to_message(*intrinsics_);
    info_output_.announce(info);
}

/// How long until the next image of a file is due; negative where it is late.
std::chrono::microseconds CameraModule::time_left() const {
    return std::chrono::ceil<std::chrono::microseconds>(start_ + clock_->after_start(seq_) - Clock::now());
}

// Not right after the image before: whoever works on that one needs the processor and the memory now.
std::chrono::microseconds CameraModule::fetch_in_time() {
    if (clock_ && time_left() > lead_) return time_left() - lead_;
    const auto begun = Clock::now();
    fetched_ = fetch();
    const auto took = std::chrono::ceil<std::chrono::microseconds>(Clock::now() - begun);
    lead_ = std::max(lead_ * 9 / 10, least_lead + 3 * took);
    return std::chrono::microseconds(0);
}

std::chrono::microseconds CameraModule::send_when_due() {
    if (!fetched_) {
        const auto wait = fetch_in_time();
        if (!fetched_) return wait;
    }
    if (!clock_) {
        start_ = Clock::now();
        clock_.emplace(utime_or_now(parameters_.start_time), rate_);
    }
    if (const auto left = time_left(); left.count() > 0) return left;
    send(clock_->utime(seq_));
    fetched_ = false;
    return std::chrono::microseconds(0);
}

std::chrono::microseconds CameraModule::tick() {
    if (end_) return std::chrono::milliseconds(10);
    if (!source_->live()) return send_when_due();
    if (fetch()) send(captured_.utime);
    return std::chrono::microseconds(0);
}

bool CameraModule::finished() const {
    return end_ && Clock::now() >= *end_;
}

}  // namespace goalmouth
