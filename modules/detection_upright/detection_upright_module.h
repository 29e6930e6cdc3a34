#pragma once

#include "core/alignment/picture_aligner.h"
#include "core/detection/upright_detector.h"
#include "core/process/module.h"

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include <goalmouth/candidates_t.hpp>

namespace goalmouth {

/// Candidates in, goalposts out as what they are: upright things of known size.
class UprightDetectionModule : public Module {
  public:
    struct Parameters : UprightDetectorParameters {
        std::string field;
        PictureTimingParameters timing;
    };
    static ModuleInfo info();
    UprightDetectionModule(ModuleContext& context, const Parameters& parameters);
    ~UprightDetectionModule() override;

  private:
    void take(const candidates_t& message);
    void answer(const std::vector<PictureAligner::Aligned>& frames);
    void detect(const candidates_t& message, const std::optional<CameraPose>& camera);

    ModuleContext& context_;
    UprightDetector detector_;
    PictureAligner aligner_;
    std::deque<candidates_t> waiting_;  // as in the aligner
};

template <class Visitor>
void describe_parameters(Visitor& v, UprightDetectionModule::Parameters& p) {
    v("field", p.field, File{true},
      "field whose posts are sought (their diameter and height); empty: KidSize 2013");
    v.group("timing", p.timing, "how candidates and kinematics are brought together");
    describe_parameters(v, static_cast<UprightDetectorParameters&>(p));
}

}  // namespace goalmouth
