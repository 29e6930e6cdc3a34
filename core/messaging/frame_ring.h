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

struct RingLayout;  // of the shared memory: frame_ring.cpp

/// Where a frame stands in its producer's ring: what image_t carries.
struct RingPlace {
    std::int32_t slot = 0;
    std::int64_t generation = 0;
};

/// Pixels between processes, the producer's side: a ring of slots in POSIX shared memory, one producer, any
/// number of readers that cannot write.
///
/// Nobody waits for anybody: the producer takes the slot it finished longest ago, whoever may still be
/// reading it. Each slot therefore has a generation (a sequence lock): odd while it is written, even and
/// larger than ever before once it is finished. A reader takes a frame by the generation its descriptor
/// names, uses the pixels in place, and asks still_valid() after use, before it believes the result.
///
/// Several slots may be open for writing at once, as for a driver that fills user memory: with s slots of
/// which w are open at any time, a frame stays readable until s − w more have been finished.
///
/// Against whom: other users cannot open a ring (mode 0600, and readers check its owner). A program of the
/// same user that cuts a ring's file short while it is read ends the reader with SIGBUS. Readers check the
/// size when they map it and leave it at that: a check before or after each use cannot close the gap, a
/// SIGBUS handler would have to live in every process that reads (some are not ours), sealed memory has no
/// name to open it by, and whoever could do this could as well kill the reader. Our producers never shrink a
/// ring; they make another.
///
/// The memory is gone when this object goes; after a crash, remove_stale_rings() finds it.
class FrameRing {
  public:
    /// A slot that is being written.
    struct OpenSlot {
        int slot = 0;
        std::span<std::uint8_t> bytes;  // page-aligned
    };

    static constexpr std::size_t most_slot_bytes = std::size_t{1} << 30;

    /// Slots of at least `slot_bytes` bytes, all of them allocated here and now: writing never fails later.
    /// `camera` becomes part of the name. Also removes stale rings. Throws std::runtime_error where shared
    /// memory does not suffice (without taking any), std::invalid_argument for sizes outside 2…64 slots and
    /// 1 byte…1 GiB.
    FrameRing(const std::string& camera, int slots, std::size_t slot_bytes);
    ~FrameRing();
    FrameRing(const FrameRing&) = delete;
    FrameRing& operator=(const FrameRing&) = delete;

    /// "/goalmouth-UID-PID-CAMERA-RANDOM"
    const std::string& name() const { return name_; }
    int slots() const { return static_cast<int>(states_.size()); }
    std::size_t slot_bytes() const { return slot_bytes_; }
    /// How many slots are being written.
    int open_slots() const;

    /// Opens the slot that was finished longest ago (of those never finished or abandoned, the first) for a
    /// frame of `size` ≤ slot_bytes(). What stood there is gone from now on. Whatever writes there, a device
    /// too, may begin after this returns. Throws std::logic_error where all are open.
    OpenSlot begin_write(std::size_t size);
    /// The slot is whole, nobody writes there any more: readers may use it until it is opened again. Throws
    /// std::logic_error for one that is not open.
    RingPlace finish_write(int slot);
    /// Nothing of use was written, and nobody writes there any more: no reader will see it.
    void abandon(int slot) noexcept;

  private:
    struct State {
        bool open = false;
        std::int64_t finished = 0;  // generation; 0: holds no frame
    };
    void make_segment(const std::string& camera);

    std::string name_;
    int fd_ = -1;
    std::vector<State> states_;
    std::size_t slot_bytes_ = 0;
    std::size_t mapped_bytes_ = 0;
    RingLayout* ring_ = nullptr;
    std::int64_t generation_ = 0;  // of the frame finished last
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

/// The readers' side: opens rings as descriptors name them and keeps the last few mapped. A descriptor of a
/// ring not seen before is the sign to let go of those whose producers are gone: until then their memory
/// still counts against /dev/shm.
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
    void let_go_of_the_gone();

    std::vector<Mapping> mappings_;  // the last used one last
    RingFailure failure_ = RingFailure::none;
};

/// Removes the rings of this user whose producer has died without removing them, however long ago and whoever
/// has its process number now. Returns how many.
int remove_stale_rings();

}  // namespace goalmouth
