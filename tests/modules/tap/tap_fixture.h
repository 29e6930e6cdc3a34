#pragma once

#include "core/messaging/channels.h"
#include "core/messaging/image_output.h"
#include "core/messaging/memory_bus.h"
#include "core/messaging/typed.h"
#include "modules/tap/tap_module.h"
#include "tests/support/example_messages.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth::test {

inline FrameInfo info_of(std::int64_t seq, int width, int height) {
    FrameInfo info;
    info.utime = 1'000'000 + 2'000 * seq;
    info.seq = seq;
    info.intrinsics = example_intrinsics(width, height);
    info.exposure_us = 4000;
    info.readout_us = 9000;
    return info;
}

inline YuyvImage noise(int width, int height, unsigned seed) {
    YuyvImage image(width, height);
    std::mt19937 random(seed);
    for (auto& byte : image.data) byte = static_cast<std::uint8_t>(100 + random() % 40);
    return image;
}

/// A tap between two networks: the graph's, and its own.
struct TapBetween : testing::Test {
    MemoryHub graph;
    MemoryHub own;
    Status status;
    std::vector<std::string> opened;
    ModuleContext context{graph.endpoint("tap"),
                          status,
                          "tap",
                          0,
                          {},
                          "udpm://239.255.76.67:7667?ttl=0",
                          [this](const std::string& url) {
                              opened.push_back(url);
                              return std::shared_ptr<Bus>(std::shared_ptr<Bus>{}, &own.endpoint("tap"));
                          }};
    ImageOutput camera{graph.endpoint("camera"), channels::image, "front"};
    using Heard = std::vector<std::pair<std::string, std::vector<std::uint8_t>>>;
    Heard on_graph;
    Heard on_own;
    std::optional<TapModule> tap;

    void start(const TapParameters& parameters) {
        tap.emplace(context, parameters);
        listen(graph, on_graph);
        listen(own, on_own);
    }
    static void listen(MemoryHub& hub, Heard& heard) {
        hub.endpoint("listener")
            .subscribe_all([&heard](const std::string& channel, std::span<const std::uint8_t> bytes) {
                heard.emplace_back(channel, std::vector<std::uint8_t>(bytes.begin(), bytes.end()));
            });
    }
    void say(const std::string& channel, std::uint8_t what) {
        graph.endpoint("somebody").publish(channel, std::vector<std::uint8_t>{what});
    }
    void send(std::int64_t seq) {
        const YuyvImage image = noise(64, 48, 1);
        camera.publish(info_of(seq, image.width, image.height), image.view());
    }
    void settle() {
        graph.run_until_idle();
        own.run_until_idle();
        while (tap->tick() < std::chrono::seconds(1)) {
        }
        own.run_until_idle();
    }
    static int count(const Heard& heard, const std::string& channel) {
        return static_cast<int>(std::count_if(heard.begin(), heard.end(),
                                              [&](const auto& message) { return message.first == channel; }));
    }
};

}  // namespace goalmouth::test
