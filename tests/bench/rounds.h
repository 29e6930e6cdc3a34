#pragma once

#include "tests/bench/contender.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace goalmouth::bench {

/// How items are shared out among contenders that take turns. Items form `blocks` blocks of `block` each. The
/// turns run through all blocks, turn t working on block t mod `blocks`, and contender t mod `contenders` has
/// turn t: as the two numbers have no common divisor, each contender meets each block once in `blocks`
/// rounds, all in the same cyclic order, and between two visits to a block all others are visited.
struct Turns {
    std::size_t blocks = 0;
    std::size_t block = 0;
    std::size_t contenders = 0;

    std::size_t items() const { return blocks * block; }
    /// First item of a contender's turn in a round.
    std::size_t first(std::size_t round, std::size_t contender) const {
        return (round * contenders + contender) % blocks * block;
    }
};

/// For at least `items` items in blocks of up to `block`.
Turns share_turns(std::size_t items, std::size_t block, std::size_t contenders);

struct RoundOptions {
    std::size_t repetitions = 1;                  // of all items by each
    std::function<bool()> stop;                   // asked between turns
    std::function<void()> step;                   // after each turn
    StopwatchClock clock = StopwatchClock::wall;  // of the whole; parts are the contenders' own business
};

/// Times every contender on every item by Google Benchmark, one turn after the other; before each turn the
/// item before its first one is worked on untimed, so that tables and code are where a loop has them.
/// The times of the contenders and their parts, in their order; nothing where it was stopped. What a
/// contender throws is passed on.
std::vector<Timing> run_rounds(const std::vector<Contender>& contenders, const Turns& turns,
                               const RoundOptions& options);

}  // namespace goalmouth::bench
