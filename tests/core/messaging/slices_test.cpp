#include "core/messaging/slices.h"

#include "core/messaging/image_output.h"
#include "core/messaging/typed.h"
#include "tests/support/example_messages.h"

#include <numeric>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace goalmouth::test;
using namespace std::chrono_literals;
using Time = SlicePacer::Time;

image_t image_of(int width, int height, std::int64_t seq) {
    YuyvImage pixels(width, height);
    std::iota(pixels.data.begin(), pixels.data.end(), static_cast<std::uint8_t>(seq));
    FrameInfo info;
    info.utime = 1'000'000 + 33'333 * seq;
    info.seq = seq;
    info.intrinsics = example_intrinsics(width, height);
    return self_contained_yuyv(info, "front", pixels.view());
}

std::vector<image_slice_t> slices_of(const image_t& image, int slice_bytes) {
    SlicePacer pacer(slice_bytes);
    Time now;
    pacer.offer(image, now);
    std::vector<image_slice_t> slices;
    while (const auto wait = pacer.next_due(now)) {
        now += *wait;
        slices.push_back(pacer.due(now).value());
    }
    return slices;
}

TEST(Slices, AnImageComesBackFromItsSlices) {
    for (const int slice_bytes : {1000, 4096, 32000, 65000}) {
        const image_t image = image_of(160, 120, 3);
        SliceAssembler assembler;
        const auto slices = slices_of(image, slice_bytes);
        for (std::size_t i = 0; i < slices.size(); ++i) {
            EXPECT_EQ(problem(slices[i]), std::nullopt);
            const auto whole = assembler.add(slices[i]);
            EXPECT_EQ(whole.has_value(), i + 1 == slices.size());
            if (whole) {
                EXPECT_EQ(*whole, encoded(image));
            }
        }
        EXPECT_EQ(assembler.incomplete(), 0);
    }
}

TEST(Slices, AreSpreadOverTheFrameInterval) {
    SlicePacer pacer(1000);
    Time now;
    pacer.offer(image_of(160, 120, 0), now);
    while (const auto wait = pacer.next_due(now)) now += *wait, pacer.due(now);
    now += 100ms;
    const Time start = now;
    pacer.offer(image_of(160, 120, 1), now);  // 33 ms after the first by its utime
    std::vector<Time> times;
    while (const auto wait = pacer.next_due(now)) {
        if (*wait > 0us) {
            EXPECT_FALSE(pacer.due(now).has_value());
        }
        now += *wait;
        times.push_back(now);
        ASSERT_TRUE(pacer.due(now).has_value());
    }
    ASSERT_EQ(times.size(), 39U);
    EXPECT_EQ(times.front(), start);
    EXPECT_GT(times.back() - start, 28ms);
    EXPECT_LT(times.back() - start, 31ms);
    for (std::size_t i = 1; i < times.size(); ++i) EXPECT_GT(times[i] - times[i - 1], 500us);
}

TEST(Slices, ALateSenderCatchesUpWithoutABurst) {
    SlicePacer pacer(1000);
    Time now;
    pacer.offer(image_of(160, 120, 0), now);
    now += 50ms;  // the whole interval slept through
    int sent = 0;
    const Time start = now;
    while (const auto wait = pacer.next_due(now)) {
        now += *wait;
        sent += pacer.due(now).has_value() ? 1 : 0;
    }
    EXPECT_EQ(sent, 39);
    EXPECT_GT(now - start, 13ms);
    EXPECT_LT(now - start, 17ms);
}

/// Times of the slices of everything that waits, from now on.
std::vector<Time> send_all(SlicePacer& pacer, Time& now) {
    std::vector<Time> times;
    while (const auto wait = pacer.next_due(now)) {
        now += *wait;
        if (pacer.due(now)) times.push_back(now);
    }
    return times;
}

