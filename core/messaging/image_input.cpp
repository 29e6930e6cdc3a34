#include "core/messaging/image_input.h"

#include "core/imaging/reused_memory.h"
#include "core/messaging/typed.h"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <utility>

namespace goalmouth {
namespace {

constexpr std::size_t most_cameras = 16;
// While a camera is live, self-contained frames this near to its last live one come from a tap that looks at
// the same camera.
constexpr std::int64_t live_frames = 64;
constexpr std::int64_t live_us = 2'000'000;

}  // namespace

ImageInput::ImageInput(Bus& bus, const std::string& descriptors, const std::string& tap,
                       const std::string& slices, Handler handler, Delivery which)
    : bus_(bus), handler_(std::move(handler)) {
    if (!descriptors.empty()) {
        subscribe<image_t>(
            bus, descriptors, [this, descriptors](const image_t& m) { take(descriptors, m); }, which);
    }
    if (!tap.empty()) subscribe<image_t>(bus, tap, [this, tap](const image_t& m) { take(tap, m); });
    if (!slices.empty())
        subscribe<image_slice_t>(bus, slices, [this, slices](const image_slice_t& m) { take(slices, m); });
}

bool ImageInput::is_news(const std::string& camera, Mark mark, bool self_contained) const {
    const auto found = cameras_.find(camera);
    if (found == cameras_.end()) return true;
    if (found->second.last == mark) return false;
    if (!self_contained || !found->second.live) return true;
    const Mark live = *found->second.live;
    const bool tapped =
        std::abs(mark.seq - live.seq) <= live_frames && std::abs(mark.utime - live.utime) <= live_us;
    return !tapped;
}

void ImageInput::take(const std::string& channel, const image_t& image) {
    const bool self_contained = image.ring.empty();
    if (!is_news(image.camera, {image.utime, image.seq}, self_contained)) return;
    if (self_contained) {
        hand_out(channel, image, {});
        return;
    }
    auto frame = rings_.try_open(image);
    if (frame) {
        hand_out(channel, image, std::move(frame));
        return;
    }
    switch (rings_.failure()) {
        case RingFailure::gone:
            ++frame_gone_;
            if (const auto camera = cameras_.find(image.camera); camera != cameras_.end())
                camera->second.live.reset();
            break;
        case RingFailure::overwritten:
            miss(image);
            break;
        default:
            bus_.reject(channel, "a descriptor of an impossible place");
            break;
    }
}

void ImageInput::take(const std::string& channel, const image_slice_t& slice) {
    if (!is_news(slice.camera, {slice.utime, slice.seq}, true)) return;
    const auto whole = assembler_.add(slice);
    if (!assembler_.contradiction().empty()) bus_.reject(channel, assembler_.contradiction());
    if (!whole) return;
    image_t image{};
    if (const auto cause = decode(*whole, image)) {
        bus_.reject(channel, *cause);
    } else if (!image.ring.empty() || image.utime != slice.utime || image.seq != slice.seq ||
               image.camera != slice.camera) {
        bus_.reject(channel, "slices of another image than they say");
    } else {
        take(channel, image);
    }
}

void ImageInput::miss(const image_t& descriptor) {
    ++overwritten_;
    if (missed_) missed_(descriptor);
}

/// Into decoded_. False where that is not to be had, and counted.
bool ImageInput::decode_jpeg(const std::string& channel, const image_t& image,
                             const std::optional<RingFrame>& ring_frame) {
    try {
        std::span<const std::uint8_t> jpeg(image.data);
        if (ring_frame) {
            const auto shared = ring_frame->bytes();
            fit(compressed_, shared.size());
            std::copy(shared.begin(), shared.end(), compressed_.begin());
            if (!ring_frame->still_valid()) {
                miss(image);
                return false;
            }
            jpeg = compressed_;
        }
        const auto [width, height] = decoder_.size_of(jpeg);
        if (width != image.width || height != image.height) {
            bus_.reject(channel, "a JPEG of another size than its message says");
            return false;
        }
        // What somebody has kept stays as it is.
        if (!decoded_ || decoded_.use_count() > 1 || decoded_->width != width || decoded_->height != height)
            decoded_ = std::make_shared<YuyvImage>(width, height);
        decoder_.decode(jpeg, decoded_->data);
    } catch (const std::exception&) {
        bus_.reject(channel, "a JPEG that does not decode");
        return false;
    }
    return true;
}

void ImageInput::hand_out(const std::string& channel, const image_t& image,
                          std::optional<RingFrame> ring_frame) {
    Frame frame;
    frame.live = ring_frame.has_value();
    if (image.encoding == "jpeg") {
        if (!decode_jpeg(channel, image, ring_frame)) return;
        frame.pixels = decoded_->view();
        frame.decoded = decoded_;
    } else {
        const auto bytes = ring_frame ? ring_frame->bytes() : std::span<const std::uint8_t>(image.data);
        frame.pixels = {bytes.data(), image.width, image.height, image.row_stride};
        frame.ring_frame = std::move(ring_frame);
    }
    frame.utime = image.utime;
    frame.seq = image.seq;
    frame.camera = image.camera;
    frame.intrinsics = image.intrinsics;
    frame.exposure_us = image.exposure_us;
    frame.readout_us = image.readout_us;

    const Mark mark{image.utime, image.seq};
    auto found = cameras_.find(image.camera);
    if (found != cameras_.end()) {
        if (image.seq > found->second.last.seq) frame.dropped_before = image.seq - found->second.last.seq - 1;
    } else {
        if (cameras_.size() >= most_cameras) cameras_.clear();
        found = cameras_.emplace(image.camera, Camera{}).first;
    }
    found->second.last = mark;
    found->second.live = frame.live ? std::optional<Mark>(mark) : std::nullopt;
    ++frames_;
    dropped_ += frame.dropped_before;
    handler_(frame);
}

}  // namespace goalmouth
