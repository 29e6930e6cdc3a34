#include "core/process/run_module.h"
#include "modules/extraction/extraction_module.h"

int main(int argc, char** argv) {
    return goalmouth::run_module<goalmouth::ExtractionModule>(argc, argv);
}
