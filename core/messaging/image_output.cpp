#include "core/messaging/image_output.h"

#include "core/imaging/jpeg.h"
#include "core/messaging/typed.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>
#include <utility>

#include <spdlog/spdlog.h>

namespace goalmouth {
namespace {

constexpr const char* no_ring = "/goalmouth-none";

image_t message_of(const FrameInfo& info, const std::string& camera) {
    image_t m{};
    m.utime = info.utime;
    m.seq = info.seq;
    m.camera = camera;
    m.intrinsics = info.intrinsics;
    m.width = info.intrinsics.width;
    m.height = info.intrinsics.height;
    m.exposure_us = info.exposure_us;
    m.readout_us = info.readout_us;
    m.slot = -1;
    m.generation = -1;
    return m;
}

void check_size(const FrameInfo& info, const YuyvView& pixels) {
    if (pixels.empty() || pixels.width != info.intrinsics.width || pixels.height != info.intrinsics.height) {
        throw std::invalid_argument("a frame of another size than its calibration");
    }
}

void copy_rows(const YuyvView& pixels, std::span<std::uint8_t> to) {
    const int row_bytes = yuyv_row_bytes(pixels.width);
    if (pixels.stride == row_bytes) {
        std::copy_n(pixels.data, to.size(), to.begin());
        return;
    }
    for (int y = 0; y < pixels.height; ++y) {
        std::copy_n(pixels.row(y), row_bytes, to.begin() + static_cast<std::ptrdiff_t>(y) * row_bytes);
    }
}

/// The quality at which a JPEG that is `excess` times too large should fit. Quality scales libjpeg's
/// quantisation steps by s; size goes about as s^-0.9, so one or two guesses do where a search would compress
/// seven times.
int lower_quality(int quality, double excess) {
    const double steps = quality >= 50 ? std::max(2.0 - 0.02 * quality, 0.05) : 50.0 / quality;
    const double wanted = steps * std::pow(1.03 * excess, 1.1);
    const double lower = wanted <= 1.0 ? 100.0 - 50.0 * wanted : 50.0 / wanted;
    return std::clamp(static_cast<int>(lower), 1, quality - 1);
}

std::size_t packed_bytes(const YuyvView& pixels) {
    return static_cast<std::size_t>(yuyv_row_bytes(pixels.width)) * static_cast<std::size_t>(pixels.height);
}

}  // namespace

ImageOutput::ImageOutput(Bus& bus, std::string channel, std::string camera, int slots)
    : bus_(bus), channel_(std::move(channel)), camera_(std::move(camera)), slots_(slots) {}

/// Once, unless a smaller frame than before has none.
void ImageOutput::say_no_room(std::size_t bytes, const std::string& why) {
    if (no_room_for_ != 0 && bytes >= no_room_for_) return;
    no_room_for_ = bytes;
    if (ring_) {
        spdlog::warn(fmt::format(
            "camera {}: no room for {} bytes at once: {}. Images that fit into the ring there is, {} bytes, "
            "are "
            "sent through it meanwhile. Trying on",
            camera_, bytes, why, ring_->slot_bytes()));
    } else {
        spdlog::error(fmt::format("images of camera {} cannot be sent: {}. Trying on", camera_, why));
    }
}

/// True once there is a ring whose slots hold `bytes`.
bool ImageOutput::make_room(std::size_t bytes) {
    if (ring_ && ring_->slot_bytes() >= bytes) return true;
    if (ring_ && ring_->open_slots() > 0)
        throw std::logic_error("a larger frame asked for while one is being written");
    if (bytes > FrameRing::most_slot_bytes) {
        say_no_room(bytes, "a ring's slots have at most " + std::to_string(FrameRing::most_slot_bytes));
        return false;
    }
    try {
        ring_ = std::make_unique<FrameRing>(camera_, slots_, bytes);
    } catch (const std::runtime_error& error) {
        say_no_room(bytes, error.what());
        return false;
    }
    // Also where this one is smaller than the one there was no room for: images are sent now, and what lacks
    // room still is a matter of its own.
    if (std::exchange(no_room_for_, 0) != 0)
        spdlog::info(fmt::format("there is shared memory for the images of camera {} now", camera_));
    return true;
}

FrameSlot ImageOutput::open(std::size_t bytes) {
    if (!make_room(bytes)) return {};
    const FrameRing::OpenSlot slot = ring_->begin_write(bytes);
    return {*this, slot.slot, slot.bytes};
}

void ImageOutput::abandon(int number) noexcept {
    ring_->abandon(number);
}

void ImageOutput::announce(const FrameInfo& info, int row_stride, std::size_t bytes, FrameSlot slot) {
    const RingPlace place = ring_->finish_write(slot.take());
    image_t m = message_of(info, camera_);
    m.encoding = "yuyv";
    m.row_stride = row_stride;
    m.ring = ring_->name();
    m.slot = place.slot;
    m.generation = place.generation;
    m.size = static_cast<std::int32_t>(bytes);
    goalmouth::publish(bus_, channel_, m);
}

void ImageOutput::announce_missing(const FrameInfo& info) {
    ++missed_frames_;
    image_t m = message_of(info, camera_);
    m.encoding = "yuyv";
    m.row_stride = yuyv_row_bytes(m.width);
    m.size = m.row_stride * m.height;
    m.ring = no_ring;
    m.slot = 0;
    m.generation = 0;
    goalmouth::publish(bus_, channel_, m);
}

bool ImageOutput::publish(const FrameInfo& info, const YuyvView& pixels) {
    check_size(info, pixels);
    const std::size_t bytes = packed_bytes(pixels);
    FrameSlot slot = open(bytes);
    if (!slot) {
        announce_missing(info);
        return false;
    }
    copy_rows(pixels, slot.bytes().first(bytes));
    announce(info, yuyv_row_bytes(pixels.width), bytes, std::move(slot));
    ++copied_frames_;
    return true;
}

bool ImageOutput::publish(const FrameInfo& info, Captured& image) {
    const YuyvView pixels{image.bytes.data(), image.width, image.height, image.stride};
    if (!image.slot) return publish(info, pixels);
    check_size(info, pixels);
    const auto bytes = static_cast<std::size_t>(image.stride) * static_cast<std::size_t>(image.height);
    announce(info, image.stride, bytes, std::move(image.slot));
    ++frames_in_place_;
    return true;
}

image_t self_contained_yuyv(const FrameInfo& info, const std::string& camera, const YuyvView& pixels) {
    check_size(info, pixels);
    image_t m = message_of(info, camera);
    m.encoding = "yuyv";
    m.row_stride = yuyv_row_bytes(pixels.width);
    m.data.resize(packed_bytes(pixels));
    copy_rows(pixels, m.data);
    m.size = m.data_size = static_cast<std::int32_t>(m.data.size());
    return m;
}

image_t self_contained_jpeg(const FrameInfo& info, const std::string& camera, const YuyvView& pixels,
                            int quality, std::size_t most_bytes) {
    check_size(info, pixels);
    image_t m = message_of(info, camera);
    m.encoding = "jpeg";
    const auto size_at = [&](int q) {
        m.data = jpeg_from_yuyv(pixels, q);
        m.size = m.data_size = static_cast<std::int32_t>(m.data.size());
        return static_cast<std::size_t>(m.getEncodedSize());
    };
    quality = std::clamp(quality, 1, 100);
    for (std::size_t size = size_at(quality); size > most_bytes && quality > 1; size = size_at(quality)) {
        quality = lower_quality(quality, static_cast<double>(size) / static_cast<double>(most_bytes));
    }
    return m;
}

}  // namespace goalmouth
