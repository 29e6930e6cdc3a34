// What must be true of V4l2Source, asked of the vivid driver inside a virtual machine. Prints one line for
// each check; exit code 0 if all hold.
#include "core/imaging/file_error.h"
#include "core/imaging/v4l2_source.h"
#include "core/imaging/yuyv.h"
#include "tests/vm/checks.h"
#include "tests/vm/controls.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace goalmouth::test {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

const std::string device = "/dev/video0";
int failures = 0;

std::vector<std::string> said;
SourceLog log() {
    return [](const std::string& what) {
        std::printf("    source says: %s\n", what.c_str());
        said.push_back(what);
    };
}

bool was_said(const std::string& part) {
    return std::any_of(said.begin(), said.end(),
                       [&](const std::string& s) { return s.find(part) != std::string::npos; });
}

V4l2Settings settings() {
    V4l2Settings s;
    s.device = device;
    s.frames_per_second = 25.0;  // the most vivid offers at 640x480
    return s;
}

/// Takes frames until `done(frame)`, at most so many seconds. False if time was up.
bool stream(V4l2Source& source, std::chrono::seconds most, const std::function<bool(const Captured&)>& done) {
    const auto deadline = Clock::now() + most;
    Captured frame;
    while (Clock::now() < deadline) {
        if (source.next(frame, 200ms) == ImageSource::Outcome::captured && done(frame)) return true;
    }
    return false;
}

bool frames(V4l2Source& source, int count) {
    return stream(source, 30s, [&](const Captured&) { return --count <= 0; });
}

void streams_frames_in_order() {
    V4l2Source source(settings(), log());
    std::vector<std::int64_t> utimes;
    std::int64_t lost = 0;
    bool sizes = true;
    stream(source, 40s, [&](const Captured& frame) {
        sizes &= frame.width == 640 && frame.height == 480 && frame.stride >= 1280 &&
                 frame.format == PixelFormat::yuyv &&
                 frame.bytes.size() >= static_cast<std::size_t>(frame.stride) * 480;
        if (!utimes.empty()) lost += frame.lost;
        utimes.push_back(frame.utime);
        return utimes.size() == 90;
    });
    expect(utimes.size() == 90, "90 frames arrive (" + std::to_string(utimes.size()) + ")");
    expect(sizes, "each is 640x480 YUYV, whole");
    if (utimes.size() < 2) return;
    bool increasing = true;
    for (std::size_t i = 1; i < utimes.size(); ++i) increasing &= utimes[i] > utimes[i - 1];
    expect(increasing, "capture times increase");
    const double periods =
        1e-6 * static_cast<double>(utimes.back() - utimes.front()) * source.frames_per_second();
    const auto numbered = static_cast<double>(static_cast<std::int64_t>(utimes.size()) - 1 + lost);
    expect(std::abs(periods - numbered) < 0.1 * numbered + 2.0,
           "capture times and the driver's numbering agree: " + std::to_string(periods) +
               " periods of time, " + std::to_string(numbered) + " numbers (" + std::to_string(lost) +
               " lost)");
    const std::int64_t now = std::chrono::duration_cast<std::chrono::microseconds>(
                                 std::chrono::system_clock::now().time_since_epoch())
                                 .count();
    // vivid stamps the end of a frame it delivers a little earlier, hence the tenth of a second.
    expect(utimes.back() <= now + 100000 && now - utimes.back() < 5000000,
           "the last capture was just now, in UTC (" + std::to_string(now - utimes.back()) + " us ago)");
    expect(source.counters().lost == lost && source.counters().damaged == 0, "counters agree");
}

void says_where_the_rate_is_another() {
    V4l2Settings s = settings();
    s.frames_per_second = 50.0;
    said.clear();
    V4l2Source source(s, log());
    expect(std::abs(source.frames_per_second() - 25.0) < 0.01 &&
               was_said("asked for 50 frames/s, the camera runs at 25 frames/s"),
           "a rate the camera does not have is said, and the nearest taken");
}

void shows_the_colour_bars() {
    Controls controls(device);
    controls.set("Test Pattern", controls.entry("Test Pattern", "100% Colorbar"));
    controls.set("OSD Text Mode", controls.entry("OSD Text Mode", "None"));
    V4l2Source source(settings(), log());
    // ITU-R BT.601 in limited range (Y 16…235), as the driver codes sRGB by default: white, yellow, cyan,
    // green, magenta, red, blue, black.
    constexpr std::array<Ycbcr, 8> bars = {{{235, 128, 128},
                                            {210, 16, 146},
                                            {170, 166, 16},
                                            {145, 54, 34},
                                            {106, 202, 222},
                                            {81, 90, 240},
                                            {41, 240, 110},
                                            {16, 128, 128}}};
    int worst = 255;
    stream(source, 20s, [&](const Captured& frame) {
        const YuyvView image{frame.bytes.data(), frame.width, frame.height, frame.stride};
        worst = 0;
        for (std::size_t i = 0; i < bars.size(); ++i) {
            const Ycbcr p = image.at(static_cast<int>(i) * 80 + 40, 240);
            worst = std::max(
                {worst, std::abs(p.y - bars[i].y), std::abs(p.cb - bars[i].cb), std::abs(p.cr - bars[i].cr)});
        }
        return worst <= 3;  // the first frames may still carry the old pattern
    });
    expect(worst <= 3, "the eight colour bars have their colours, to " + std::to_string(worst) + " levels");
}