TEST(Slices, OfALargeFirstImageComeNoFasterThanStockBuffersBear) {
    for (const auto& [width, height, least] : {std::tuple{640, 480, 50ms}, std::tuple{1600, 1200, 170ms}}) {
        SlicePacer pacer(32000);
        Time now;
        const Time start = now;
        pacer.offer(image_of(width, height, 0), now);
        const auto times = send_all(pacer, now);
        EXPECT_GT(times.back() - start, least);
        EXPECT_LT(times.back() - start, 200ms);
        for (std::size_t i = 1; i < times.size(); ++i) EXPECT_GT(times[i] - times[i - 1], 1ms);
    }
}

TEST(Slices, OfALargeFirstImageHurryUpOnceTheRateOfImagesIsKnown) {
    SlicePacer pacer(32000);
    Time now;
    const Time start = now;
    pacer.offer(image_of(640, 480, 0), now);
    std::vector<Time> times;
    while (now - start < 33ms) {
        if (pacer.due(now)) times.push_back(now);
        now += *pacer.next_due(now);
    }
    pacer.offer(image_of(640, 480, 1), start + 33333us);
    now = start + 33333us;
    const auto rest = send_all(pacer, now);
    times.insert(times.end(), rest.begin(), rest.end());
    ASSERT_EQ(times.size(), 40U);
    EXPECT_LT(times[19] - start, 50ms);
    EXPECT_LT(times[39] - start, 80ms);
    for (std::size_t i = 1; i < times.size(); ++i) EXPECT_GT(times[i] - times[i - 1], 1300us);
}

TEST(Slices, EightImagesWaitAndAFurtherOneReplacesTheLast) {
    SlicePacer pacer(1000);
    Time now;
    for (int seq = 0; seq < 12; ++seq) pacer.offer(image_of(160, 120, seq), now);
    EXPECT_EQ(pacer.left_out(), 3);
    std::vector<std::int64_t> seqs;
    while (const auto wait = pacer.next_due(now)) {
        now += *wait;
        const auto slice = pacer.due(now);
        if (slice->slice == 0) seqs.push_back(slice->seq);
    }
    EXPECT_EQ(seqs, (std::vector<std::int64_t>{0, 1, 2, 3, 4, 5, 6, 7, 11}));
}

TEST(Slices, OfImagesThatComeFasterThanTheirStampsGoOutAtTheStampsRate) {
    SlicePacer pacer(1000);
    Time now;
    const Time start = now;
    std::vector<Time> finished;
    for (int seq = 0; seq < 300; ++seq) {  // stamped every 33 ms, offered every 10
        const Time next = start + seq * 10ms;
        for (auto wait = pacer.next_due(now); wait && now + *wait < next; wait = pacer.next_due(now)) {
            now += *wait;
            const auto slice = pacer.due(now);
            if (slice && slice->slice == slice->slices - 1) finished.push_back(now);
        }
        now = next;
        pacer.offer(image_of(160, 120, seq), now);
    }
    EXPECT_GT(finished.size(), 90U);
    for (std::size_t i = 1; i < finished.size(); ++i) EXPECT_LT(finished[i] - finished[i - 1], 35ms) << i;
}

TEST(Slices, WaitForListenersThatAreBehind) {
    SlicePacer pacer(1000);
    Time now;
    pacer.offer(image_of(160, 120, 0), now);
    for (int i = 0; i < 20; ++i) {
        EXPECT_FALSE(pacer.due(now, 0.9).has_value());
        const auto wait = pacer.next_due(now);
        ASSERT_GT(wait, 0us);
        now += *wait;
    }
    EXPECT_TRUE(pacer.due(now, 0.1).has_value());
}

TEST(Slices, DoNotWaitForListenersThatAreStuck) {
    SlicePacer pacer(1000);
    Time now;
    const Time start = now;
    pacer.offer(image_of(160, 120, 0), now);
    int sent = 0;
    while (const auto wait = pacer.next_due(now)) {
        now += *wait;
        sent += pacer.due(now, 1.0).has_value() ? 1 : 0;
    }
    EXPECT_EQ(sent, 39);
    EXPECT_GT(now - start, 50ms);
    EXPECT_LT(now - start, 100ms);
}

