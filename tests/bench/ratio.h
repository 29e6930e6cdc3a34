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
    /// What was promised of more than this run shows: "for 20 s at 640x480". Empty: all of it.
    std::string scope = {};
    std::string note = {};      // how the figures came about
    std::string size = {};      // "1600x1200"; empty: of no picture's size
    int spacing = 0;            // px from scan-line to scan-line; 0: of no scan-lines
    double seconds = 0.0;       // measured; 0: not for a time
    bool measured = true;       // false: ratio, ours_ms and other_ms mean nothing
    bool tests_stretch = true;  // false: hoped for under harder conditions than this run's

    bool met() const { return measured && ratio <= bar; }
    bool stretch_met() const { return measured && tests_stretch && ratio <= stretch; }
};

/// A row of times; the ratio is worked out.
Ratio time_ratio(std::string name, double ours_ms, std::string other, double other_ms, double bar,
                 double stretch);

}  // namespace goalmouth::bench
