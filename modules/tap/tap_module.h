#pragma once

#include "core/messaging/image_input.h"
#include "core/messaging/slices.h"
#include "core/messaging/tap_log.h"
#include "core/parameters/parameters.h"
#include "core/process/module.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <regex>
#include <span>
#include <string>

namespace goalmouth {

struct TapParameters {
    std::string url = "own";
    bool forward = true;
    std::string forward_channels = ".*";
    std::string file{};
    std::string encoding = "jpeg";
    int every = 1;
    int jpeg_quality = 85;
    int slice_bytes = 32000;
};

template <class Visitor>
void describe_parameters(Visitor& v, TapParameters& p) {
    v("url", p.url, Text{},
      "where to publish: own = the graph's group on the graph's port + 1000; graph = the graph's own port; "
      "off = nowhere; or an LCM URL");
    v("forward", p.forward, "send the graph's messages there too, so that one log holds all");
    v("forward_channels", p.forward_channels, Text{},
      "which: a regular expression for the whole name of a channel");
    v("file", p.file, File{.may_be_empty = true},
      "an LCM log that the tap writes itself, with pictures and forwarded messages; \"\" = none");
    v("encoding", p.encoding, Choice{"jpeg", "raw"},
      "jpeg: for people to look at, one datagram an image; raw: exact, for replay");
    v("every", p.every, Range{1, 1000000}, "frames",
      "one frame of so many is sent, those whose number it divides");
    v("jpeg_quality", p.jpeg_quality, Range{1, 100}, "1", "lowered for images that would not fit a datagram");
    v("slice_bytes", p.slice_bytes, Range{1000, 65000}, "bytes", "image data of one slice");
}

/// Publishes chosen frames with their pixels, for logs and for programs that cannot read the shared memory:
/// on a port of its own, so that nobody else gets megabytes he did not ask for, and with the graph's messages
/// beside them.
class TapModule : public Module {
  public:
    using Parameters = TapParameters;

    static ModuleInfo info();
    TapModule(ModuleContext& context, const Parameters& parameters);
    /// Sends what is left of the frames it has begun or that wait.
    ~TapModule() override;

    /// Sends the slices that are due.
    std::chrono::microseconds tick() override;

  private:
    void take(const Frame& frame);
    void forward(const std::string& channel, std::span<const std::uint8_t> message);
    void send(const image_t& image);
    void record(const image_t& image);
    void report();
    bool elsewhere() const { return bus_ && bus_.get() != &context_.bus; }

    ModuleContext& context_;
    Parameters parameters_;
    std::shared_ptr<Bus> bus_;  // to publish on; may be the graph's, or none
    std::regex forwarded_;
    std::string tap_channel_;
    std::string slices_channel_;
    SlicePacer pacer_;
    std::unique_ptr<TapLog> log_;
    std::int64_t reported_left_out_ = 0;
    ImageInput input_;
};

}  // namespace goalmouth
