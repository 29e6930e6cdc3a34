#pragma once

#include "core/alignment/latest_poses.h"
#include "core/edges/edge_segmentation.h"
#include "core/messaging/image_input.h"
#include "core/process/module.h"
#include "core/segmentation/scan_lines.h"

#include <string>

namespace goalmouth {

/// Camera frames in, segments of posts and field out, without a colour table.
class EdgeSegmentationModule : public Module {
  public:
    struct Parameters {
        std::string field;
        ScanLineParameters scan_lines;
        EdgeSegmentationParameters segmentation;
    };
    static ModuleInfo info();
    EdgeSegmentationModule(ModuleContext& context, const Parameters& parameters);

  private:
    void segment(const Frame& frame);

    ModuleContext& context_;
    double diameter_;  // m, of posts
    EdgeSegmenter segmenter_;
    LatestScanLayout layout_;
    LatestPoses poses_;  // T_BC
    ImageInput images_;
};

template <class Visitor>
void describe_parameters(Visitor& v, EdgeSegmentationModule::Parameters& p) {
    v("field", p.field, File{true},
      "field whose posts are sought (their diameter, where kinematics are known); empty: KidSize 2013");
    v.group("scan_lines", p.scan_lines, "which rows and columns are looked at");
    describe_parameters(v, p.segmentation);
}

}  // namespace goalmouth
