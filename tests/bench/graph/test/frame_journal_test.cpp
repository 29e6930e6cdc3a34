#include "tests/bench/graph/frame_journal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace goalmouth::bench {
namespace {

constexpr std::int64_t second = 1'000'000;

/// Frame `seq` captured at `seq` seconds, heard of `age` µs later.
void note(FrameJournal& journal, Stage stage, std::int64_t seq, std::int64_t age) {
    journal.note(stage, {seq, seq * second, seq * second + age / 2, seq * second + age});
}

TEST(Latency, QuantilesAreOfTheSample) {
    const Latency latency({30.0, 10.0, 20.0, 40.0});
    EXPECT_EQ(latency.p50(), 25.0);
    EXPECT_EQ(latency.quantile(0.0), 10.0);
    EXPECT_EQ(latency.quantile(1.0 / 3.0), 20.0);
    EXPECT_EQ(latency.max(), 40.0);
    EXPECT_EQ(Latency().p50(), 0.0);
}

TEST(FrameJournal, CountsFramesOfTheWindowAndWhatIsMissing) {
    FrameJournal journal;
    for (std::int64_t seq = 0; seq < 20; ++seq) {
        note(journal, Stage::image, seq, 10);
        if (seq != 7) note(journal, Stage::posts, seq, 100);
        if (seq != 7 && seq != 9) note(journal, Stage::pose, seq, 200);
    }
    const auto summary = journal.summary(5 * second, 15 * second, 1.0);
    EXPECT_EQ(summary.frames, 10);
    EXPECT_EQ(summary.lost, 2);
    ASSERT_EQ(summary.stages.size(), stage_count);
    EXPECT_EQ(summary.stages[0].lost, 0);
    EXPECT_EQ(summary.stages[1].channel, "SEGMENTS");
    EXPECT_EQ(summary.stages[1].lost, 10);
    EXPECT_EQ(summary.stages[3].lost, 1);
    EXPECT_EQ(summary.stages[4].lost, 2);
    EXPECT_EQ(summary.stages[3].heard.p50(), 100.0);
    EXPECT_EQ(summary.stages[3].sent.p50(), 50.0);
}

TEST(FrameJournal, FramesNobodyHeardOfAreLost) {
    FrameJournal journal;
    for (const std::int64_t seq : {1, 2, 5, 6}) {
        for (const Stage stage : {Stage::image, Stage::posts, Stage::pose}) note(journal, stage, seq, 10);
    }
    const auto summary = journal.summary(second, 7 * second, 1.0);
    EXPECT_EQ(summary.frames, 6);
    EXPECT_EQ(summary.not_sent, 0);
    EXPECT_EQ(summary.lost, 2);
    EXPECT_EQ(summary.stages[0].lost, 2);
}

TEST(FrameJournal, FramesThatACameraOwesAreLostWhenItStopsHalfWay) {
    FrameJournal journal;
    for (std::int64_t seq = 0; seq < 10; ++seq) {
        for (const Stage stage : {Stage::image, Stage::posts, Stage::pose}) note(journal, stage, seq, 10);
    }
    const auto summary = journal.summary(0, 20 * second, 1.0);
    EXPECT_EQ(summary.frames, 20);
    EXPECT_EQ(summary.not_sent, 10);
    EXPECT_EQ(summary.lost, 10);
    EXPECT_EQ(summary.stages[0].lost, 10);
    EXPECT_EQ(journal.summary(0, 20 * second, 2.0).lost, 30) << "a camera at half its rate";
    const auto silent = journal.summary(50 * second, 60 * second, 1.0);
    EXPECT_EQ(silent.frames, 10);
    EXPECT_EQ(silent.lost, 10);
}

TEST(FrameJournal, OneFrameMoreOrLessIsWhereTheEdgesFall) {
    FrameJournal journal;
    for (std::int64_t seq = 0; seq < 10; ++seq) {
        for (const Stage stage : {Stage::image, Stage::posts, Stage::pose}) note(journal, stage, seq, 10);
    }
    for (const std::int64_t end : {9, 10, 11}) {
        const auto summary = journal.summary(0, end * second, 1.0);
        EXPECT_EQ(summary.lost, 0) << end;
        EXPECT_EQ(summary.not_sent, 0) << end;
    }
    EXPECT_EQ(journal.summary(0, 12 * second, 1.0).lost, 2);
}

TEST(FrameJournal, CountsWhatWasSentUpToAMoment) {
    FrameJournal journal;
    for (const std::int64_t seq : {1, 2, 3}) note(journal, Stage::segments, seq, 10);
    EXPECT_EQ(journal.sent_until(Stage::segments, 2 * second + 5), 2);
    EXPECT_EQ(journal.sent_until(Stage::posts, 9 * second), 0);
}

TEST(FrameJournal, AMessageThatComesTwiceCountsOnce) {
    FrameJournal journal;
    for (const std::int64_t age : {10, 500}) {
        for (const Stage stage : {Stage::image, Stage::posts, Stage::pose}) note(journal, stage, 3, age);
    }
    const auto summary = journal.summary(3 * second, 4 * second, 1.0);
    EXPECT_EQ(summary.frames, 1);
    EXPECT_EQ(summary.lost, 0);
    EXPECT_THAT(summary.stages[3].heard.ages, testing::ElementsAre(10.0));
}

TEST(FrameJournal, TheLatestFrameIsTheOneNumberedHighest) {
    FrameJournal journal;
    EXPECT_FALSE(journal.latest(Stage::posts).has_value());
    for (const std::int64_t seq : {4, 9, 6}) note(journal, Stage::posts, seq, 10);
    EXPECT_EQ(journal.latest(Stage::posts)->seq, 9);
}

TEST(FrameJournal, ReadsUtimeAndSeqOfAnEncodedMessage) {
    std::vector<std::uint8_t> message(24, 0);
    message[8 + 7] = 5;   // utime
    message[16 + 6] = 1;  // seq 256 + 2
    message[16 + 7] = 2;
    FrameJournal journal;
    journal.note_message(Stage::segments, message, 7, 8);
    ASSERT_TRUE(journal.latest(Stage::segments).has_value());
    EXPECT_EQ(journal.latest(Stage::segments)->utime, 5);
    EXPECT_EQ(journal.latest(Stage::segments)->seq, 258);
    journal.note_message(Stage::posts, std::span(message).first(23), 7, 8);
    EXPECT_FALSE(journal.latest(Stage::posts).has_value());
}

}  // namespace
}  // namespace goalmouth::bench
