#include "tests/bench/rounds.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include <benchmark/benchmark.h>

namespace goalmouth::bench {
namespace {

/// Results are the contenders' own records: the library's one line for each turn is of no use to anybody.
class Silent : public benchmark::BenchmarkReporter {
  public:
    bool ReportContext(const Context&) override { return true; }
    void ReportRuns(const std::vector<Run>& runs) override {
        for (const Run& run : runs)
            if (run.error_occurred) throw std::runtime_error(run.error_message);
    }
};

/// The times of one contender, and of each of its parts.
struct Record {
    std::vector<double> whole;
    std::vector<std::vector<double>> parts;
};

void time_turn(benchmark::State& state, const Contender& contender, std::size_t first, std::size_t items,
               StopwatchClock clock, Record& record) {
    std::vector<double> part_ms;
    contender.run((first + items - 1) % items, part_ms);
    std::size_t item = first;
    for (auto _ : state) {
        part_ms.clear();
        Stopwatch watch(clock);
        contender.run(item++, part_ms);
        const double ms = watch.lap();
        state.SetIterationTime(1e-3 * ms);
        record.whole.push_back(ms);
        for (std::size_t i = 0; i < record.parts.size(); ++i) record.parts[i].push_back(part_ms.at(i));
    }
}

}  // namespace

Turns share_turns(std::size_t items, std::size_t block, std::size_t contenders) {
    Turns turns;
    turns.contenders = contenders;
    turns.block = std::clamp<std::size_t>(items / 16, 1, block);
    turns.blocks = std::max<std::size_t>(2, (items + turns.block - 1) / turns.block);
    while (std::gcd(turns.blocks, contenders) != 1) ++turns.blocks;
    return turns;
}

std::vector<Timing> run_rounds(const std::vector<Contender>& contenders, const Turns& turns,
                               const RoundOptions& options) {
    std::vector<Record> records(contenders.size());
    std::size_t round = 0;
    bool stopped = false;
    benchmark::ClearRegisteredBenchmarks();
    for (std::size_t c = 0; c < contenders.size(); ++c) {
        records[c].parts.resize(contenders[c].parts.size());
        benchmark::RegisterBenchmark(contenders[c].name.c_str(),
                                     [&, c](benchmark::State& state) {
                                         stopped = stopped || (options.stop && options.stop());
                                         if (stopped) {
                                             for (auto _ : state) state.SetIterationTime(0.0);
                                             return;
                                         }
                                         time_turn(state, contenders[c], turns.first(round, c), turns.items(),
                                                   options.clock, records[c]);
                                         if (options.step) options.step();
                                     })
            ->Iterations(static_cast<benchmark::IterationCount>(turns.block))
            ->UseManualTime();
    }
    Silent reporter;
    for (; round < options.repetitions * turns.blocks && !stopped; ++round)
        benchmark::RunSpecifiedBenchmarks(&reporter, "all");
    benchmark::ClearRegisteredBenchmarks();
    if (stopped) return {};

    std::vector<Timing> timings;
    for (std::size_t c = 0; c < contenders.size(); ++c) {
        timings.push_back(timing_of(contenders[c].name, contenders[c].label, records[c].whole));
        for (std::size_t p = 0; p < records[c].parts.size(); ++p)
            timings.push_back(
                timing_of(contenders[c].parts[p], contenders[c].part_labels[p], records[c].parts[p]));
    }
    return timings;
}

}  // namespace goalmouth::bench
