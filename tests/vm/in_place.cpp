// What must be true of frames that the driver writes straight into a ring of shared memory.
#include "core/imaging/v4l2_source.h"
#include "core/imaging/yuyv.h"
#include "core/messaging/frame_ring.h"
#include "tests/vm/checks.h"
#include "tests/vm/controls.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace goalmouth::test {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

const std::string device = "/dev/video0";
constexpr int slots = 10;
constexpr std::size_t slot_bytes = 640 * 480 * 2;

/// A ring as a source writes into it.
class RingMemory : public FrameMemory {
  public:
    FrameSlot open(std::size_t bytes) override {
        const auto [slot, memory] = ring.begin_write(bytes);
        return {*this, slot, memory};
    }
    int slots() const override { return ring.slots(); }
    image_t announce(FrameSlot slot) {
        const RingPlace place = ring.finish_write(slot.take());
        image_t m{};
        m.ring = ring.name();
        m.slot = place.slot;
        m.generation = place.generation;
        m.size = static_cast<std::int32_t>(slot_bytes);
        return m;
    }
    FrameRing ring{"vm", test::slots, slot_bytes};

  private:
    void abandon(int number) noexcept override { ring.abandon(number); }
};

V4l2Settings settings() {
    V4l2Settings s;
    s.device = device;
    s.frames_per_second = 25.0;
    return s;
}

SourceLog log() {
    return [](const std::string& what) { std::printf("    source says: %s\n", what.c_str()); };
}

/// Where the bars begin: the white one right of the black one.
std::optional<int> shift_of(const YuyvView& image) {
    const auto luma = [&](int x) { return image.at(x % image.width, image.height / 2).y; };
    for (int x = 0; x < image.width; ++x) {
        if (luma(x) < 40 && luma(x + 1) > 200) return (x + 1) % image.width;
    }
    return {};
}

struct Seen {
    std::int64_t number = 0;  // the driver's
    int shift = 0;
};

/// The picture moves by the same distance from each frame to the next: so many columns a number, if so.
std::optional<int> steady_step(const std::vector<Seen>& frames) {
    for (int step = 1; step < 640; ++step) {
        const bool fits = std::all_of(frames.begin(), frames.end(), [&](const Seen& f) {
            const std::int64_t moved = (f.number - frames.front().number) * step;
            return (frames.front().shift + moved) % 640 == f.shift;
        });
        if (fits) return step;
    }
    return {};
}

}  // namespace

void driver_writes_into_the_ring() {
    Controls controls(device);
    controls.set("Test Pattern", controls.entry("Test Pattern", "100% Colorbar"));
    controls.set("OSD Text Mode", controls.entry("OSD Text Mode", "None"));
    controls.set("Horizontal Movement", controls.entry("Horizontal Movement", "Move Right"));
    RingMemory memory;
    {
        V4l2Source source(settings(), log(), &memory);
        expect(source.in_place(), "the driver takes the slots of the ring as its buffers");
        expect(memory.ring.open_slots() == 4, "four of them are being written");
        RingReader reader;
        std::vector<Seen> frames;
        std::set<int> used;
        int in_slots = 0, read = 0;
        std::int64_t number = 0;
        Captured frame;
        const auto deadline = Clock::now() + 60s;
        while (frames.size() < 60 && Clock::now() < deadline) {
            if (source.next(frame, 200ms) != ImageSource::Outcome::captured) continue;
            number += frame.lost + 1;
            in_slots += frame.slot && frame.bytes.data() == frame.slot.bytes().data();
            if (!frame.slot) break;
            used.insert(frame.slot.number());
            const auto seen = reader.try_open(memory.announce(std::move(frame.slot)));
            if (!seen) continue;
            const auto shift = shift_of({seen->bytes().data(), 640, 480, frame.stride});
            read += seen->still_valid() && shift;
            frames.push_back({number, shift.value_or(-1)});
        }
        expect(frames.size() == 60 && in_slots == 60,
               "60 frames came in slots, copied by nobody (" + std::to_string(in_slots) + ")");
        expect(read == 60, "a reader sees the test pattern in place in each (" + std::to_string(read) + ")");
        expect(used.size() == slots, "each slot has its turn");
        const auto step = frames.empty() ? std::nullopt : steady_step(frames);
        expect(step && *step > 0,
               "the moving pattern goes on from frame to frame: each slot holds the frame it "
               "is said to hold (" +
                   std::to_string(step.value_or(0)) + " columns a frame)");
    }
    expect(memory.ring.open_slots() == 0, "no slot stays open after the source");
    controls.set("Horizontal Movement", controls.entry("Horizontal Movement", "No Movement"));
}

void vanished_driver_leaves_the_ring_alone() {
    RingMemory memory;
    V4l2Source source(settings(), log(), &memory);
    Captured frame;
    const auto deadline = Clock::now() + 60s;
    for (int i = 0; i < 5 && Clock::now() < deadline;)
        i += source.next(frame, 200ms) == ImageSource::Outcome::captured;
    frame = {};
    {
        Controls controls(device);
        controls.set("Disconnect", 1);
    }
    while (source.connected() && Clock::now() < deadline) source.next(frame, 200ms);
    expect(!source.connected() && memory.ring.open_slots() == 0,
           "a camera that vanished leaves no slot open");
    std::vector<FrameRing::OpenSlot> all;
    for (int i = 0; i < slots; ++i) {
        all.push_back(memory.ring.begin_write(slot_bytes));
        std::fill(all.back().bytes.begin(), all.back().bytes.end(), std::uint8_t{0x5a});
    }
    std::this_thread::sleep_for(300ms);  // seven frames
    expect(std::all_of(all.begin(), all.end(),
                       [](const FrameRing::OpenSlot& slot) {
                           return std::all_of(slot.bytes.begin(), slot.bytes.end(),
                                              [](std::uint8_t b) { return b == 0x5a; });
                       }),
           "and writes into none any more");
    for (const auto& slot : all) memory.ring.abandon(slot.slot);
    int after = 0;
    while (after < 10 && Clock::now() < deadline)
        after += source.next(frame, 200ms) == ImageSource::Outcome::captured && frame.slot;
    expect(after == 10 && source.in_place(), "once it is back, its frames are in the ring again");
}

}  // namespace goalmouth::test
