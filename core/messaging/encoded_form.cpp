#include "core/messaging/encoded_form.h"

#include <algorithm>
#include <cstddef>

namespace goalmouth {
namespace {

constexpr std::size_t i8 = 1;
constexpr std::size_t i16 = 2;
constexpr std::size_t i32 = 4;
constexpr std::size_t i64 = 8;
constexpr std::size_t f32 = 4;
constexpr std::size_t f64 = 8;
constexpr std::size_t hash = 8;
constexpr std::size_t largest_message = std::size_t{1}
                                        << 28;  // LCM's own limit; offsets in generated code are ints

constexpr std::size_t intrinsics = 2 * i32 + 9 * f64;
constexpr std::size_t post = 8 * f64 + i32 + i8 + 3 * f64 + 4 * f64 + 2 * i32;
constexpr std::size_t distance_cue = i8 + 2 * f64;
constexpr std::size_t pose_hypothesis = 4 * f64 + 9 * f64;
constexpr std::size_t truth_post = i32 + 4 * f64 + 8 * f64 + f64;

/// Walks an encoded message by lengths alone. Once something does not fit, everything after it is skipped.
class Walk {
  public:
    explicit Walk(std::span<const std::uint8_t> encoded) : rest_(encoded) {
        if (encoded.size() > largest_message) fail();
        skip(hash);
    }

    Walk& skip(std::size_t bytes) {
        if (bytes > rest_.size()) return fail();
        rest_ = rest_.subspan(bytes);
        return *this;
    }

    Walk& text() {
        const std::size_t length = count();
        if (!fits_ || length == 0 || length > rest_.size()) return fail();
        const auto characters = rest_.first(length);
        if (std::find(characters.begin(), characters.end(), 0) != characters.end() - 1) return fail();
        return skip(length);
    }

    /// A 32-bit count; 0 once something did not fit.
    std::size_t count() {
        if (rest_.size() < i32) {
            fail();
            return 0;
        }
        const std::uint32_t number = (std::uint32_t{rest_[0]} << 24) | (std::uint32_t{rest_[1]} << 16) |
                                     (std::uint32_t{rest_[2]} << 8) | std::uint32_t{rest_[3]};
        rest_ = rest_.subspan(i32);
        if (number > 0x7fffffffU) {
            fail();
            return 0;
        }
        return number;
    }

    /// A count, then that many elements.
    Walk& table(std::size_t element) {
        const std::size_t rows = count();
        return skip(rows * element);
    }

    Walk& refined_post() {
        return skip(i8).text().skip(f64 + 4 * i32 + 6 * f64 + 2 * (i8 + 2 * f64)).table(distance_cue);
    }

    bool good() const { return fits_; }
    bool done() const { return fits_ && rest_.empty(); }

  private:
    Walk& fail() {
        fits_ = false;
        rest_ = {};
        return *this;
    }

    std::span<const std::uint8_t> rest_;
    bool fits_ = true;
};

}  // namespace

bool lengths_add_up(const intrinsics_t&, std::span<const std::uint8_t> encoded) {
    return Walk(encoded).skip(intrinsics).done();
}

bool lengths_add_up(const camera_info_t&, std::span<const std::uint8_t> encoded) {
    return Walk(encoded).skip(i64).text().text().skip(f64 + intrinsics).done();
}

bool lengths_add_up(const image_t&, std::span<const std::uint8_t> encoded) {
    return Walk(encoded)
        .skip(2 * i64)
        .text()
        .skip(intrinsics + 3 * i32)
        .text()
        .skip(2 * i32)
        .text()
        .skip(i32 + i64 + i32)
        .table(i8)
        .done();
}

bool lengths_add_up(const image_slice_t&, std::span<const std::uint8_t> encoded) {
    return Walk(encoded).skip(2 * i64).text().skip(4 * i32).table(i8).done();
}

bool lengths_add_up(const segments_t&, std::span<const std::uint8_t> encoded) {
    return Walk(encoded)
        .skip(2 * i64 + intrinsics)
        .text()
        .skip(i32)
        .table(i8 + i16 + i16)
        .table(i16 + i16 + i8 + i8)
        .done();
}

bool lengths_add_up(const border_t&, std::span<const std::uint8_t> encoded) {
    return Walk(encoded).skip(2 * i64 + intrinsics).table(2 * f32).table(2 * f32).done();
}

bool lengths_add_up(const candidates_t&, std::span<const std::uint8_t> encoded) {
    return Walk(encoded)
        .skip(2 * i64 + intrinsics)
        .table(i8 + 3 * i16)
        .table(3 * i16)
        .table(2 * f32)
        .table(2 * f32)
        .done();
}

bool lengths_add_up(const colour_gains_t&, std::span<const std::uint8_t> encoded) {
    return Walk(encoded).skip(3 * i64 + 9 * f64).done();
}

bool lengths_add_up(const post_t&, std::span<const std::uint8_t> encoded) {
    return Walk(encoded).skip(post).done();
}

bool lengths_add_up(const posts_t&, std::span<const std::uint8_t> encoded) {
    return Walk(encoded).skip(2 * i64 + intrinsics).text().table(post).done();
}

bool lengths_add_up(const distance_cue_t&, std::span<const std::uint8_t> encoded) {
    return Walk(encoded).skip(distance_cue).done();
}

bool lengths_add_up(const refined_post_t&, std::span<const std::uint8_t> encoded) {
    return Walk(encoded).refined_post().done();
}

bool lengths_add_up(const refinement_t&, std::span<const std::uint8_t> encoded) {
    Walk walk(encoded);
    walk.skip(2 * i64);
    const std::size_t posts = walk.count();
    for (std::size_t i = 0; i < posts && walk.good(); ++i) walk.refined_post();
    return walk.done();
}

bool lengths_add_up(const odometry_t&, std::span<const std::uint8_t> encoded) {
    return Walk(encoded).skip(2 * i64 + 5 * f64).done();
}

bool lengths_add_up(const kinematics_t&, std::span<const std::uint8_t> encoded) {
    return Walk(encoded).skip(2 * i64 + 43 * f64).done();
}

bool lengths_add_up(const pose_hypothesis_t&, std::span<const std::uint8_t> encoded) {
    return Walk(encoded).skip(pose_hypothesis).done();
}

bool lengths_add_up(const pose_t&, std::span<const std::uint8_t> encoded) {
    return Walk(encoded).skip(2 * i64 + 13 * f64 + 2 * i32).table(pose_hypothesis).done();
}

bool lengths_add_up(const particles_t&, std::span<const std::uint8_t> encoded) {
    return Walk(encoded).skip(2 * i64).table(4 * f32).done();
}

bool lengths_add_up(const truth_t&, std::span<const std::uint8_t> encoded) {
    return Walk(encoded).skip(2 * i64 + 12 * f64).table(truth_post).done();
}

bool lengths_add_up(const status_t&, std::span<const std::uint8_t> encoded) {
    Walk walk(encoded);
    walk.skip(i64).text().text().skip(i32 + i8 + 4 * i64 + 4 * f64);
    const std::size_t counters = walk.count();
    for (std::size_t i = 0; i < counters && walk.good(); ++i) walk.text().skip(f64);
    return walk.done();
}

}  // namespace goalmouth
