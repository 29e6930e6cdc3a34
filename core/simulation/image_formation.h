#pragma once

#include "core/parameters/parameters.h"
#include "core/simulation/exposure.h"
#include "core/simulation/light.h"
#include "core/simulation/processing.h"
#include "core/simulation/scene.h"
#include "core/simulation/sensor.h"
#include "core/simulation/shutter.h"

namespace goalmouth {

/// From a hall to the bytes of a frame: what the files of config/scenes hold. Levels are proportional to
/// light: there is no tone curve.
struct ImageFormationParameters {
    SceneParameters hall;
    LightParameters light;
    ExposureParameters exposure;
    ShutterParameters shutter;
    SensorParameters sensor;
    ProcessingParameters processing;
};

template <class Visitor>
void describe_parameters(Visitor& v, ImageFormationParameters& p) {
    v.group("hall", p.hall, "what stands in the hall");
    v.group("light", p.light, "how it is lit");
    v.group("exposure", p.exposure, "what automatic exposure and white balance do");
    v.group("shutter", p.shutter, "when the rows gather light");
    v.group("sensor", p.sensor, "how the camera turns light into levels");
    v.group("processing", p.processing, "what the camera does to a frame before it sends it");
}

}  // namespace goalmouth
