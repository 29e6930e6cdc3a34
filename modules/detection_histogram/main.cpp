#include "core/process/run_module.h"
#include "modules/detection_histogram/detection_histogram_module.h"

int main(int argc, char** argv) {
    return goalmouth::run_module<goalmouth::HistogramDetectionModule>(argc, argv);
}
