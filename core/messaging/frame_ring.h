#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <goalmouth/image_t.hpp>

namespace goalmouth {

/// Pixels between processes: a ring of slots in POSIX shared memory, one producer, any number of readers that
/// cannot write.
///
/// Nobody waits for anybody: the producer takes the next slot, whoever may still be reading it. Each slot
/// therefore has a generation (a sequence lock): odd while it is written, even and larger by two with each
/// frame. A reader takes a frame by the generation its descriptor names, uses the pixels in place, and asks
/// still_valid() after use, before it believes the result.
struct RingLayout;

/// Where a frame stands in its producer's ring: what image_t carries.
struct RingPlace {
    std::int32_t slot = 0;
    std::int64_t generation = 0;
};

/// The producer's side. The memory is only its user's to open (mode 0600) and gone when this object goes;
/// after a crash, remove_stale_rings() finds it.
class FrameRing {
  public:
    /// Slots of at least `slot_bytes` bytes. `camera` becomes part of the name. Also removes stale rings.
    /// Throws std::runtime_error where shared memory does not suffice, std::invalid_argument for sizes
    /// outside 2…64 slots and 1 byte…1 GiB.
    FrameRing(const std::string& camera, int slots, std::size_t slot_bytes);
    ~FrameRing();
    FrameRing(const FrameRing&) = delete;
    FrameRing& operator=(const FrameRing&) = delete;

    /// "/goalmouth-UID-PID-CAMERA-RANDOM"
    const std::string& name() const { return name_; }
    int slots() const { return slots_; }
    std::size_t slot_bytes() const { return slot_bytes_; }

    /// The next slot to write a frame of `size` ≤ slot_bytes() into, page-aligned. What stood there is gone
    /// from now on. Calling it again before finish_write() gives the same slot.
    std::span<std::uint8_t> begin_write(std::size_t size);
    /// The slot is whole: readers may use it until its turn comes again.
    RingPlace finish_write();

  private:
    std::string name_;
    int fd_ = -1;
    int slots_ = 0;
    std::size_t slot_bytes_ = 0;
    std::size_t mapped_bytes_ = 0;
    RingLayout* ring_ = nullptr;
    int next_ = 0;
    std::int64_t generation_ = 0;  // the last one that was finished
};

/// One frame in a ring, read in place. Keeps the memory mapped, not the frame.
class RingFrame {
  public:
    std::span<const std::uint8_t> bytes() const { return bytes_; }
    /// Whether the bytes were this frame's from when it was opened until now.
    bool still_valid() const;

  private:
    friend class RingReader;
    std::shared_ptr<const RingLayout> ring_;
    std::span<const std::uint8_t> bytes_;
    std::size_t slot_ = 0;
    std::uint64_t generation_ = 0;
};

/// Why a frame could not be opened.
enum class RingFailure {
    none,
    gone,         // no such ring: its producer has ended, or the descriptor comes from a log
    overwritten,  // the slot holds another frame by now
    refused,      // the descriptor or the ring makes no sense
};

/// The readers' side: opens rings as descriptors name them and keeps the last few mapped.
class RingReader {
  public:
    /// The frame a descriptor refers to. Checks the ring's header, its size and the slot's generation first.
    std::optional<RingFrame> try_open(const image_t& descriptor);
    /// About the last try_open().
    RingFailure failure() const { return failure_; }

  private:
    struct Mapping {
        std::string name;
        std::shared_ptr<const RingLayout> ring;
        std::size_t slots = 0;
        std::size_t slot_bytes = 0;
    };
    const Mapping* mapped(const std::string& name);

    std::vector<Mapping> mappings_;  // the last used one last
    RingFailure failure_ = RingFailure::none;
};

/// Removes the rings of this user whose producer has died without removing them. Returns how many.
int remove_stale_rings();

}  // namespace goalmouth