void skips_damaged_frames() {
    V4l2Source source(settings(), log());
    frames(source, 5);
    Controls controls(device);
    controls.set("Inject V4L2_BUF_FLAG_ERROR", 1);
    const bool went_on = frames(source, 20);
    expect(went_on && source.counters().damaged >= 1, "a frame the driver marks damaged is counted (" +
                                                          std::to_string(source.counters().damaged) +
                                                          ") and skipped");
}

void counts_lost_frames() {
    V4l2Source source(settings(), log());
    frames(source, 5);
    const std::int64_t before = source.counters().lost;
    Controls controls(device);
    controls.set("Percentage of Dropped Buffers", 50);
    const bool went_on = frames(source, 40);
    controls.set("Percentage of Dropped Buffers", 0);
    const std::int64_t lost = source.counters().lost - before;
    expect(went_on && lost >= 10,
           "frames the driver drops are counted (" + std::to_string(lost) + " while 40 arrived)");
}

void survives_the_wrap_of_the_numbering() {
    Controls controls(device);
    controls.set("Wrap Sequence Number", 1);
    {
        V4l2Source source(settings(), log());
        const bool went_on = frames(source, 160);  // the driver begins 128 before the wrap
        expect(went_on && source.counters().lost < 1000,
               "the numbering runs through 2^32 (" + std::to_string(source.counters().lost) + " lost)");
    }
    controls.set("Wrap Sequence Number", 0);
}

void comes_back_after_a_disconnect() {
    V4l2Source source(settings(), log());
    frames(source, 5);
    said.clear();
    {
        Controls controls(device);
        controls.set("Disconnect", 1);
    }
    bool was_gone = false;
    const auto deadline = Clock::now() + 30s;
    Captured frame;
    int after = 0;
    while (Clock::now() < deadline && after < 10) {
        const auto outcome = source.next(frame, 200ms);
        was_gone |= !source.connected();
        if (outcome == ImageSource::Outcome::captured && source.counters().reopened > 0) ++after;
    }
    expect(was_gone && was_said("gone"), "an unplugged camera is noticed and said");
    expect(source.counters().reopened == 1 && after == 10 && was_said("back"),
           "frames come again once it is back");
}

template <class F>
std::string error_of(F f) {
    try {
        f();
    } catch (const std::exception& error) {
        return error.what();
    }
    return "";
}

void says_what_is_offered() {
    V4l2Settings s = settings();
    s.format = PixelFormat::jpeg;
    const std::string no_jpeg = error_of([&] { V4l2Source source(s, log()); });
    std::printf("    error: %.300s\n", no_jpeg.c_str());
    expect(no_jpeg.find("does not offer MJPG 640x480") != std::string::npos &&
               no_jpeg.find("YUYV") != std::string::npos && no_jpeg.find("1280x720") != std::string::npos,
           "a format the device lacks is an error that lists what it has");
    s = settings();
    s.width = 642;
    expect(error_of([&] { V4l2Source source(s, log()); }).find("does not offer YUYV 642x480") !=
               std::string::npos,
           "so is a size");
}

void says_that_the_camera_is_in_use() {
    V4l2Source source(settings(), log());
    const std::string error = error_of([&] { V4l2Source second(settings(), log()); });
    expect(error.find("another program") != std::string::npos,
           "a camera in use is named as such (" + error + ")");
    expect(frames(source, 5), "and its user is not disturbed");
}

int run() {
    for (const auto& [name, check] : std::initializer_list<std::pair<const char*, void (*)()>>{
             {"order", streams_frames_in_order},
             {"rate", says_where_the_rate_is_another},
             {"colour bars", shows_the_colour_bars},
             {"damaged", skips_damaged_frames},
             {"lost", counts_lost_frames},
             {"wrap", survives_the_wrap_of_the_numbering},
             {"offers", says_what_is_offered},
             {"in use", says_that_the_camera_is_in_use},
             {"disconnect", comes_back_after_a_disconnect},
             {"in place", driver_writes_into_the_ring},
             {"in place, disconnect", vanished_driver_leaves_the_ring_alone}}) {
        std::printf("-- %s\n", name);
        try {
            check();
        } catch (const std::exception& error) {
            expect(false, std::string(name) + ": " + error.what());
        }
    }
    return failures == 0 ? 0 : 1;
}

}  // namespace

void expect(bool holds, const std::string& what) {
    std::printf("%s: %s\n", holds ? "ok" : "FAILED", what.c_str());
    std::fflush(stdout);
    failures += !holds;
}

}  // namespace goalmouth::test

int main() {
    return goalmouth::test::run();
}
