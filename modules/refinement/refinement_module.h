#pragma once

#include "core/alignment/picture_aligner.h"
#include "core/messaging/image_input.h"
#include "core/messaging/kept_frames.h"
#include "core/process/module.h"
#include "core/refinement/post_refiner.h"

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include <goalmouth/posts_t.hpp>

namespace goalmouth {

/// Goalposts and the frames they were found in; out go the same posts, measured anew in the frames' pixels.
class RefinementModule : public Module {
  public:
    struct Parameters : RefinementParameters {
        std::string field;
        int frames = 10;
        PictureTimingParameters timing;
    };
    static ModuleInfo info();
    RefinementModule(ModuleContext& context, const Parameters& parameters);
    /// Answers the posts that still wait, as they are.
    ~RefinementModule() override;

  private:
    void take(const posts_t& message);
    void take(const Frame& frame);
    void answer(const std::vector<PictureAligner::Aligned>& frames);
    void answer(const posts_t& message, const std::optional<CameraPose>& camera);
    std::vector<RefinedPost> measure(const posts_t& message, const std::optional<CameraPose>& camera);
    std::vector<RefinedPost> unrefined(const posts_t& message, const std::string& reason);

    ModuleContext& context_;
    PostRefiner refiner_;
    KeptFrames frames_;
    PictureAligner aligner_;
    std::deque<posts_t> waiting_;        // as in aligner_
    std::deque<FrameMark> overwritten_;  // the last few
    ImageInput images_;
};

template <class Visitor>
void describe_parameters(Visitor& v, RefinementModule::Parameters& p) {
    v("field", p.field, File{true}, "field and goals; empty: KidSize 2013");
    v("frames", p.frames, Range{1, 100}, "frames",
      "pictures kept for posts that come later; of more, from all cameras, within timing.wait some may be "
      "gone");
    v.group("timing", p.timing, "how posts, pictures and kinematics are brought together");
    describe_parameters(v, static_cast<RefinementParameters&>(p));
}

}  // namespace goalmouth
