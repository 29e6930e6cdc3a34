#include "tests/bench/ratio.h"

#include <utility>

namespace goalmouth::bench {

Ratio time_ratio(std::string name, double ours_ms, std::string other, double other_ms, double bar,
                 double stretch) {
    Ratio row;
    row.name = std::move(name);
    row.ours_ms = ours_ms;
    row.other = std::move(other);
    row.other_ms = other_ms;
    row.ratio = ours_ms / other_ms;
    row.bar = bar;
    row.stretch = stretch;
    return row;
}

}  // namespace goalmouth::bench
