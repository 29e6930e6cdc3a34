#include "core/messaging/slices.h"

#include <algorithm>
#include <stdexcept>

namespace goalmouth {
namespace {

using std::chrono::microseconds;

constexpr microseconds usual_interval{33'333};  // until two images are known …
constexpr double bytes_per_microsecond = 10.0;  // … and no faster than this: 20 ms of it fill a stock buffer
constexpr microseconds shortest_interval{2'000};
constexpr microseconds longest_interval{200'000};  // a lone image need not dawdle
constexpr double share_of_interval = 0.9;          // the rest is for the sender's own delays

constexpr std::size_t most_waiting =
    8;  // images besides the one being sent: a quarter of a second, 5 MB of raw 640×480
constexpr double crowded = 0.5;  // fill of a listener's buffer from which on it is waited for
constexpr microseconds hold{500};
constexpr std::chrono::milliseconds patience{50};
constexpr std::chrono::seconds impatience{1};

constexpr std::size_t images_of_a_camera = 2;
constexpr std::size_t images_in_all = 8;
constexpr std::size_t most_reserved = std::size_t{16} << 20;

microseconds guessed_interval(std::size_t bytes) {
    const microseconds gentle(static_cast<std::int64_t>(static_cast<double>(bytes) / bytes_per_microsecond));
    return std::clamp(gentle, usual_interval, longest_interval);
}

}  // namespace

SlicePacer::SlicePacer(int slice_bytes) : slice_bytes_(static_cast<std::size_t>(slice_bytes)) {
    if (slice_bytes < 1000 || slice_bytes > 65000)
        throw std::invalid_argument("a slice has 1000 to 65000 bytes");
}

std::int32_t SlicePacer::slices(const Encoded& image) const {
    return static_cast<std::int32_t>((image.bytes.size() + slice_bytes_ - 1) / slice_bytes_);
}

microseconds SlicePacer::gap(const Encoded& image) const {
    return std::chrono::duration_cast<microseconds>(image.interval * share_of_interval) / slices(image);
}

SlicePacer::Time SlicePacer::end_of(const Encoded& image) const {
    return image.start + slices(image) * gap(image);
}

/// The rest of an image that was begun before it was known how fast they come.
void SlicePacer::hurry_up_to(microseconds interval) {
    Encoded& image = images_.front();
    if (image.interval_known || image.interval <= interval) return;
    const microseconds gone = next_slice_ * gap(image);
    image.interval = interval;
    image.interval_known = true;
    image.start += gone - next_slice_ * gap(image);
}

void SlicePacer::offer(const image_t& self_contained, Time now) {
    Encoded image;
    image.utime = self_contained.utime;
    image.seq = self_contained.seq;
    image.camera = self_contained.camera;
    image.bytes.resize(static_cast<std::size_t>(self_contained.getEncodedSize()));
    self_contained.encode(image.bytes.data(), 0, static_cast<int>(image.bytes.size()));
    image.interval_known = last_utime_ && self_contained.utime > *last_utime_;
    if (image.interval_known) {
        image.interval = std::clamp(microseconds(self_contained.utime - *last_utime_), shortest_interval,
                                    longest_interval);
        if (!images_.empty()) hurry_up_to(image.interval);
    } else {
        image.interval = guessed_interval(image.bytes.size());
    }
    last_utime_ = self_contained.utime;
    if (images_.size() == 1 + most_waiting) {
        images_.pop_back();
        ++left_out_;
    }
    // After the pop: what is left out keeps no time to send it in.
    image.start = images_.empty() ? now : std::max(now, end_of(images_.back()));
    images_.push_back(std::move(image));
}

/// By the schedule of its image; late ones follow each other at half the regular distance at least.
SlicePacer::Time SlicePacer::time_of_next() const {
    const Encoded& image = images_.front();
    const microseconds distance = gap(image);
    return std::max({image.start + next_slice_ * distance, last_sent_ + distance / 2, held_until_});
}

bool SlicePacer::waits_for_listeners(Time now, double congestion) {
    if (congestion < crowded || now < impatient_until_) {
        holding_ = false;
        return false;
    }
    if (!holding_) patience_until_ = now + patience;
    holding_ = now < patience_until_;
    if (!holding_) impatient_until_ = now + impatience;
    if (holding_) held_until_ = now + hold;
    return holding_;
}

std::optional<microseconds> SlicePacer::next_due(Time now) const {
    if (images_.empty()) return {};
    return std::max(microseconds(0), std::chrono::ceil<microseconds>(time_of_next() - now));
}

std::optional<image_slice_t> SlicePacer::due(Time now, double congestion) {
    if (images_.empty() || time_of_next() > now || waits_for_listeners(now, congestion)) return {};
    Encoded& image = images_.front();
    image_slice_t slice{};
    slice.utime = image.utime;
    slice.seq = image.seq;
    slice.camera = image.camera;
    slice.slice = next_slice_;
    slice.slices = slices(image);
    const std::size_t offset = static_cast<std::size_t>(next_slice_) * slice_bytes_;
    const std::size_t size = std::min(slice_bytes_, image.bytes.size() - offset);
    slice.offset = static_cast<std::int32_t>(offset);
    slice.total_size = static_cast<std::int32_t>(image.bytes.size());
    slice.data_size = static_cast<std::int32_t>(size);
    const auto first = image.bytes.begin() + static_cast<std::ptrdiff_t>(offset);
    slice.data.assign(first, first + static_cast<std::ptrdiff_t>(size));
    last_sent_ = now;
    if (++next_slice_ == slice.slices) {
        images_.pop_front();
        next_slice_ = 0;
    }
    return slice;
}

void SliceAssembler::give_up(std::deque<Assembly>::iterator assembly) {
    assemblies_.erase(assembly);
    ++incomplete_;
}

void SliceAssembler::begin(const image_slice_t& slice) {
    const auto of_camera = [&](const Assembly& a) { return a.camera == slice.camera; };
    if (static_cast<std::size_t>(std::count_if(assemblies_.begin(), assemblies_.end(), of_camera)) >=
        images_of_a_camera) {
        give_up(std::find_if(assemblies_.begin(), assemblies_.end(), of_camera));
    }
    if (assemblies_.size() >= images_in_all) give_up(assemblies_.begin());
    Assembly& assembly = assemblies_.emplace_back();
    assembly.camera = slice.camera;
    assembly.utime = slice.utime;
    assembly.seq = slice.seq;
    assembly.slices = slice.slices;
    assembly.total_size = slice.total_size;
    assembly.bytes.reserve(std::min(most_reserved, static_cast<std::size_t>(slice.total_size)));
}

std::optional<std::vector<std::uint8_t>> SliceAssembler::add(const image_slice_t& slice) {
    contradiction_.clear();
    const auto same_image = [&](const Assembly& a) {
        return a.seq == slice.seq && a.utime == slice.utime && a.camera == slice.camera;
    };
    auto found = std::find_if(assemblies_.begin(), assemblies_.end(), same_image);
    if (slice.slice == 0) {
        if (found != assemblies_.end()) give_up(found);
        begin(slice);
        found = assemblies_.end() - 1;
    }
    if (found == assemblies_.end()) return {};  // its beginning was lost

    if (slice.slices != found->slices || slice.total_size != found->total_size) {
        contradiction_ = "slices that contradict each other";
    } else if (slice.slice < found->next_slice) {
        return {};  // again
    } else if (slice.slice == found->next_slice &&
               static_cast<std::size_t>(slice.offset) != found->bytes.size()) {
        contradiction_ = "slices that do not join";
    }
    if (!contradiction_.empty() || slice.slice != found->next_slice) {
        give_up(found);
        return {};
    }
    found->bytes.insert(found->bytes.end(), slice.data.begin(), slice.data.end());
    if (++found->next_slice < found->slices) return {};
    std::vector<std::uint8_t> whole = std::move(found->bytes);
    assemblies_.erase(found);
    return whole;
}

}  // namespace goalmouth
