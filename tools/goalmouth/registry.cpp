#include "tools/goalmouth/registry.h"

#include "modules/camera/camera_module.h"
#include "modules/colours_adapt/colours_adapt_module.h"
#include "modules/detection_histogram/detection_histogram_module.h"
#include "modules/detection_ransac/detection_ransac_module.h"
#include "modules/detection_upright/detection_upright_module.h"
#include "modules/extraction/extraction_module.h"
#include "modules/localisation/localisation_module.h"
#include "modules/refinement/refinement_module.h"
#include "modules/segmentation/segmentation_module.h"
#include "modules/segmentation_edges/segmentation_edges_module.h"
#include "modules/simulator/simulator_module.h"
#include "modules/tap/tap_module.h"

#include <algorithm>

namespace goalmouth {

const std::vector<ModuleType>& module_types() {
    static const std::vector<ModuleType> types{
        module_type<CameraModule>(),           module_type<SimulatorModule>(),
        module_type<SegmentationModule>(),     module_type<EdgeSegmentationModule>(),
        module_type<ExtractionModule>(),       module_type<ColoursAdaptModule>(),
        module_type<RansacDetectionModule>(),  module_type<HistogramDetectionModule>(),
        module_type<UprightDetectionModule>(), module_type<RefinementModule>(),
        module_type<LocalisationModule>(),     module_type<TapModule>()};
    return types;
}

const ModuleType* find_module_type(const std::string& executable) {
    const auto& types = module_types();
    const auto found = std::find_if(types.begin(), types.end(),
                                    [&](const ModuleType& t) { return t.info.executable == executable; });
    return found == types.end() ? nullptr : &*found;
}

bool describe_module(const std::string& executable, ProgramDescription& description) {
    const ModuleType* type = find_module_type(executable);
    if (type == nullptr) return false;
    description = {type->info, type->parameters};
    return true;
}

}  // namespace goalmouth
