#include "core/process/run_module.h"
#include "modules/refinement/refinement_module.h"

int main(int argc, char** argv) {
    return goalmouth::run_module<goalmouth::RefinementModule>(argc, argv);
}
