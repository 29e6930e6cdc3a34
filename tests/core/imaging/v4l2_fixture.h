#pragma once

#include "core/imaging/v4l2_source.h"
#include "tests/core/imaging/fake_v4l2.h"

#include <cstdint>
#include <string>
#include <time.h>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {

inline std::int64_t now_us(clockid_t clock) {
    timespec t{};
    clock_gettime(clock, &t);
    return static_cast<std::int64_t>(t.tv_sec) * 1000000 + t.tv_nsec / 1000;
}

/// A source of the camera that fake_v4l2.h plays.
class V4l2 : public testing::Test {
  protected:
    V4l2() {
        settings_.device = test::FakeCamera::path;
        settings_.width = 8;
        settings_.height = 4;
        settings_.frames_per_second = 0.0;
    }
    void frame(std::uint32_t sequence, std::uint8_t value = 0, std::size_t bytes = 64) {
        camera_.events.push_back({std::vector<std::uint8_t>(bytes, value), sequence,
                                  V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC, now_us(CLOCK_MONOTONIC), 0});
    }
    void error(int number) {
        test::FakeCamera::Event event;
        event.error = number;
        camera_.events.push_back(event);
    }
    V4l2Source source(FrameMemory* memory = nullptr) {
        return V4l2Source(
            settings_, [this](const std::string& what) { said_.push_back(what); }, memory);
    }
    test::FakeCamera camera_;
    V4l2Settings settings_;
    std::vector<std::string> said_;
    Captured captured_;
};

inline constexpr auto captured = ImageSource::Outcome::captured;
inline constexpr auto nothing = ImageSource::Outcome::nothing;

}  // namespace goalmouth
