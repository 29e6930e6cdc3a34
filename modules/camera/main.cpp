#include "core/process/run_module.h"
#include "modules/camera/camera_module.h"

int main(int argc, char** argv) {
    return goalmouth::run_module<goalmouth::CameraModule>(argc, argv);
}
