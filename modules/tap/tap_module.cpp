#include "modules/tap/tap_module.h"

#include "core/messaging/channels.h"
#include "core/messaging/image_output.h"
#include "core/messaging/typed.h"

#include <thread>

namespace goalmouth {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds longest_tick{10};  // then descriptors are looked at again
constexpr std::chrono::milliseconds longest_farewell{500};

FrameInfo info_of(const Frame& frame) {
    FrameInfo info;
    info.utime = frame.utime;
    info.seq = frame.seq;
    info.intrinsics = frame.intrinsics;
    info.exposure_us = frame.exposure_us;
    info.readout_us = frame.readout_us;
    return info;
}

}  // namespace

ModuleInfo TapModule::info() {
    return {
        .executable = "tap",
        .summary = "Chosen frames with their pixels, for logs: LCM messages instead of shared memory.",
        .subscribes = {{channels::image, "image_t", "each frame's descriptor"}},
        .publishes = {{channels::image_tap, "image_t", "a chosen frame that fits a datagram"},
                      {channels::image_slices, "image_slice_t", "a chosen frame that does not, in pieces"}}};
}

TapModule::TapModule(ModuleContext& context, const Parameters& parameters)
    : context_(context),
      parameters_(parameters),
      tap_channel_(context.channel(channels::image_tap)),
      slices_channel_(context.channel(channels::image_slices)),
      pacer_(parameters.slice_bytes),
      input_(
          context.bus, context.channel(channels::image), "", "", [this](const Frame& frame) { take(frame); },
          Delivery::every) {}

void TapModule::take(const Frame& frame) {
    context_.status.dropped(frame.dropped_before);
    if (frame.seq % parameters_.every != 0) return;
    const image_t image = parameters_.encoding == "raw"
                              ? self_contained_yuyv(info_of(frame), frame.camera, frame.pixels)
                              : self_contained_jpeg(info_of(frame), frame.camera, frame.pixels,
                                                    parameters_.jpeg_quality, datagram_bytes);
    if (!frame.still_valid()) {
        context_.status.dropped(1);
        return;
    }
    if (static_cast<std::size_t>(image.getEncodedSize()) <= datagram_bytes) {
        publish(context_.bus, tap_channel_, image);
        context_.status.output(image.utime);
        return;
    }
    pacer_.offer(image, Clock::now());
    context_.status.dropped(pacer_.left_out() - reported_left_out_);
    reported_left_out_ = pacer_.left_out();
}

// A log that ends with this process should hold the last frame as well.
TapModule::~TapModule() {
    const auto stop = Clock::now() + longest_farewell;
    while (pacer_.next_due(Clock::now()) && Clock::now() < stop) tick();
}

// Slices are a millisecond apart, which is as fine as waiting for messages gets: the distances are waited for
// here.
std::chrono::microseconds TapModule::tick() {
    const auto stop = Clock::now() + longest_tick;
    for (;;) {
        const auto wait = pacer_.next_due(Clock::now());
        if (!wait) return std::chrono::seconds(1);
        if (Clock::now() + *wait > stop) return *wait;
        if (*wait > wait->zero()) std::this_thread::sleep_for(*wait);
        const auto slice = pacer_.due(Clock::now(), context_.bus.congestion());
        if (!slice) continue;
        publish(context_.bus, slices_channel_, *slice);
        if (slice->slice == slice->slices - 1) context_.status.output(slice->utime);
    }
}

}  // namespace goalmouth
