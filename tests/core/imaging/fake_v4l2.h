#pragma once

#include <cstdint>
#include <deque>
#include <linux/videodev2.h>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace goalmouth::test {

/// A camera behind system calls the test plays (the linker's --wrap). While one exists, opening `path` opens
/// it.
class FakeCamera {
  public:
    static constexpr const char* path = "/dev/fake-camera";

    FakeCamera();
    ~FakeCamera();
    FakeCamera(const FakeCamera&) = delete;
    FakeCamera& operator=(const FakeCamera&) = delete;

    /// What the next dequeue gives: a frame, or an error if `error` is not 0.
    struct Event {
        std::vector<std::uint8_t> bytes;
        std::uint32_t sequence = 0;
        std::uint32_t flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
        std::int64_t monotonic_us = 0;
        int error = 0;
    };
    std::deque<Event> events;

    std::uint32_t offered = V4L2_PIX_FMT_YUYV;  // in one size only:
    std::uint32_t width = 8;
    std::uint32_t height = 4;
    int interrupted_ioctls = 0;  // so many of the next calls end with EINTR
    int interrupted_polls = 0;
    short poll_events = 0;   // instead of POLLIN for a waiting event, where not 0
    bool unplugged = false;  // cannot be opened; an open one answers ENODEV
    bool takes_user_memory = false;
    int user_queue_error = 0;   // what queueing user memory ends with
    int user_buffers = 32;      // how many it gives at most
    int user_stream_error = 0;  // what the start of streaming into user memory ends with
    int release_error = 0;      // what giving up buffers it was given ends with: it keeps them until closed
    int least_buffers = 0;      // where not 0: how many it needs
    /// Writes into everything that is queued, as a driver may at any time until it is stopped.
    void scribble(std::uint8_t value);

    int opened = 0, closed = 0, mapped = 0, unmapped = 0;
    int queued = 0;  // buffers the driver holds
    bool streaming = false;

    /// The buffer numbers each piece of user memory came under.
    std::map<const void*, std::set<std::uint32_t>> numbers_of_memory;

    int ioctl(unsigned long request, void* argument);

  private:
    friend struct FakeCalls;
    int dequeue(v4l2_buffer& buffer);
    int queue(const v4l2_buffer& buffer);
    int fd_ = -1;
    std::uint32_t kind_ = V4L2_MEMORY_MMAP;
    std::vector<std::vector<std::uint8_t>> memory_;
    struct Queued {
        std::uint32_t index;
        std::span<std::uint8_t> memory;
    };
    std::deque<Queued> free_;
};

}  // namespace goalmouth::test
