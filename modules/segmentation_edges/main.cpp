#include "core/process/run_module.h"
#include "modules/segmentation_edges/segmentation_edges_module.h"

int main(int argc, char** argv) {
    return goalmouth::run_module<goalmouth::EdgeSegmentationModule>(argc, argv);
}
