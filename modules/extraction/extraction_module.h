#pragma once

#include "core/extraction/border.h"
#include "core/extraction/extraction.h"
#include "core/process/module.h"

#include <goalmouth/segments_t.hpp>

namespace goalmouth {

/// Colour segments in; field border and candidates for goalposts out.
class ExtractionModule : public Module {
  public:
    struct Parameters {
        BorderParameters border;
        CandidateParameters candidates;
    };
    static ModuleInfo info();
    ExtractionModule(ModuleContext& context, const Parameters& parameters);

  private:
    void extract(const segments_t& message);

    ModuleContext& context_;
    BorderFinder border_finder_;
    CandidateExtractor extractor_;
};

template <class Visitor>
void describe_parameters(Visitor& v, ExtractionModule::Parameters& p) {
    v.group("border", p.border, "field border");
    v.group("candidates", p.candidates, "what may belong to a goalpost");
}

}  // namespace goalmouth
