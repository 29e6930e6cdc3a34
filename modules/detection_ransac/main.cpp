#include "core/process/run_module.h"
#include "modules/detection_ransac/detection_ransac_module.h"

int main(int argc, char** argv) {
    return goalmouth::run_module<goalmouth::RansacDetectionModule>(argc, argv);
}
