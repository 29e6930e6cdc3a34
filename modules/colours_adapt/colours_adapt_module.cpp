#include "modules/colours_adapt/colours_adapt_module.h"

#include "core/colour_learning/field_search.h"
#include "core/conversion/border.h"
#include "core/conversion/colour_gains.h"
#include "core/conversion/posts.h"
#include "core/messaging/channels.h"
#include "core/messaging/typed.h"
#include "core/process/colour_table_parameter.h"
#include "core/process/configuration.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

namespace goalmouth {
namespace {

constexpr std::size_t frames_kept = 10;
constexpr std::size_t tables_kept = 4;
constexpr std::size_t seen_kept = 256;
constexpr std::int64_t search_interval = 250'000;  // µs: a search takes some milliseconds

double largest_change(const ColourGains& a, const ColourGains& b) {
    return std::max(
        {std::abs(a.red / b.red - 1.0), std::abs(a.green / b.green - 1.0), std::abs(a.blue / b.blue - 1.0)});
}

std::int64_t microseconds(double seconds) {
    return std::llround(seconds * 1e6);
}

}  // namespace

ModuleInfo ColoursAdaptModule::info() {
    return {"colours_adapt",
            "Follows changes of light by the field's look, for segmentation to adapt its colour table.",
            {{channels::border, "border_t", "field border of each frame"},
             {channels::posts, "posts_t", "goalposts of each frame, for their colour", true},
             {channels::image, "image_t", "the frames, pixels in shared memory", true},
             {channels::image_tap, "image_t", "self-contained frames, for replay", true},
             {channels::image_slices, "image_slice_t", "self-contained frames in pieces, for replay", true}},
            {{channels::colour_gains, "colour_gains_t", "how light has changed since the table was made"}}};
}

ColoursAdaptModule::ColoursAdaptModule(ModuleContext& context, const Parameters& parameters)
    : context_(context),
      parameters_(parameters),
      base_(colour_table_parameter(parameters.colours, info().executable)),
      tracker_(parameters.light),
      goal_(parameters.goal),
      frames_(frames_kept),
      images_(
          context.bus, context.channel(channels::image), context.channel(channels::image_tap),
          context.channel(channels::image_slices), [this](const Frame& frame) { frames_.keep(frame); },
          Delivery::every) {
    if (parameters.goal.least_posts > parameters.goal.posts)
        throw ConfigurationError(context.name +
                                 ": goal.least_posts: " + std::to_string(parameters.goal.least_posts) +
                                 " is more than goal.posts, " + std::to_string(parameters.goal.posts));
    subscribe<border_t>(context.bus, context.channel(channels::border),
                        [this](const border_t& message) { take(message); });
    subscribe<posts_t>(context.bus, context.channel(channels::posts),
                       [this](const posts_t& message) { take(message); });
}

void ColoursAdaptModule::begin_anew() {
    tracker_ = LightTracker(parameters_.light);
    goal_ = GoalColour(parameters_.goal);
    tables_.clear();
    seen_.clear();
    said_ = {};
    said_known_ = {};
    said_at_.reset();
    tried_at_.reset();
    searched_at_.reset();
}

void ColoursAdaptModule::take(const border_t& message) {
    if (parameters_.frozen) return;
    constexpr std::int64_t backwards = 1'000'000;  // µs: a replay began again
    if (latest_ && message.utime < *latest_ - backwards) begin_anew();
    latest_ = message.utime;
    learn_from_posts(message.utime);
    // Whoever began to listen only now, or missed it, hears what holds.
    if (said_at_ && message.utime - *said_at_ >= microseconds(parameters_.repeat)) publish_gains(message);
    const Frame* frame = frames_.find(message.utime, message.seq, message.intrinsics);
    if (frame == nullptr) {
        context_.status.count("without_picture", 1);
        return;
    }
    const auto look = look_at_field(frame->pixels, from_message(message), latest_table(), parameters_.light);
    if (!frame->still_valid()) {
        context_.status.dropped(1);
        return;
    }
    if (!look) {
        context_.status.count("without_field", 1);
        search(*frame, message);
        say(message);
        return;
    }
    tracker_.follow(*look, message.utime);
    say(message);
    context_.status.set("disbelieved", tracker_.disbelieved());
}

const ColourTable& ColoursAdaptModule::latest_table() const {
    return tables_.empty() ? base_ : tables_.back().table;
}

const ColourTable& ColoursAdaptModule::table_of(std::int64_t utime) const {
    const auto holds = std::find_if(tables_.rbegin(), tables_.rend(),
                                    [&](const Said& said) { return said.from_utime <= utime; });
    return holds == tables_.rend() ? base_ : holds->table;
}

/// Posts of a frame may come before the next frame's border or after it: they are looked at with the table
/// that their frame had, and learnt from once a border is so much later that they have come for certain.
void ColoursAdaptModule::take(const posts_t& message) {
    if (parameters_.frozen || goal_.complete() || message.posts.empty()) return;
    const Frame* frame = frames_.find(message.utime, message.seq, message.intrinsics);
    if (frame == nullptr) return;
    Seen seen{message.utime, post_colours(frame->pixels, from_message(message), table_of(message.utime))};
    if (!frame->still_valid()) {
        context_.status.dropped(1);
        return;
    }
    if (seen.colours.empty()) return;
    if (seen_.size() == seen_kept) seen_.pop_front();
    seen_.push_back(std::move(seen));
}

void ColoursAdaptModule::learn_from_posts(std::int64_t utime) {
    for (; !seen_.empty() && seen_.front().utime + microseconds(parameters_.lead) <= utime; seen_.pop_front())
        if (tracker_.has_reference())
            for (const Eigen::Vector3d& colour : seen_.front().colours) goal_.see(colour, tracker_.gains());
}

void ColoursAdaptModule::search(const Frame& frame, const border_t& message) {
    if (!tracker_.has_reference()) return;
    if (searched_at_ && message.utime - *searched_at_ < search_interval) return;
    searched_at_ = message.utime;
    const auto found = search_field(frame.pixels, tracker_.reference(), parameters_.light);
    if (!frame.still_valid()) {
        context_.status.dropped(1);
        return;
    }
    if (found) tracker_.suspect(*found, message.utime);
}

/// Also what could not be said before for want of `interval`. What leaves nothing of the posts' colours is
/// not said: the last table that told them from the field finds some of them yet.
void ColoursAdaptModule::say(const border_t& message) {
    const bool better_known = said_ != ColourGains{} && !said_known_.goal && goal_.levels();
    if (largest_change(tracker_.gains(), said_) < parameters_.least_change && !better_known) return;
    const auto since = [&](std::int64_t then) { return message.utime - then; };
    if (said_at_ && since(*said_at_) < microseconds(parameters_.interval)) return;
    if (tried_at_ && since(*tried_at_) < microseconds(parameters_.interval)) return;
    tried_at_ = message.utime;
    const KnownColours known{tracker_.reference(), goal_.levels()};
    ColourTable table = adapted(base_, tracker_.gains(), known);
    if (goals_kept(base_, table, tracker_.gains(), known) < parameters_.least_kept) {
        context_.status.count("posts_not_told", 1);
        return;
    }
    said_ = tracker_.gains();
    said_known_ = known;
    tables_.push_back({message.utime + microseconds(parameters_.lead), std::move(table)});
    if (tables_.size() > tables_kept) tables_.pop_front();
    publish_gains(message);
}

void ColoursAdaptModule::publish_gains(const border_t& message) {
    said_at_ = message.utime;
    publish(context_.bus, context_.channel(channels::colour_gains),
            to_message(said_, said_known_, message.utime, message.seq,
                       message.utime + microseconds(parameters_.lead)));
    context_.status.output(message.utime);
}

}  // namespace goalmouth
