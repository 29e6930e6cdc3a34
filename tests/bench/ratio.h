#pragma once

#include <optional>
#include <string>

namespace goalmouth::bench {

/// One row of the benchmark's summary: what ours costs over what another costs in the same run, against what
/// was promised. Ratios are of medians.
struct Ratio {
    std::string name;
    double ours_ms = 0.0;
    std::string other;
    double other_ms = 0.0;
    double ratio = 0.0;
    double bar = 0.0;      // promised: at most this
    double stretch = 0.0;  // hoped for: at most this
    /// How to read ours_ms, other_ms and ratio where they are no times: "frames", "copies". Empty: times
    /// [ms].
    std::string unit = {};

    bool met() const { return ratio <= bar; }
    bool stretch_met() const { return ratio <= stretch; }
};

/// A row of times; the ratio is worked out.
Ratio time_ratio(std::string name, double ours_ms, std::string other, double other_ms, double bar,
                 double stretch);

}  // namespace goalmouth::bench
