#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace goalmouth::bench {

/// A stretch of a line in the picture [px] where a contender sees the side of something.
struct SeenEdge {
    Eigen::Vector2d from = Eigen::Vector2d::Zero();
    Eigen::Vector2d to = Eigen::Vector2d::Zero();
};

/// What a contender made of its last item, for people to see that it does its work.
struct Finding {
    double count = 0.0;  // of what Contender::finds says
    std::vector<SeenEdge> edges;
};

/// One that is timed: it works on item 0, 1, 2, … (a frame, a set of points) and keeps its memory between
/// them.
struct Contender {
    std::string name;      // of results
    std::string label;     // for people
    std::string settings;  // what it is, with its parameters
    std::string finds;     // "lines", "contours of 100 px or more"; empty: nothing to count
    /// The work. Parts that it times itself, [ms], go where `parts` names them; else it leaves the vector as
    /// it is.
    std::function<void(std::size_t item, std::vector<double>& part_ms)> run;
    std::function<Finding()> finding = {};  // of the last item; not timed
    std::vector<std::string> parts = {};    // names of results for the parts
    std::vector<std::string> part_labels = {};
};

/// The times of one contender, or of a part of it [ms].
struct Timing {
    std::string name;
    std::string label;
    std::size_t count = 0;
    double median = 0.0;
    double p25 = 0.0;
    double p75 = 0.0;
    double p95 = 0.0;
    double least = 0.0;
    double mean = 0.0;
};

/// Sorts `ms`. Not for none.
Timing timing_of(std::string name, std::string label, std::vector<double> ms);

/// What a stopwatch counts. The thread's own time leaves out what other programs take from it, which hits
/// long work more than short; asking for it costs some tenths of a microsecond, too much for work of
/// microseconds.
enum class StopwatchClock { wall, thread };

/// Milliseconds since it was made or last asked.
class Stopwatch {
  public:
    explicit Stopwatch(StopwatchClock clock = StopwatchClock::wall);
    double lap();

  private:
    StopwatchClock clock_;
    double last_;
};

}  // namespace goalmouth::bench
