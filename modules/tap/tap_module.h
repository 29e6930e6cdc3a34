#pragma once

#include "core/messaging/image_input.h"
#include "core/messaging/slices.h"
#include "core/parameters/parameters.h"
#include "core/process/module.h"

#include <chrono>
#include <cstdint>
#include <string>

namespace goalmouth {

struct TapParameters {
    std::string encoding = "jpeg";
    int every = 1;
    int jpeg_quality = 85;
    int slice_bytes = 32000;
};

template <class Visitor>
void describe_parameters(Visitor& v, TapParameters& p) {
    v("encoding", p.encoding, Choice{"jpeg", "raw"},
      "jpeg: for people to look at, one datagram an image; raw: exact, for replay");
    v("every", p.every, Range{1, 1000000}, "frames",
      "one frame of so many is sent, those whose number it divides");
    v("jpeg_quality", p.jpeg_quality, Range{1, 100}, "1", "lowered for images that would not fit a datagram");
    v("slice_bytes", p.slice_bytes, Range{1000, 65000}, "bytes", "image data of one slice");
}

/// Publishes chosen frames with their pixels, for logs and for programs that cannot read the shared memory.
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

    ModuleContext& context_;
    Parameters parameters_;
    std::string tap_channel_;
    std::string slices_channel_;
    SlicePacer pacer_;
    std::int64_t reported_left_out_ = 0;
    ImageInput input_;
};

}  // namespace goalmouth
