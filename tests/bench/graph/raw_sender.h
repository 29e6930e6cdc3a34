#pragma once

#include "core/geometry/camera.h"
#include "tests/bench/graph/frame_journal.h"

#include <atomic>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <goalmouth/image_t.hpp>

namespace lcm {
class LCM;
}

namespace goalmouth::bench {

/// A camera as people write one who do not know better: each frame, pixels and all, in one LCM message on
/// IMAGE_TAP, through LCM alone. A thread of its own; the frames come from files, read ahead of their time as
/// the camera process does.
class RawSender {
  public:
    RawSender(const std::string& lcm_url, const std::filesystem::path& folder, const Intrinsics& camera,
              double frames_per_second, FrameJournal& journal);
    ~RawSender();
    RawSender(const RawSender&) = delete;
    RawSender& operator=(const RawSender&) = delete;

    /// Of its thread [s].
    double cpu_seconds();
    /// "" or why it sends no more.
    std::string failure() const;

  private:
    void run();

    std::vector<std::filesystem::path> files_;
    double frames_per_second_;
    FrameJournal& journal_;
    std::unique_ptr<lcm::LCM> lcm_;
    image_t message_{};
    mutable std::mutex mutex_;
    std::string failure_;
    std::atomic<bool> stop_{false};
    std::thread thread_;
};

}  // namespace goalmouth::bench
