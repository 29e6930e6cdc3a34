#include "modules/tap/tap_module.h"

#include "core/messaging/channels.h"
#include "core/messaging/clock.h"
#include "core/messaging/image_output.h"
#include "core/messaging/tap_url.h"
#include "core/messaging/typed.h"
#include "core/process/configuration.h"

#include <fmt/format.h>
#include <stdexcept>
#include <thread>

#include <spdlog/spdlog.h>

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

/// Deletes nothing: the graph's bus outlives the module.
std::shared_ptr<Bus> graph_bus(ModuleContext& context) {
    return {std::shared_ptr<Bus>{}, &context.bus};
}

std::shared_ptr<Bus> bus_for(ModuleContext& context, const TapParameters& parameters) {
    if (parameters.url == "off") {
        if (parameters.file.empty())
            throw ConfigurationError(context.name + ": url: off, and no `file`: the tap would do nothing");
        return nullptr;
    }
    if (!context.open_bus) return graph_bus(context);
    try {
        const std::string url = tap_url(context.lcm_url, parameters.url);
        if (same_traffic(url, context.lcm_url)) return graph_bus(context);
        auto bus = context.open_bus(url);
        spdlog::info(fmt::format("whole pictures{} are on {}: lcm-logger --lcm-url='{}' FILE",
                                 parameters.forward ? " and the graph's messages" : "", url, url));
        return bus;
    } catch (const std::exception& error) {
        throw ConfigurationError(context.name + ": url: " + error.what());
    }
}

std::unique_ptr<TapLog> log_for(const ModuleContext& context, const TapParameters& parameters) {
    if (parameters.file.empty()) return {};
    try {
        auto log = std::make_unique<TapLog>(
            parameters.file, parameters.slice_bytes, context.channel(channels::image_tap),
            context.channel(channels::image_slices), now_utime(), Clock::now());
        spdlog::info(fmt::format("records to {}", log->file().string()));
        return log;
    } catch (const std::runtime_error& error) {
        throw ConfigurationError(context.name + ": file: " + error.what());
    }
}

std::regex expression_of(const ModuleContext& context, const std::string& text) {
    try {
        return std::regex(text, std::regex::ECMAScript | std::regex::optimize);
    } catch (const std::regex_error&) {
        throw ConfigurationError(context.name + ": forward_channels: '" + text +
                                 "' is not a regular expression, such as .* or (POSTS|POSE)");
    }
}

}  // namespace

ModuleInfo TapModule::info() {
    return {.executable = "tap",
            .summary = "Chosen frames with their pixels, for logs: LCM messages instead of shared memory.",
            .subscribes = {{channels::image, "image_t", "each frame's descriptor"}},
            .publishes = {{channels::image_tap, "image_t",
                           "a chosen frame that fits a datagram; on the tap's own port"},
                          {channels::image_slices, "image_slice_t",
                           "a chosen frame that does not, in pieces; on the tap's own port"}}};
}

TapModule::TapModule(ModuleContext& context, const Parameters& parameters)
    : context_(context),
      parameters_(parameters),
      bus_(bus_for(context, parameters)),
      forwarded_(expression_of(context, parameters.forward_channels)),
      tap_channel_(context.channel(channels::image_tap)),
      slices_channel_(context.channel(channels::image_slices)),
      pacer_(parameters.slice_bytes),
      log_(log_for(context, parameters)),
      input_(
          context.bus, context.channel(channels::image), "", "", [this](const Frame& frame) { take(frame); },
          Delivery::every) {
    if (!parameters.forward || !(elsewhere() || log_)) return;
    context.bus.subscribe_all([this](const std::string& channel, std::span<const std::uint8_t> message) {
        forward(channel, message);
    });
}

void TapModule::forward(const std::string& channel, std::span<const std::uint8_t> message) {
    if (!std::regex_match(channel, forwarded_)) return;
    if (elsewhere()) {
        const std::int64_t before = bus_->counters().published;
        bus_->publish(channel, message);
        context_.status.count("forwarded", static_cast<double>(bus_->counters().published - before));
    }
    // What this tap sends on the graph's port stands in the log already.
    if (log_ && channel != tap_channel_ && channel != slices_channel_)
        log_->write(channel, message, Clock::now());
}

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
    if (log_) record(image);
    if (bus_) send(image);
}

void TapModule::record(const image_t& image) {
    const std::int64_t before = log_->left_out();
    log_->write(image, Clock::now());
    if (log_->left_out() > before) return;  // it took the place of one that is counted
    context_.status.count("recorded_frames");
    if (!bus_) context_.status.output(image.utime);
}

void TapModule::send(const image_t& image) {
    if (static_cast<std::size_t>(image.getEncodedSize()) <= datagram_bytes) {
        publish(*bus_, tap_channel_, image);
        context_.status.output(image.utime);
        return;
    }
    pacer_.offer(image, Clock::now());
}

/// STATUS shows by itself what happens on the graph's bus only.
void TapModule::report() {
    Status& status = context_.status;
    if (elsewhere()) {
        const BusCounters& traffic = bus_->counters();
        status.set("oversized", static_cast<double>(traffic.oversized));
        status.set("rejected", static_cast<double>(traffic.rejected_total()));
    }
    if (log_) {
        status.set("not_recorded", static_cast<double>(log_->not_written()));
        status.set("frames_not_recorded", static_cast<double>(log_->left_out()));
    }
    const std::int64_t left_out = bus_ ? pacer_.left_out() : log_->left_out();
    status.dropped(left_out - reported_left_out_);
    reported_left_out_ = left_out;
}

// A log that ends with this process should hold the last frame as well.
TapModule::~TapModule() {
    const auto stop = Clock::now() + longest_farewell;
    while (pacer_.next_due(Clock::now()) && Clock::now() < stop) tick();
    if (log_) log_->finish();
}

// Slices are a millisecond apart, which is as fine as waiting for messages gets: the distances are waited for
// here.
std::chrono::microseconds TapModule::tick() {
    if (log_) log_->catch_up(Clock::now());
    report();
    const auto stop = Clock::now() + longest_tick;
    for (;;) {
        const auto wait = pacer_.next_due(Clock::now());
        if (!wait) return std::chrono::seconds(1);
        if (Clock::now() + *wait > stop) return *wait;
        if (*wait > wait->zero()) std::this_thread::sleep_for(*wait);
        const auto slice = pacer_.due(Clock::now(), bus_->congestion());
        if (!slice) continue;
        publish(*bus_, slices_channel_, *slice);
        if (slice->slice == slice->slices - 1) context_.status.output(slice->utime);
    }
}

}  // namespace goalmouth
