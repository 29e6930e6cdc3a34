#include "tests/vm/controls.h"

#include "core/imaging/v4l2_device.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <linux/videodev2.h>
#include <stdexcept>
#include <unistd.h>

namespace goalmouth::test {

Controls::Controls(const std::string& device) : fd_(open(device.c_str(), O_RDWR | O_CLOEXEC)) {
    if (fd_ < 0) throw std::runtime_error(device + ": " + std::strerror(errno));
}

Controls::~Controls() {
    close(fd_);
}

unsigned Controls::id_of(const std::string& name) {
    v4l2_queryctrl control{};
    control.id = V4L2_CTRL_FLAG_NEXT_CTRL;
    std::string all;
    while (repeated_ioctl(fd_, VIDIOC_QUERYCTRL, &control) == 0) {
        const std::string found = reinterpret_cast<const char*>(control.name);
        if (found == name) return control.id;
        all += found + "; ";
        control.id |= V4L2_CTRL_FLAG_NEXT_CTRL;
    }
    throw std::runtime_error("no control \"" + name + "\" among: " + all);
}

int Controls::entry(const std::string& menu, const std::string& name) {
    v4l2_querymenu item{};
    item.id = id_of(menu);
    std::string all;
    for (; item.index < 100; ++item.index) {
        if (repeated_ioctl(fd_, VIDIOC_QUERYMENU, &item) != 0) continue;
        const std::string found = reinterpret_cast<const char*>(item.name);
        if (found == name) return static_cast<int>(item.index);
        all += found + "; ";
    }
    throw std::runtime_error("no entry \"" + name + "\" in menu " + menu + " among: " + all);
}

void Controls::set(const std::string& name, int value) {
    v4l2_control control{};
    control.id = id_of(name);
    control.value = value;
    if (repeated_ioctl(fd_, VIDIOC_S_CTRL, &control) != 0)
        throw std::runtime_error("control \"" + name + "\": " + std::strerror(errno));
}

}  // namespace goalmouth::test
