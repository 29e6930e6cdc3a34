#include "core/process/run_module.h"
#include "modules/simulator/simulator_module.h"

int main(int argc, char** argv) {
    return goalmouth::run_module<goalmouth::SimulatorModule>(argc, argv);
}
