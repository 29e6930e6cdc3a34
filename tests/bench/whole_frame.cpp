#include "core/simulation/vectorised.h"
#include "tests/bench/others.h"

#include <algorithm>
#include <cstring>
#include <memory>

#include <benchmark/benchmark.h>

namespace goalmouth::bench {
namespace {

/// Four sums side by side, so that adding never waits for adding and memory alone sets the pace.
GOALMOUTH_VECTORISED
std::uint64_t sum_of_words(const std::uint8_t* bytes, std::size_t count) {
    constexpr std::size_t lanes = 32;
    std::uint64_t sums[lanes] = {};
    std::size_t i = 0;
    for (; i + 8 * lanes <= count; i += 8 * lanes) {
        std::uint64_t words[lanes];
        std::memcpy(words, bytes + i, sizeof words);
        for (std::size_t lane = 0; lane < lanes; ++lane) sums[lane] += words[lane];
    }
    std::uint64_t sum = 0;
    for (const std::uint64_t each : sums) sum += each;
    for (; i < count; ++i) sum += bytes[i];
    return sum;
}

struct Lookup {
    const FrameSet& frames;
    const ColourTable& table;
    std::vector<std::uint8_t> classes = {};

    void run(std::size_t item) {
        const YuyvView image = frames.view(item);
        classes.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
        std::uint8_t* out = classes.data();
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                *out++ = static_cast<std::uint8_t>(table.at(image.at(x, y)));
        benchmark::ClobberMemory();
    }
    Finding finding() const {
        const auto goal = std::count(classes.begin(), classes.end(), static_cast<std::uint8_t>(Colour::goal));
        return {static_cast<double>(goal), {}};
    }
};

}  // namespace

Contender full_lookup(const FrameSet& frames, const ColourTable& table) {
    const auto work = std::make_shared<Lookup>(Lookup{frames, table});
    Contender contender;
    contender.name = "lookup";
    contender.label = "table for every pixel";
    contender.settings = "the same colour table asked pixel by pixel, classes written to a picture";
    contender.finds = "pixels of the goal's colour";
    contender.run = [work](std::size_t item, std::vector<double>&) { work->run(item); };
    contender.finding = [work] { return work->finding(); };
    return contender;
}

Contender frame_read(const FrameSet& frames) {
    Contender contender;
    contender.name = "read";
    contender.label = "one read of the frame";
    contender.settings = "every byte read once: a sum of 64-bit words, vectorised";
    contender.run = [&frames](std::size_t item, std::vector<double>&) {
        const auto& data = frames.frames[item].data;
        benchmark::DoNotOptimize(sum_of_words(data.data(), data.size()));
    };
    return contender;
}

}  // namespace goalmouth::bench
