#pragma once

#include <cstdint>
#include <linux/videodev2.h>
#include <span>
#include <string>
#include <vector>

namespace goalmouth {

/// ioctl that starts again after a signal; −1 with errno as ioctl itself.
int repeated_ioctl(int fd, unsigned long request, void* argument);

/// An open V4L2 capture device that streams into buffers mapped here. Closes, unmaps and stops streaming when
/// it goes.
class V4l2Device {
  public:
    struct Buffer {
        std::uint8_t* data = nullptr;
        std::size_t length = 0;
    };

    V4l2Device() = default;
    ~V4l2Device() { close(); }
    V4l2Device(const V4l2Device&) = delete;
    V4l2Device& operator=(const V4l2Device&) = delete;

    /// Throws std::runtime_error where it cannot be opened or is not a capture device.
    void open(const std::string& path);
    void close();
    bool is_open() const { return fd_ >= 0; }
    int fd() const { return fd_; }
    const std::string& card() const { return card_; }

    /// Asks for a format; the value is what the driver made of it.
    v4l2_pix_format set_format(std::uint32_t fourcc, int width, int height);
    /// Asks for a rate; the value is the driver's, 0 where it has none.
    double set_rate(double frames_per_second);
    /// Maps `count` buffers, queues them and starts.
    void start(int count);

    /// Takes a filled buffer. False with errno.
    bool dequeue(v4l2_buffer& buffer);
    bool queue(std::uint32_t index);
    const Buffer& buffer(std::uint32_t index) const { return buffers_[index]; }
    std::size_t buffers() const { return buffers_.size(); }

    /// "YUYV 640x480 (30, 15 /s), 320x240 (30 /s); MJPG 640x480 (30 /s)": what the device offers.
    std::string offers() const;

  private:
    [[noreturn]] void fail(const std::string& what) const;
    static std::string cameras_present();

    std::string path_;
    std::string card_;
    int fd_ = -1;
    bool streaming_ = false;
    std::vector<Buffer> buffers_;
};

std::string fourcc_text(std::uint32_t fourcc);

}  // namespace goalmouth
