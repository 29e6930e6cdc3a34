#include "tests/core/imaging/fake_v4l2.h"

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/mman.h>

namespace goalmouth::test {

namespace {
FakeCamera* camera = nullptr;
}

FakeCamera::FakeCamera() {
    camera = this;
}
FakeCamera::~FakeCamera() {
    camera = nullptr;
}

int FakeCamera::dequeue(v4l2_buffer& buffer) {
    if (events.empty()) return EAGAIN;
    const Event event = events.front();
    events.pop_front();
    if (event.error != 0) return event.error;
    if (free_.empty()) return EAGAIN;
    buffer.index = free_.front().index;
    const auto memory = free_.front().memory;
    free_.pop_front();
    --queued;
    std::copy_n(event.bytes.begin(), std::min(event.bytes.size(), memory.size()), memory.begin());
    buffer.bytesused = static_cast<std::uint32_t>(event.bytes.size());
    buffer.sequence = event.sequence;
    buffer.flags = event.flags;
    buffer.timestamp.tv_sec = event.monotonic_us / 1000000;
    buffer.timestamp.tv_usec = event.monotonic_us % 1000000;
    return 0;
}

int FakeCamera::queue(const v4l2_buffer& buffer) {
    if (buffer.memory == V4L2_MEMORY_USERPTR) {
        if (user_queue_error != 0) return user_queue_error;
        auto* memory = reinterpret_cast<std::uint8_t*>(buffer.m.userptr);
        numbers_of_memory[memory].insert(buffer.index);
        free_.push_back({buffer.index, {memory, buffer.length}});
    } else {
        free_.push_back({buffer.index, memory_[buffer.index]});
    }
    ++queued;
    return 0;
}

void FakeCamera::scribble(std::uint8_t value) {
    for (const Queued& buffer : free_) std::fill(buffer.memory.begin(), buffer.memory.end(), value);
}

int FakeCamera::ioctl(unsigned long request, void* argument) {
    if (interrupted_ioctls > 0) {
        --interrupted_ioctls;
        return EINTR;
    }
    if (unplugged) return ENODEV;
    switch (request) {
        case VIDIOC_QUERYCAP: {
            auto& capability = *static_cast<v4l2_capability*>(argument);
            std::strcpy(reinterpret_cast<char*>(capability.card), "fake");
            capability.capabilities = V4L2_CAP_DEVICE_CAPS;
            capability.device_caps = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
            return 0;
        }
        case VIDIOC_ENUM_FMT: {
            auto& description = *static_cast<v4l2_fmtdesc*>(argument);
            if (description.index > 0) return EINVAL;
            description.pixelformat = offered;
            return 0;
        }
        case VIDIOC_ENUM_FRAMESIZES: {
            auto& size = *static_cast<v4l2_frmsizeenum*>(argument);
            if (size.index > 0) return EINVAL;
            size.type = V4L2_FRMSIZE_TYPE_DISCRETE;
            size.discrete.width = width;
            size.discrete.height = height;
            return 0;
        }
        case VIDIOC_S_FMT: {
            auto& format = static_cast<v4l2_format*>(argument)->fmt.pix;
            format.pixelformat = offered;
            format.width = width;
            format.height = height;
            format.field = V4L2_FIELD_NONE;
            format.bytesperline = offered == V4L2_PIX_FMT_YUYV ? 2 * width : 0;
            return 0;
        }
        case VIDIOC_S_PARM:
            return 0;
        case VIDIOC_REQBUFS: {
            auto& wanted = *static_cast<v4l2_requestbuffers*>(argument);
            if (release_error != 0 && !free_.empty()) return release_error;
            if (wanted.memory == V4L2_MEMORY_USERPTR) {
                if (!takes_user_memory) return EINVAL;
                wanted.count = std::min(wanted.count, static_cast<std::uint32_t>(user_buffers));
            }
            if (wanted.count == 0) {
                free_.clear();
                queued = 0;
            }
            kind_ = wanted.memory;
            memory_.assign(wanted.count, std::vector<std::uint8_t>(4096));
            return 0;
        }
        case VIDIOC_QUERYBUF: {
            auto& buffer = *static_cast<v4l2_buffer*>(argument);
            buffer.length = 4096;
            buffer.m.offset = buffer.index * 4096;
            return 0;
        }
        case VIDIOC_QBUF:
            return queue(*static_cast<v4l2_buffer*>(argument));
        case VIDIOC_DQBUF:
            return dequeue(*static_cast<v4l2_buffer*>(argument));
        case VIDIOC_G_CTRL: {
            auto& control = *static_cast<v4l2_control*>(argument);
            if (control.id != V4L2_CID_MIN_BUFFERS_FOR_CAPTURE || least_buffers == 0) return EINVAL;
            control.value = least_buffers;
            return 0;
        }
        case VIDIOC_STREAMON:
            if (kind_ == V4L2_MEMORY_USERPTR && user_stream_error != 0) return user_stream_error;
            streaming = true;
            return 0;
        case VIDIOC_STREAMOFF:
            streaming = false;
            free_.clear();
            queued = 0;
            return 0;
        default:
            return EINVAL;
    }
}

struct FakeCalls {
    static bool is(int fd) { return camera != nullptr && fd >= 0 && fd == camera->fd_; }
    static int open() {
        if (camera->unplugged) {
            errno = ENOENT;
            return -1;
        }
        ++camera->opened;
        camera->queued = 0;
        camera->free_.clear();
        return camera->fd_ = eventfd(0, EFD_CLOEXEC);
    }
    static void closed() {
        ++camera->closed;
        camera->fd_ = -1;
        camera->free_.clear();
    }
    static void* map(off_t offset) {
        ++camera->mapped;
        return camera->memory_[static_cast<std::size_t>(offset / 4096)].data();
    }
    static bool unmap(const void* address) {
        if (camera == nullptr) return false;
        for (const auto& memory : camera->memory_) {
            if (memory.data() != address) continue;
            ++camera->unmapped;
            return true;
        }
        return false;
    }
    static int poll(pollfd& waiting, int timeout) {
        if (camera->interrupted_polls > 0) {
            --camera->interrupted_polls;
            errno = EINTR;
            return -1;
        }
        waiting.revents = 0;
        if (camera->unplugged)
            waiting.revents = POLLERR | POLLHUP;
        else if (camera->poll_events != 0)
            waiting.revents = camera->poll_events;
        else if (!camera->events.empty())
            waiting.revents = POLLIN;
        if (waiting.revents == 0 && timeout < 0) std::abort();  // a wait for ever would hang the test
        return waiting.revents != 0 ? 1 : 0;
    }
};

}  // namespace goalmouth::test

