#include "core/process/run_module.h"
#include "modules/colours_adapt/colours_adapt_module.h"

int main(int argc, char** argv) {
    return goalmouth::run_module<goalmouth::ColoursAdaptModule>(argc, argv);
}
