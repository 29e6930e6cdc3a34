#include "core/imaging/v4l2_device.h"

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <system_error>
#include <unistd.h>

namespace goalmouth {

namespace {

std::string rates_text(int fd, std::uint32_t fourcc, std::uint32_t width, std::uint32_t height) {
    std::string text;
    v4l2_frmivalenum interval{};
    interval.pixel_format = fourcc;
    interval.width = width;
    interval.height = height;
    for (; repeated_ioctl(fd, VIDIOC_ENUM_FRAMEINTERVALS, &interval) == 0; ++interval.index) {
        if (interval.type != V4L2_FRMIVAL_TYPE_DISCRETE) return text.empty() ? "any rate" : text;
        if (interval.discrete.numerator == 0) continue;
        char rate[32];
        std::snprintf(
            rate, sizeof rate, "%s%g", text.empty() ? "" : ", ",
            std::round(100.0 * interval.discrete.denominator / interval.discrete.numerator) / 100.0);
        text += rate;
    }
    return text.empty() ? "" : text + " /s";
}

std::string size_text(std::uint32_t width, std::uint32_t height) {
    return std::to_string(width) + "x" + std::to_string(height);
}

std::string sizes_text(int fd, std::uint32_t fourcc) {
    std::string text;
    v4l2_frmsizeenum size{};
    size.pixel_format = fourcc;
    for (; repeated_ioctl(fd, VIDIOC_ENUM_FRAMESIZES, &size) == 0; ++size.index) {
        if (size.type != V4L2_FRMSIZE_TYPE_DISCRETE) {
            return size_text(size.stepwise.min_width, size.stepwise.min_height) + " to " +
                   size_text(size.stepwise.max_width, size.stepwise.max_height);
        }
        if (!text.empty()) text += ", ";
        text += size_text(size.discrete.width, size.discrete.height);
        const std::string rates = rates_text(fd, fourcc, size.discrete.width, size.discrete.height);
        if (!rates.empty()) text.append(" (").append(rates).append(")");
    }
    return text;
}

}  // namespace

int repeated_ioctl(int fd, unsigned long request, void* argument) {
    int result = 0;
    do {
        result = ioctl(fd, request, argument);
    } while (result < 0 && errno == EINTR);
    return result;
}

std::string fourcc_text(std::uint32_t fourcc) {
    std::string text;
    for (int shift = 0; shift < 32; shift += 8) {
        const auto letter = static_cast<char>((fourcc >> shift) & 0x7f);
        text += letter > ' ' ? letter : ' ';
    }
    text.erase(text.find_last_not_of(' ') + 1);
    return text;
}

/// For whoever named a camera that is not there. Keeps errno.
std::string V4l2Device::cameras_present() {
    const int kept = errno;
    std::set<std::string> present;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator("/dev", ignored)) {
        if (entry.path().filename().string().starts_with("video")) present.insert(entry.path().string());
    }
    std::string text;
    for (const std::string& name : present) text += (text.empty() ? "" : ", ") + name;
    errno = kept;
    return text.empty() ? " (no camera is connected: there is no /dev/video*)" : " (there is: " + text + ")";
}

void V4l2Device::fail(const std::string& what) const {
    const int error = errno;
    throw std::runtime_error(path_ + ": " + what + ": " + std::strerror(error) +
                             (error == EBUSY ? " (another program uses the camera)" : ""));
}

