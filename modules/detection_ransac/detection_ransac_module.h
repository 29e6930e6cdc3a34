#pragma once

#include "core/detection/ransac_detector.h"
#include "core/process/module.h"

#include <string>

#include <goalmouth/candidates_t.hpp>

namespace goalmouth {

/// Candidates in, goalposts by the paper's RANSAC out.
class RansacDetectionModule : public Module {
  public:
    struct Parameters : RansacDetectorParameters {
        std::string field;
    };
    static ModuleInfo info();
    RansacDetectionModule(ModuleContext& context, const Parameters& parameters);

  private:
    void detect(const candidates_t& message);

    ModuleContext& context_;
    RansacDetector detector_;
};

template <class Visitor>
void describe_parameters(Visitor& v, RansacDetectionModule::Parameters& p) {
    v("field", p.field, File{true}, "field whose posts are sought (their diameter); empty: KidSize 2013");
    describe_parameters(v, static_cast<RansacDetectorParameters&>(p));
}

}  // namespace goalmouth