TEST(Slices, AbsurdSizesAreRefused) {
    EXPECT_THROW(SlicePacer(0), std::invalid_argument);
    EXPECT_THROW(SlicePacer(-1), std::invalid_argument);
    EXPECT_THROW(SlicePacer(70000), std::invalid_argument);
}

TEST(Slices, ALostSliceCostsItsImageOnly) {
    const auto first = slices_of(image_of(160, 120, 1), 4000);
    const auto second = slices_of(image_of(160, 120, 2), 4000);
    ASSERT_GT(first.size(), 3U);
    for (std::size_t lost = 0; lost < first.size(); ++lost) {
        SliceAssembler assembler;
        int complete = 0;
        for (std::size_t i = 0; i < first.size(); ++i) {
            if (i != lost) complete += assembler.add(first[i]).has_value() ? 1 : 0;
        }
        EXPECT_EQ(complete, 0);
        for (const auto& slice : second) complete += assembler.add(slice).has_value() ? 1 : 0;
        EXPECT_EQ(complete, 1);
        EXPECT_EQ(assembler.contradiction(), "");
    }
}

TEST(Slices, RepeatedAndInterleavedSlicesStillMakeTheirImages) {
    const auto first = slices_of(image_of(160, 120, 1), 4000);
    const auto second = slices_of(image_of(160, 120, 2), 4000);
    SliceAssembler assembler;
    int complete = 0;
    for (std::size_t i = 0; i < first.size(); ++i) {
        complete += assembler.add(first[i]).has_value() ? 1 : 0;
        complete += assembler.add(second[i]).has_value() ? 1 : 0;
        if (i > 0 && i + 1 < first.size()) {
            EXPECT_FALSE(assembler.add(first[i]).has_value());
        }
    }
    EXPECT_EQ(complete, 2);
    EXPECT_EQ(assembler.incomplete(), 0);
}

TEST(Slices, AThirdImageInAssemblyCostsTheOldest) {
    SliceAssembler assembler;
    std::vector<std::vector<image_slice_t>> images;
    for (int seq = 0; seq < 3; ++seq) images.push_back(slices_of(image_of(160, 120, seq), 4000));
    for (const auto& image : images) assembler.add(image.front());
    EXPECT_EQ(assembler.incomplete(), 1);
    std::vector<int> complete(3);
    for (std::size_t i = 1; i < images[0].size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) complete[k] += assembler.add(images[k][i]).has_value() ? 1 : 0;
    }
    EXPECT_EQ(complete, (std::vector<int>{0, 1, 1}));
}

TEST(Slices, SlicesThatContradictEachOtherAreRefused) {
    const auto slices = slices_of(image_of(160, 120, 1), 4000);
    const auto expect_contradiction = [&](auto change) {
        SliceAssembler assembler;
        assembler.add(slices[0]);
        image_slice_t forged = slices[1];
        change(forged);
        EXPECT_FALSE(assembler.add(forged).has_value());
        EXPECT_NE(assembler.contradiction(), "");
        for (std::size_t i = 1; i < slices.size(); ++i) EXPECT_FALSE(assembler.add(slices[i]).has_value());
    };
    expect_contradiction([](image_slice_t& m) { m.total_size += 1; });
    expect_contradiction([](image_slice_t& m) { m.slices += 1; });
    expect_contradiction([](image_slice_t& m) { m.offset += 1; });
    expect_contradiction([](image_slice_t& m) { m.offset -= 1; });
}

TEST(Slices, AClaimOfAHugeImageTakesNoMemory) {
    SliceAssembler assembler;
    auto slice = example_slice();
    slice.slice = 0;
    slice.offset = 0;
    slice.slices = 1'000'000;
    slice.total_size = std::numeric_limits<std::int32_t>::max();
    for (slice.seq = 0; slice.seq < 1000; ++slice.seq) {
        slice.camera = "camera " + std::to_string(slice.seq % 50);
        EXPECT_FALSE(assembler.add(slice).has_value());
    }
    EXPECT_EQ(assembler.incomplete(), 1000 - 8);
}

}  // namespace
}  // namespace goalmouth