void V4l2Device::open(const std::string& path) {
    close();
    path_ = path;
    fd_ = ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    if (fd_ < 0) fail("cannot be opened" + (errno == ENOENT ? cameras_present() : ""));
    v4l2_capability capability{};
    if (repeated_ioctl(fd_, VIDIOC_QUERYCAP, &capability) < 0) {
        const int error = errno;
        close();
        errno = error;
        fail("not a video device");
    }
    card_ = reinterpret_cast<const char*>(capability.card);
    const std::uint32_t can = (capability.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? capability.device_caps
                                                                                    : capability.capabilities;
    if ((can & V4L2_CAP_VIDEO_CAPTURE) == 0 || (can & V4L2_CAP_STREAMING) == 0) {
        close();
        throw std::runtime_error(path + ": \"" + card_ + "\" does not stream captured video");
    }
}

void V4l2Device::close() {
    if (fd_ < 0) return;
    stop();
    ::close(fd_);
    fd_ = -1;
    has_buffers_ = false;
}

void V4l2Device::stop() {
    if (streaming_) {
        int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
        repeated_ioctl(fd_, VIDIOC_STREAMOFF, &type);
        streaming_ = false;
    }
    for (const Buffer& buffer : buffers_) munmap(buffer.data, buffer.length);
    buffers_.clear();
}

v4l2_pix_format V4l2Device::set_format(std::uint32_t fourcc, int width, int height) {
    v4l2_format format{};
    format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    format.fmt.pix.pixelformat = fourcc;
    format.fmt.pix.width = static_cast<std::uint32_t>(width);
    format.fmt.pix.height = static_cast<std::uint32_t>(height);
    format.fmt.pix.field = V4L2_FIELD_NONE;
    // Some drivers refuse what they do not offer, most put the nearest in its place: both end as "not what
    // was asked for".
    if (repeated_ioctl(fd_, VIDIOC_S_FMT, &format) < 0) {
        if (errno != EINVAL) fail("cannot set the image format");
        return {};
    }
    return format.fmt.pix;
}

double V4l2Device::set_rate(double frames_per_second) {
    v4l2_streamparm parameters{};
    parameters.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (frames_per_second > 0.0) {
        parameters.parm.capture.timeperframe.numerator = 1000;
        parameters.parm.capture.timeperframe.denominator =
            static_cast<std::uint32_t>(std::lround(1000.0 * frames_per_second));
        if (repeated_ioctl(fd_, VIDIOC_S_PARM, &parameters) < 0) return 0.0;
    } else if (repeated_ioctl(fd_, VIDIOC_G_PARM, &parameters) < 0) {
        return 0.0;
    }
    const v4l2_fract& interval = parameters.parm.capture.timeperframe;
    return interval.numerator > 0 ? static_cast<double>(interval.denominator) / interval.numerator : 0.0;
}

int V4l2Device::least_buffers() const {
    v4l2_control control{};
    control.id = V4L2_CID_MIN_BUFFERS_FOR_CAPTURE;
    return repeated_ioctl(fd_, VIDIOC_G_CTRL, &control) == 0 ? control.value : 0;
}

/// How many were given; −1 with errno.
int V4l2Device::request_buffers(v4l2_memory memory, int count) {
    v4l2_requestbuffers request{};
    request.count = static_cast<std::uint32_t>(count);
    request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    request.memory = memory;
    if (repeated_ioctl(fd_, VIDIOC_REQBUFS, &request) < 0) return -1;
    memory_ = memory;
    has_buffers_ = request.count > 0;
    return static_cast<int>(request.count);
}

int V4l2Device::request_user_buffers(int count) {
    return std::max(0, request_buffers(V4L2_MEMORY_USERPTR, count));
}

void V4l2Device::map_buffers(int count) {
    const int given = request_buffers(V4L2_MEMORY_MMAP, count);
    if (given < 0) fail("gives no buffers");
    if (given < 2) throw std::runtime_error(path_ + ": gives fewer than two buffers");
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(given); ++i) {
        v4l2_buffer buffer{};
        buffer.index = i;
        buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
        buffer.memory = V4L2_MEMORY_MMAP;
        if (repeated_ioctl(fd_, VIDIOC_QUERYBUF, &buffer) < 0) fail("cannot describe its buffers");
        void* memory = mmap(nullptr, buffer.length, PROT_READ | PROT_WRITE, MAP_SHARED, fd_, buffer.m.offset);
        if (memory == MAP_FAILED) fail("cannot map its buffers");
        buffers_.push_back({static_cast<std::uint8_t*>(memory), buffer.length});
    }
}

bool V4l2Device::start_streaming() {
    int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    streaming_ = repeated_ioctl(fd_, VIDIOC_STREAMON, &type) == 0;
    return streaming_;
}

bool V4l2Device::dequeue(v4l2_buffer& buffer) {
    buffer = {};
    buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    buffer.memory = memory_;
    return repeated_ioctl(fd_, VIDIOC_DQBUF, &buffer) == 0;
}

bool V4l2Device::queue(std::uint32_t index, std::span<std::uint8_t> memory) {
    v4l2_buffer buffer{};
    buffer.index = index;
    buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    buffer.memory = memory_;
    if (memory_ == V4L2_MEMORY_USERPTR) {
        buffer.m.userptr = reinterpret_cast<unsigned long>(memory.data());
        buffer.length = static_cast<std::uint32_t>(memory.size());
    }
    return repeated_ioctl(fd_, VIDIOC_QBUF, &buffer) == 0;
}

bool V4l2Device::release_buffers() {
    stop();
    return !has_buffers_ || request_buffers(memory_, 0) == 0;
}

std::string V4l2Device::offers() const {
    std::string text;
    v4l2_fmtdesc description{};
    description.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    for (; repeated_ioctl(fd_, VIDIOC_ENUM_FMT, &description) == 0; ++description.index) {
        if (!text.empty()) text += "; ";
        text.append(fourcc_text(description.pixelformat))
            .append(" ")
            .append(sizes_text(fd_, description.pixelformat));
    }
    return text.empty() ? "nothing" : text;
}

}  // namespace goalmouth
