#pragma once

#include <cstdint>
#include <linux/videodev2.h>
#include <span>
#include <string>
#include <vector>

namespace goalmouth {

/// ioctl that starts again after a signal; −1 with errno as ioctl itself.
int repeated_ioctl(int fd, unsigned long request, void* argument);

/// An open V4L2 capture device. It fills either buffers of its own, mapped here, or memory it is given. Stops
/// streaming, unmaps and closes when it goes: after close() it writes nowhere any more.
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
    /// std::runtime_error with the device, `what` and what errno says.
    [[noreturn]] void fail(const std::string& what) const;
    bool is_open() const { return fd_ >= 0; }
    int fd() const { return fd_; }
    const std::string& card() const { return card_; }

    /// Asks for a format; the value is what the driver made of it.
    v4l2_pix_format set_format(std::uint32_t fourcc, int width, int height);
    /// Asks for a rate; the value is the driver's, 0 where it has none.
    double set_rate(double frames_per_second);
    /// How many buffers have to be queued before it fills any; 0 where it does not say.
    int least_buffers() const;

    /// Maps `count` buffers of the device's own. Throws std::runtime_error.
    void map_buffers(int count);
    const Buffer& buffer(std::uint32_t index) const { return buffers_[index]; }
    std::size_t buffers() const { return buffers_.size(); }
    /// Asks for buffers whose memory comes with each queue(). How many there are; 0 with errno where it does
    /// not do that.
    int request_user_buffers(int count);

    /// Hands it a buffer to fill: its own, or this memory, page-aligned. False with errno.
    bool queue(std::uint32_t index, std::span<std::uint8_t> memory = {});
    bool start_streaming();
    /// Takes a filled buffer. False with errno.
    bool dequeue(v4l2_buffer& buffer);
    /// Stops streaming and takes all buffers away from it. False with errno where it keeps them: then it may
    /// write there until close().
    bool release_buffers();

    /// "YUYV 640x480 (30, 15 /s), 320x240 (30 /s); MJPG 640x480 (30 /s)": what the device offers.
    std::string offers() const;

  private:
    void stop();
    int request_buffers(v4l2_memory memory, int count);
    static std::string cameras_present();

    std::string path_;
    std::string card_;
    int fd_ = -1;
    bool streaming_ = false;
    v4l2_memory memory_ = V4L2_MEMORY_MMAP;
    bool has_buffers_ = false;
    std::vector<Buffer> buffers_;
};

std::string fourcc_text(std::uint32_t fourcc);

}  // namespace goalmouth
