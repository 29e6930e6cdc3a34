#include "core/process/run_module.h"
#include "modules/tap/tap_module.h"

int main(int argc, char** argv) {
    return goalmouth::run_module<goalmouth::TapModule>(argc, argv);
}
