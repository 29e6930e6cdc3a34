#pragma once

#include "core/alignment/latest_poses.h"
#include "core/imaging/colour_gains.h"
#include "core/imaging/colour_table.h"
#include "core/messaging/image_input.h"
#include "core/process/module.h"
#include "core/segmentation/scan_lines.h"
#include "core/segmentation/segmentation.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace goalmouth {

/// Camera frames in, colour segments out.
class SegmentationModule : public Module {
  public:
    struct Parameters {
        std::string colours;
        ScanLineParameters scan_lines;
    };
    static ModuleInfo info();
    SegmentationModule(ModuleContext& context, const Parameters& parameters);

  private:
    SegmentationModule(ModuleContext& context, const Parameters& parameters, const ColourTable& table);
    void segment(const Frame& frame);
    void adapt_to(std::int64_t utime);

    ModuleContext& context_;
    ColourTable table_;
    struct Light {
        ColourGains gains;
        KnownColours known;
        bool operator==(const Light&) const = default;
    };
    std::map<std::int64_t, Light> lights_;  // by the time from which they hold, the latest few
    Light applied_;
    std::optional<Segmenter> segmenter_;  // with table_ under applied_
    LatestScanLayout layout_;
    LatestPoses poses_;  // T_BC
    ImageInput images_;
};

template <class Visitor>
void describe_parameters(Visitor& v, SegmentationModule::Parameters& p) {
    v("colours", p.colours, File{}, "colour table (docs/colour_tables.md)");
    v.group("scan_lines", p.scan_lines, "which rows and columns are looked at");
}

}  // namespace goalmouth
