#include "tests/bench/graph/raw_sender.h"

#include "core/conversion/intrinsics.h"
#include "core/imaging/frame_clock.h"
#include "core/imaging/image_file.h"
#include "core/imaging/yuyv.h"
#include "core/messaging/channels.h"
#include "core/messaging/clock.h"
#include "core/messaging/image_output.h"
#include "core/messaging/signals_blocked.h"
#include "tests/bench/graph/pacing.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include <lcm/lcm-cpp.hpp>

namespace goalmouth::bench {
namespace {

std::vector<std::filesystem::path> raw_images(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (is_raw_image_name(entry.path())) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    if (files.empty()) throw std::runtime_error("no raw image in " + folder.string());
    return files;
}

}  // namespace

RawSender::RawSender(const std::string& lcm_url, const std::filesystem::path& folder,
                     const Intrinsics& camera, double frames_per_second, FrameJournal& journal)
    : files_(raw_images(folder)), frames_per_second_(frames_per_second), journal_(journal) {
    const YuyvImage blank(camera.width, camera.height);
    FrameInfo info;
    info.intrinsics = to_message(camera);
    message_ = self_contained_yuyv(info, "camera", blank.view());
    const SignalsBlocked blocked;
    lcm_ = std::make_unique<lcm::LCM>(lcm_url);
    if (!lcm_->good()) throw std::runtime_error("LCM cannot use the URL " + lcm_url);
    thread_ = std::thread([this] { run(); });
}

RawSender::~RawSender() {
    stop_ = true;
    thread_.join();
}

double RawSender::cpu_seconds() {
    return thread_cpu_seconds(thread_);
}

std::string RawSender::failure() const {
    const std::lock_guard lock(mutex_);
    return failure_;
}

void RawSender::run() {
    const auto start = Clock::now();
    const FrameClock clock(now_utime(), frames_per_second_);
    for (std::int64_t seq = 0; !stop_; ++seq) {
        const std::filesystem::path& name = files_[static_cast<std::size_t>(seq) % files_.size()];
        std::ifstream file(name, std::ios::binary);
        if (!file.read(reinterpret_cast<char*>(message_.data.data()), message_.size)) {
            const std::lock_guard lock(mutex_);
            failure_ = name.string() + " cannot be read, or is shorter than a frame";
            return;
        }
        message_.seq = seq;
        message_.utime = clock.utime(seq);
        sleep_until(start + clock.after_start(seq));
        lcm_->publish(channels::image_tap, &message_);
        const std::int64_t now = now_utime();
        journal_.note(Stage::image, {seq, message_.utime, now, now});
    }
}

}  // namespace goalmouth::bench
