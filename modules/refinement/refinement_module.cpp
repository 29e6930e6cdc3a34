#include "modules/refinement/refinement_module.h"

#include "core/conversion/intrinsics.h"
#include "core/conversion/kinematics.h"
#include "core/conversion/posts.h"
#include "core/conversion/refinement.h"
#include "core/messaging/channels.h"
#include "core/messaging/typed.h"
#include "core/process/configuration.h"

#include <algorithm>
#include <exception>
#include <fmt/format.h>
#include <tuple>
#include <utility>

#include <spdlog/spdlog.h>

namespace goalmouth {
namespace {

constexpr std::size_t most_overwritten = 64;

}  // namespace

ModuleInfo RefinementModule::info() {
    return {"refinement",
            "Measures goalposts anew, to a fraction of a pixel, in the frames they were found in.",
            {{channels::posts, "posts_t", "goalposts of each frame"},
             {channels::image, "image_t", "the frames, pixels in shared memory", true},
             {channels::image_tap, "image_t", "self-contained frames, for replay", true},
             {channels::image_slices, "image_slice_t", "self-contained frames in pieces, for replay", true},
             {channels::kinematics, "kinematics_t",
              "where the camera was; without it, it is taken to stand about level", true}},
            {{channels::posts_refined, "posts_t",
              "the same posts in the same order, measured anew where that is possible"},
             {channels::refinement, "refinement_t", "how they were measured, or why not"}}};
}

RefinementModule::RefinementModule(ModuleContext& context, const Parameters& parameters)
    : context_(context),
      refiner_(parameters, load_parameters_or_defaults<Field>(parameters.field)),
      frames_(static_cast<std::size_t>(parameters.frames)),
      aligner_(parameters.timing),
      images_(
          context.bus, context.channel(channels::image), context.channel(channels::image_tap),
          context.channel(channels::image_slices), [this](const Frame& frame) { take(frame); },
          Delivery::every) {
    images_.on_overwritten([this](const image_t& descriptor) {
        const FrameMark frame{descriptor.utime, descriptor.seq};
        if (overwritten_.size() >= most_overwritten) overwritten_.pop_front();
        overwritten_.push_back(frame);
        answer(aligner_.add_picture(frame));
    });
    subscribe<posts_t>(context.bus, context.channel(channels::posts),
                       [this](const posts_t& message) { take(message); });
    subscribe<kinematics_t>(
        context.bus, context.channel(channels::kinematics), [this](const kinematics_t& message) {
            answer(aligner_.add(from_message(message)));
            context_.status.set("kinematics_out_of_order", static_cast<double>(aligner_.out_of_order()));
        });
}

RefinementModule::~RefinementModule() {
    try {
        answer(aligner_.flush());
    } catch (const std::exception& error) {
        spdlog::error(fmt::format("{} frames are not answered: {}", waiting_.size(), error.what()));
    }
}

void RefinementModule::take(const Frame& frame) {
    context_.status.dropped(frame.dropped_before);
    frames_.keep(frame);
    answer(aligner_.add_picture({frame.utime, frame.seq}));
}

void RefinementModule::take(const posts_t& message) {
    waiting_.push_back(message);
    answer(aligner_.add_frame({message.utime, message.seq}, !message.posts.empty()));
}

void RefinementModule::answer(const std::vector<PictureAligner::Aligned>& frames) {
    for (const PictureAligner::Aligned& aligned : frames) {
        const posts_t message = std::move(waiting_.front());
        waiting_.pop_front();
        answer(message, aligned.camera);
    }
}

void RefinementModule::answer(const posts_t& message, const std::optional<CameraPose>& camera) {
    std::vector<RefinedPost> posts = measure(message, camera);
    const auto messages_of = [&] {
        return std::pair(to_message(posts_of(posts), message.utime, message.seq,
                                    from_message(message.intrinsics), message.detector + " refined"),
                         to_message(posts, message.utime, message.seq));
    };
    auto [refined, how] = messages_of();
    if (problem(refined) || problem(how)) {
        // Each frame is answered, whatever its pixels do to the measurement.
        posts = unrefined(message, "measured nonsense");
        std::tie(refined, how) = messages_of();
    }
    publish(context_.bus, context_.channel(channels::posts_refined), refined);
    context_.status.output(message.utime);
    publish(context_.bus, context_.channel(channels::refinement), how);
    for (const RefinedPost& post : posts)
        context_.status.count(post.post.has(post_flag::refined) ? "refined" : "unrefined");
}

std::vector<RefinedPost> RefinementModule::unrefined(const posts_t& message, const std::string& reason) {
    std::vector<RefinedPost> posts;
    for (const Post& post : from_message(message)) {
        posts.emplace_back().post = post;
        posts.back().post.flags &= ~post_flag::refined;
        posts.back().reason = reason;
    }
    return posts;
}

std::vector<RefinedPost> RefinementModule::measure(const posts_t& message,
                                                   const std::optional<CameraPose>& camera) {
    if (message.posts.empty()) return {};
    const FrameMark mark{message.utime, message.seq};
    const Frame* frame = frames_.find(message.utime, message.seq, message.intrinsics);
    const bool missed = std::find(overwritten_.begin(), overwritten_.end(), mark) != overwritten_.end();
    if (frame == nullptr && !missed) {
        context_.status.count("frames_without_picture");
        return unrefined(message, "no picture");
    }
    if (frame != nullptr && frame->still_valid()) {
        if (!camera) context_.status.count("frames_without_kinematics");
        const std::vector<RefinedPost>& posts =
            refiner_.refine(frame->pixels, from_message(message), from_message(message.intrinsics), camera);
        if (frame->still_valid()) return posts;
    }
    context_.status.count("frames_overwritten");
    return unrefined(message, "overwritten");
}

}  // namespace goalmouth
