// Listens to the camera process inside the virtual machine and checks what it sends. Prints one line for each
// check; exit code 0 if all hold.
#include "core/imaging/yuyv.h"
#include "core/messaging/channels.h"
#include "core/messaging/frame_ring.h"
#include "core/messaging/lcm_bus.h"
#include "core/messaging/typed.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include <goalmouth/camera_info_t.hpp>
#include <goalmouth/image_t.hpp>
#include <goalmouth/status_t.hpp>

using namespace goalmouth;

namespace {

int failures = 0;

void expect(bool holds, const std::string& what) {
    std::printf("%s: %s\n", holds ? "ok" : "FAILED", what.c_str());
    failures += !holds;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    LcmBus bus(argv[1]);
    RingReader reader;
    int images = 0, in_order = 0, readable = 0, infos = 0;
    std::map<std::string, double> counters;
    image_t last{};
    subscribe<image_t>(bus, channels::image, [&](const image_t& m) {
        if (images++ > 0) in_order += m.seq == last.seq + 1 && m.utime > last.utime;
        last = m;
        const auto frame = reader.try_open(m);
        if (!frame) return;
        // vivid's bars: the fourth is green, dark in both chroma.
        const YuyvView view{frame->bytes().data(), m.width, m.height, m.row_stride};
        const Ycbcr green = view.at(3 * m.width / 8 + m.width / 16, m.height / 2);
        readable +=
            frame->still_valid() && m.width == 640 && m.height == 480 && green.cb < 100 && green.cr < 100;
    });
    subscribe<camera_info_t>(bus, channels::camera_info,
                             [&](const camera_info_t& m) { infos += m.source == "/dev/video0"; });
    subscribe<status_t>(bus, channels::status, [&](const status_t& m) {
        for (const counter_t& counter : m.counters) counters[counter.name] = counter.value;
    });
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(90);
    while ((images < 50 || counters["frames_in_place"] < 20) && std::chrono::steady_clock::now() < deadline)
        bus.dispatch(std::chrono::milliseconds(200));
    expect(images >= 50, "the camera process sends images over LCM (" + std::to_string(images) + ")");
    expect(in_order == images - 1, "numbered without a gap, capture times increase");
    expect(readable > images / 2, "their pixels are read from shared memory and show the test pattern (" +
                                      std::to_string(readable) + " of " + std::to_string(images) + ")");
    expect(counters["frames_in_place"] >= 20 && counters["copied_frames"] == 0,
           "the driver wrote them there itself: " + std::to_string(counters["frames_in_place"]) +
               " in place, " + std::to_string(counters["copied_frames"]) + " copied");
    expect(infos >= 1, "CAMERA_INFO names the device");
    return failures == 0 && images >= 50 ? 0 : 1;
}
