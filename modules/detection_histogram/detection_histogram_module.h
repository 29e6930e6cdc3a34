#pragma once

#include "core/detection/histogram_detector.h"
#include "core/process/module.h"

#include <string>

#include <goalmouth/candidates_t.hpp>

namespace goalmouth {

/// Candidates in, goalposts by the paper's 1-dimensional histogram out.
class HistogramDetectionModule : public Module {
  public:
    struct Parameters : HistogramParameters {
        std::string field;
    };
    static ModuleInfo info();
    HistogramDetectionModule(ModuleContext& context, const Parameters& parameters);

  private:
    void detect(const candidates_t& message);

    ModuleContext& context_;
    HistogramDetector detector_;
};

template <class Visitor>
void describe_parameters(Visitor& v, HistogramDetectionModule::Parameters& p) {
    v("field", p.field, File{true}, "field whose posts are sought (their diameter); empty: KidSize 2013");
    describe_parameters(v, static_cast<HistogramParameters&>(p));
}

}  // namespace goalmouth
