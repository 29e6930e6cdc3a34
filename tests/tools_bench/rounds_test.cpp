#include "tests/bench/rounds.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include <gmock/gmock.h>

namespace goalmouth::bench {
namespace {

using testing::DoubleNear;
using testing::Each;
using testing::SizeIs;

/// Writes down which items it worked on; in the order of all contenders' turns.
struct Diary {
    std::vector<std::pair<std::size_t, std::size_t>> entries;  // contender, item

    Contender contender(std::size_t number) {
        Contender result;
        result.name = "contender" + std::to_string(number);
        result.run = [this, number](std::size_t item, std::vector<double>&) {
            entries.emplace_back(number, item);
        };
        return result;
    }
};

TEST(Turns, EveryContenderMeetsEveryBlockOnceInAsManyRoundsAsThereAreBlocks) {
    for (std::size_t contenders = 1; contenders < 25; ++contenders) {
        for (const std::size_t items : {1UL, 3UL, 16UL, 120UL, 137UL, 417UL}) {
            const Turns turns = share_turns(items, 8, contenders);
            EXPECT_GE(turns.items(), items);
            EXPECT_LE(turns.block, 8U);
            for (std::size_t c = 0; c < contenders; ++c) {
                std::set<std::size_t> met;
                for (std::size_t round = 0; round < turns.blocks; ++round) met.insert(turns.first(round, c));
                EXPECT_EQ(met.size(), turns.blocks) << contenders << " contenders, " << items << " items";
            }
        }
    }
}

TEST(Turns, BetweenTwoVisitsToABlockAllOthersAreVisited) {
    const Turns turns = share_turns(120, 8, 16);
    std::vector<std::size_t> visits;
    for (std::size_t round = 0; round < 3 * turns.blocks; ++round)
        for (std::size_t c = 0; c < turns.contenders; ++c) visits.push_back(turns.first(round, c));
    for (std::size_t i = turns.blocks; i < visits.size(); ++i) {
        const std::set<std::size_t> window(visits.begin() + static_cast<std::ptrdiff_t>(i - turns.blocks),
                                           visits.begin() + static_cast<std::ptrdiff_t>(i));
        ASSERT_EQ(window.size(), turns.blocks);
    }
}

TEST(Rounds, EveryItemIsTimedAsOftenAsAskedForAndAllContendersTakeTurns) {
    const Turns turns = share_turns(40, 4, 3);
    Diary diary;
    std::size_t steps = 0;
    RoundOptions options;
    options.repetitions = 2;
    options.step = [&] { ++steps; };
    const auto timings =
        run_rounds({diary.contender(0), diary.contender(1), diary.contender(2)}, turns, options);
    ASSERT_THAT(timings, SizeIs(3));
    EXPECT_EQ(timings[1].name, "contender1");
    EXPECT_EQ(timings[1].count, 2 * turns.items());
    EXPECT_EQ(steps, 2 * turns.blocks * 3);

    // Each turn: one untimed item, then the block.
    const std::size_t turn = turns.block + 1;
    ASSERT_EQ(diary.entries.size(), steps * turn);
    std::map<std::pair<std::size_t, std::size_t>, int> timed;
    for (std::size_t i = 0; i < diary.entries.size(); ++i) {
        EXPECT_EQ(diary.entries[i].first, i / turn % 3);
        if (i % turn != 0) ++timed[diary.entries[i]];
    }
    EXPECT_EQ(timed.size(), 3 * turns.items());
    for (const auto& [entry, count] : timed) EXPECT_EQ(count, 2) << entry.first << ' ' << entry.second;
}

TEST(Rounds, PartsAreRecordedBesideTheWhole) {
    Contender contender;
    contender.name = "whole";
    contender.parts = {"first", "second"};
    contender.part_labels = {"the first", "the second"};
    contender.run = [](std::size_t, std::vector<double>& part_ms) { part_ms = {1.5, 2.5}; };
    const auto timings = run_rounds({contender}, share_turns(8, 4, 1), {});
    ASSERT_THAT(timings, SizeIs(3));
    EXPECT_EQ(timings[1].name, "first");
    EXPECT_EQ(timings[1].median, 1.5);
    EXPECT_EQ(timings[2].label, "the second");
    EXPECT_EQ(timings[2].median, 2.5);
}

TEST(Rounds, AStopEndsThemWithoutAResult) {
    Diary diary;
    RoundOptions options;
    options.repetitions = 1000000;
    options.stop = [&] { return diary.entries.size() > 10; };
    EXPECT_TRUE(run_rounds({diary.contender(0)}, share_turns(4, 4, 1), options).empty());
    EXPECT_LT(diary.entries.size(), 20U);
}

TEST(Rounds, WhatAContenderThrowsIsPassedOnAndTheNextRunIsSound) {
    Contender broken;
    broken.name = "broken";
    broken.run = [](std::size_t, std::vector<double>&) { throw std::runtime_error("no such luck"); };
    EXPECT_THROW(run_rounds({broken}, share_turns(4, 4, 1), {}), std::runtime_error);
    Diary diary;
    EXPECT_THAT(run_rounds({diary.contender(0)}, share_turns(4, 4, 1), {}), SizeIs(1));
}

TEST(TimingOf, QuantilesLieBetweenTheNearestValues) {
    const Timing timing = timing_of("name", "label", {4.0, 1.0, 3.0, 2.0, 5.0});
    EXPECT_EQ(timing.count, 5U);
    EXPECT_EQ(timing.least, 1.0);
    EXPECT_EQ(timing.p25, 2.0);
    EXPECT_EQ(timing.median, 3.0);
    EXPECT_EQ(timing.p75, 4.0);
    EXPECT_NEAR(timing.p95, 4.8, 1e-12);
    EXPECT_EQ(timing.mean, 3.0);
    EXPECT_EQ(timing_of("", "", {1.0, 2.0}).median, 1.5);
    EXPECT_EQ(timing_of("", "", {7.0}).p95, 7.0);
}

}  // namespace
}  // namespace goalmouth::bench
