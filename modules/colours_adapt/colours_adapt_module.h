#pragma once

#include "core/colour_learning/goal_colour.h"
#include "core/colour_learning/light_tracker.h"
#include "core/imaging/colour_gains.h"
#include "core/imaging/colour_table.h"
#include "core/messaging/image_input.h"
#include "core/messaging/kept_frames.h"
#include "core/process/module.h"

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <goalmouth/border_t.hpp>
#include <goalmouth/posts_t.hpp>

namespace goalmouth {

/// Frames and the field borders found in them in; out go gains by which segmentation adapts its colour table
/// to the light.
class ColoursAdaptModule : public Module {
  public:
    struct Parameters {
        std::string colours;
        bool frozen = false;
        double interval = 0.5;
        double lead = 0.3;
        double least_change = 0.02;
        double repeat = 2.0;
        double least_kept = 0.25;
        LightTrackerParameters light;
        GoalColourParameters goal;
    };
    static ModuleInfo info();
    ColoursAdaptModule(ModuleContext& context, const Parameters& parameters);

  private:
    /// What segmentation has from a time on.
    struct Said {
        std::int64_t from_utime = 0;
        ColourTable table;
    };
    /// What posts looked like in a frame.
    struct Seen {
        std::int64_t utime = 0;
        std::vector<Eigen::Vector3d> colours;
    };

    void begin_anew();
    void take(const border_t& message);
    void take(const posts_t& message);
    const ColourTable& latest_table() const;
    const ColourTable& table_of(std::int64_t utime) const;
    void learn_from_posts(std::int64_t utime);
    void search(const Frame& frame, const border_t& message);
    void say(const border_t& message);
    void publish_gains(const border_t& message);

    ModuleContext& context_;
    Parameters parameters_;
    ColourTable base_;
    LightTracker tracker_;
    GoalColour goal_;
    ColourGains said_;
    KnownColours said_known_;
    std::deque<Said> tables_;                  // base_ under what was said, the latest few, oldest first
    std::deque<Seen> seen_;                    // not learnt from yet
    std::optional<std::int64_t> said_at_;      // µs
    std::optional<std::int64_t> tried_at_;     // µs: to adapt, said or not
    std::optional<std::int64_t> searched_at_;  // µs
    std::optional<std::int64_t> latest_;       // µs
    KeptFrames frames_;
    ImageInput images_;
};

template <class Visitor>
void describe_parameters(Visitor& v, ColoursAdaptModule::Parameters& p) {
    v("colours", p.colours, File{}, "colour table, the one segmentation has");
    v("frozen", p.frozen, "say nothing: the table stays as it is");
    v("interval", p.interval, Range{0, 60}, "s", "least time between two messages");
    v("lead", p.lead, Range{0, 10}, "s",
      "gains hold for frames taken so much later than the one they follow from: longer than a message is on "
      "its "
      "way, so that a replay takes them for the same frames");
    v("least_change", p.least_change, Range{0, 1}, "1",
      "gains are said once one differs by that share from what was said");
    v("repeat", p.repeat, Range{0.1, 3600}, "s",
      "gains are said again after so long, for a segmentation that missed them or was started since");
    v("least_kept", p.least_kept, Range{0, 1}, "1",
      "gains are not said that leave less of the posts' colours: what held before is better");
    v.group("light", p.light, "how the field's look is followed");
    v.group("goal", p.goal, "how the posts' colour becomes known");
}

}  // namespace goalmouth
