#include "core/messaging/camera_info_output.h"

#include "core/messaging/typed.h"

#include <utility>

namespace goalmouth {

namespace {

constexpr std::int64_t interval = 1000000;  // µs

}  // namespace

CameraInfoOutput::CameraInfoOutput(Bus& bus, std::string channel) : bus_(bus), channel_(std::move(channel)) {}

void CameraInfoOutput::announce(const camera_info_t& info) {
    if (next_utime_ && info.utime < *next_utime_) return;
    next_utime_ = info.utime + interval;
    publish(bus_, channel_, info);
}

}  // namespace goalmouth
