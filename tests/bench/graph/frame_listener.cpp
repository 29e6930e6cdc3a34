#include "tests/bench/graph/frame_listener.h"

#include "core/messaging/clock.h"
#include "core/messaging/signals_blocked.h"

#include <stdexcept>

#include <lcm/lcm-cpp.hpp>

namespace goalmouth::bench {
namespace {

constexpr int queue_capacity = 1000;
constexpr int longest_wait = 100;  // ms

}  // namespace

struct FrameListener::Receiver {
    static void receive(const lcm::ReceiveBuffer* buffer, const std::string&, Channel* channel) {
        const std::int64_t now = now_utime();
        channel->journal->note_message(channel->stage,
                                       {static_cast<const std::uint8_t*>(buffer->data), buffer->data_size},
                                       buffer->recv_utime, now);
    }
};

FrameListener::FrameListener(const std::string& lcm_url, FrameJournal& journal, bool images) {
    const SignalsBlocked blocked;
    lcm_ = std::make_unique<lcm::LCM>(lcm_url);
    if (!lcm_->good()) throw std::runtime_error("LCM cannot use the URL " + lcm_url);
    for (std::size_t i = 0; i < stage_count; ++i) {
        const auto stage = static_cast<Stage>(i);
        if (stage == Stage::image && !images) continue;
        channels_[i] = {&journal, stage};
        lcm_->subscribeFunction(stage_channels[i], &Receiver::receive, &channels_[i])
            ->setQueueCapacity(queue_capacity);
    }
    thread_ = std::thread([this] { listen(); });
}

FrameListener::~FrameListener() {
    stop_ = true;
    thread_.join();
}

void FrameListener::listen() {
    while (!stop_) lcm_->handleTimeout(longest_wait);
}

}  // namespace goalmouth::bench
