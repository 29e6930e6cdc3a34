#include "core/process/run_module.h"
#include "modules/detection_upright/detection_upright_module.h"

int main(int argc, char** argv) {
    return goalmouth::run_module<goalmouth::UprightDetectionModule>(argc, argv);
}
