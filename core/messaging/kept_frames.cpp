#include "core/messaging/kept_frames.h"

#include "core/imaging/reused_memory.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace goalmouth {
namespace {

bool same(const intrinsics_t& a, const intrinsics_t& b) {
    return a.width == b.width && a.height == b.height && a.fx == b.fx && a.fy == b.fy && a.cx == b.cx &&
           a.cy == b.cy &&
           std::equal(std::begin(a.distortion), std::end(a.distortion), std::begin(b.distortion));
}

}  // namespace

void KeptFrames::keep(const Frame& frame) {
    Kept kept;
    if (frames_.size() >= most_ && !frames_.empty()) {
        kept.pixels = std::move(frames_.front().pixels);
        frames_.pop_front();
    }
    kept.frame = frame;
    if (frame.ring_frame || frame.decoded) {
        kept.pixels = {};
    } else {
        const YuyvView& from = frame.pixels;
        const auto row = static_cast<std::size_t>(yuyv_row_bytes(from.width));
        fit(kept.pixels, row * static_cast<std::size_t>(from.height));
        for (int y = 0; y < from.height; ++y)
            std::copy_n(from.row(y), row, kept.pixels.data() + row * static_cast<std::size_t>(y));
        kept.frame.pixels = {kept.pixels.data(), from.width, from.height, static_cast<int>(row)};
    }
    frames_.push_back(std::move(kept));
}

const Frame* KeptFrames::find(std::int64_t utime, std::int64_t seq, const intrinsics_t& intrinsics) const {
    const auto found = std::find_if(frames_.rbegin(), frames_.rend(), [&](const Kept& kept) {
        return kept.frame.utime == utime && kept.frame.seq == seq && same(kept.frame.intrinsics, intrinsics);
    });
    return found == frames_.rend() ? nullptr : &found->frame;
}

}  // namespace goalmouth
