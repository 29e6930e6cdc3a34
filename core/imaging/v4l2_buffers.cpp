#include "core/imaging/v4l2_buffers.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace goalmouth {

bool V4l2Buffers::start(int count, std::size_t image_bytes) {
    image_bytes_ = image_bytes;
    in_place_ = false;
    lacks_room_ = false;
    if (memory_ != nullptr && !keeps_slots_) {
        refusal_.clear();
        if (start_in_place(count, image_bytes)) return true;
        keeps_slots_ = !device_.release_buffers();
        if (keeps_slots_) device_.close();
        buffers_.clear();
        missing_ = 0;
        if (keeps_slots_) return false;
    }
    start_mapped(std::max(count, device_.least_buffers()));
    return true;
}

bool V4l2Buffers::start_in_place(int count, std::size_t image_bytes) {
    if (const int least = std::max(count, device_.least_buffers());
        least > count || least >= memory_->slots()) {
        refusal_ = "it needs " + std::to_string(least) + " buffers at once";
        return false;
    }
    FrameSlot first = memory_->open(image_bytes);
    lacks_room_ = !first;
    if (lacks_room_) return false;
    const int given = device_.request_user_buffers(std::min(memory_->slots(), VIDEO_MAX_FRAME));
    if (given < count) {
        refusal_ = given == 0 ? std::strerror(errno) : "it takes too few buffers";
        return false;
    }
    buffers_.resize(static_cast<std::size_t>(given));
    missing_ = count - 1;
    if (!queue(std::move(first)) || !refill() || !device_.start_streaming()) {
        refusal_ = std::strerror(errno);
        return false;
    }
    in_place_ = true;
    return true;
}

void V4l2Buffers::start_mapped(int count) {
    device_.map_buffers(count);
    for (std::uint32_t i = 0; i < device_.buffers(); ++i) {
        if (!device_.queue(i)) device_.fail("does not take its buffers");
    }
    if (!device_.start_streaming()) device_.fail("does not start streaming");
}

void V4l2Buffers::stop() {
    device_.close();
    buffers_.clear();
    missing_ = 0;
    held_.reset();
}

bool V4l2Buffers::queue(FrameSlot slot) {
    const auto free_one = [&](int last) {
        return std::find_if(buffers_.begin(), buffers_.end(),
                            [&](const Buffer& b) { return !b.slot && b.last == last; });
    };
    auto buffer = free_one(slot.number());
    if (buffer == buffers_.end()) buffer = free_one(-1);
    if (buffer == buffers_.end()) {  // more slots than buffers
        buffer = std::find_if(buffers_.begin(), buffers_.end(), [](const Buffer& b) { return !b.slot; });
    }
    if (!device_.queue(static_cast<std::uint32_t>(buffer - buffers_.begin()), slot.bytes())) return false;
    buffer->last = slot.number();
    buffer->slot = std::move(slot);
    return true;
}

bool V4l2Buffers::take(Filled& filled) {
    filled = {};
    if (!device_.dequeue(filled.buffer)) return false;
    const std::uint32_t index = filled.buffer.index;
    const bool known =
        in_place_ ? index < buffers_.size() && buffers_[index].slot : index < device_.buffers();
    if (!known) {
        errno = EBADSLT;
        return false;
    }
    std::span<const std::uint8_t> whole;
    if (in_place_) {
        filled.slot = std::move(buffers_[index].slot);
        ++missing_;
        whole = filled.slot.bytes();
    } else {
        held_ = index;
        whole = {device_.buffer(index).data, device_.buffer(index).length};
    }
    filled.bytes = whole.first(std::min<std::size_t>(filled.buffer.bytesused, whole.size()));
    return true;
}

bool V4l2Buffers::refill() {
    if (held_) {
        const std::uint32_t index = *std::exchange(held_, std::nullopt);
        if (!device_.queue(index)) return false;
    }
    for (; missing_ > 0; --missing_) {
        FrameSlot slot = memory_->open(image_bytes_);
        if (!slot) {
            errno = ENOMEM;
            return false;
        }
        if (!queue(std::move(slot))) return false;
    }
    return true;
}

}  // namespace goalmouth
