#pragma once

#include "tests/bench/graph/frame_journal.h"

#include <atomic>
#include <memory>
#include <string>
#include <thread>

namespace lcm {
class LCM;
}

namespace goalmouth::bench {

/// Hears what a graph says of its frames, in a thread of its own.
class FrameListener {
  public:
    /// `images`: whether descriptors come on IMAGE. Throws std::runtime_error where LCM cannot use the URL.
    FrameListener(const std::string& lcm_url, FrameJournal& journal, bool images);
    ~FrameListener();
    FrameListener(const FrameListener&) = delete;
    FrameListener& operator=(const FrameListener&) = delete;

  private:
    struct Channel {
        FrameJournal* journal = nullptr;
        Stage stage = Stage::image;
    };
    struct Receiver;

    void listen();

    std::unique_ptr<lcm::LCM> lcm_;
    std::array<Channel, stage_count> channels_{};
    std::atomic<bool> stop_{false};
    std::thread thread_;
};

}  // namespace goalmouth::bench