// The names are the linker's: a call of open() becomes one of __wrap_open(), and __real_open() is the
// system's. NOLINTBEGIN(bugprone-reserved-identifier)
extern "C" {

int __real_open(const char* path, int flags, ...);
int __real_close(int fd);
int __real_ioctl(int fd, unsigned long request, ...);
int __real_poll(pollfd* fds, nfds_t count, int timeout);
void* __real_mmap(void* address, size_t length, int protection, int flags, int fd, off_t offset);
int __real_munmap(void* address, size_t length);

using goalmouth::test::FakeCalls;
using goalmouth::test::FakeCamera;

int __wrap_open(const char* path, int flags, ...) {
    if (goalmouth::test::camera != nullptr && std::strcmp(path, FakeCamera::path) == 0)
        return FakeCalls::open();
    va_list more;
    va_start(more, flags);
    const mode_t mode = (flags & O_CREAT) != 0 ? static_cast<mode_t>(va_arg(more, int)) : 0;
    va_end(more);
    return __real_open(path, flags, mode);
}

int __wrap_close(int fd) {
    if (FakeCalls::is(fd)) FakeCalls::closed();
    return __real_close(fd);
}

int __wrap_ioctl(int fd, unsigned long request, ...) {
    va_list more;
    va_start(more, request);
    void* argument = va_arg(more, void*);
    va_end(more);
    if (!FakeCalls::is(fd)) return __real_ioctl(fd, request, argument);
    const int error = goalmouth::test::camera->ioctl(request, argument);
    errno = error;
    return error == 0 ? 0 : -1;
}

int __wrap_poll(pollfd* fds, nfds_t count, int timeout) {
    if (count == 1 && FakeCalls::is(fds[0].fd)) return FakeCalls::poll(fds[0], timeout);
    return __real_poll(fds, count, timeout);
}

void* __wrap_mmap(void* address, size_t length, int protection, int flags, int fd, off_t offset) {
    if (FakeCalls::is(fd)) return FakeCalls::map(offset);
    return __real_mmap(address, length, protection, flags, fd, offset);
}

int __wrap_munmap(void* address, size_t length) {
    if (FakeCalls::unmap(address)) return 0;
    return __real_munmap(address, length);
}
}
// NOLINTEND(bugprone-reserved-identifier)
