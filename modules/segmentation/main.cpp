#include "core/process/run_module.h"
#include "modules/segmentation/segmentation_module.h"

int main(int argc, char** argv) {
    return goalmouth::run_module<goalmouth::SegmentationModule>(argc, argv);
}
