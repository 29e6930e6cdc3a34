#include "core/process/run_module.h"
#include "modules/localisation/localisation_module.h"

int main(int argc, char** argv) {
    return goalmouth::run_module<goalmouth::LocalisationModule>(argc, argv);
}
