#include "tests/bench/ratio.h"

#include <utility>

namespace goalmouth::bench {

Ratio time_ratio(std::string name, double ours_ms, std::string other, double other_ms, double bar,
                 double stretch) {
    return {std::move(name), ours_ms, std::move(other), other_ms, ours_ms / other_ms, bar, stretch, {}};
}

}  // namespace goalmouth::bench
