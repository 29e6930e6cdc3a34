#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace goalmouth {

class FrameMemory;

/// Memory for one image while it is written. Whoever holds this may write, and nobody reads; it is given back
/// unread when it goes, unless it was taken from here to be announced. Empty where there was no memory.
class FrameSlot {
  public:
    FrameSlot() = default;
    FrameSlot(FrameMemory& memory, int number, std::span<std::uint8_t> bytes)
        : memory_(&memory), number_(number), bytes_(bytes) {}
    FrameSlot(FrameSlot&& other) noexcept { swap(other); }
    FrameSlot& operator=(FrameSlot&& other) noexcept {
        FrameSlot(std::move(other)).swap(*this);
        return *this;
    }
    ~FrameSlot();

    explicit operator bool() const { return memory_ != nullptr; }
    std::span<std::uint8_t> bytes() const { return bytes_; }  // page-aligned
    int number() const { return number_; }

    /// For the memory's owner: the slot is his again, and this is empty.
    int take() {
        memory_ = nullptr;
        bytes_ = {};
        return std::exchange(number_, -1);
    }

  private:
    void swap(FrameSlot& other) noexcept {
        std::swap(memory_, other.memory_);
        std::swap(number_, other.number_);
        std::swap(bytes_, other.bytes_);
    }

    FrameMemory* memory_ = nullptr;
    int number_ = -1;
    std::span<std::uint8_t> bytes_;
};

/// Where a source of images may write them so that nobody need copy them. Outlives its slots.
class FrameMemory {
  public:
    FrameMemory() = default;
    FrameMemory(const FrameMemory&) = delete;
    FrameMemory& operator=(const FrameMemory&) = delete;
    virtual ~FrameMemory() = default;

    /// The slot that was announced longest ago, with exactly `bytes` to write. Empty where there is no memory
    /// now. While any is open, all that are asked for fit where that one fits.
    virtual FrameSlot open(std::size_t bytes) = 0;
    /// How many there are, numbered from 0. Only those that are not open can be read.
    virtual int slots() const = 0;

  protected:
    friend class FrameSlot;
    virtual void abandon(int number) noexcept = 0;
};

inline FrameSlot::~FrameSlot() {
    if (memory_ != nullptr) memory_->abandon(number_);
}

}  // namespace goalmouth
