#pragma once

#include "core/localisation/localiser.h"
#include "core/process/module.h"

#include <string>
#include <vector>

namespace goalmouth {

/// Goalposts, odometry and kinematics in; the robot's pose on the field out.
class LocalisationModule : public Module {
  public:
    struct Parameters {
        std::string field;
        LocaliserParameters localiser;
    };
    static ModuleInfo info();
    LocalisationModule(ModuleContext& context, const Parameters& parameters);

  private:
    void send(const std::vector<Localiser::Output>& outputs);
    void report();

    ModuleContext& context_;
    Localiser localiser_;
    LocaliserCounters reported_;
};

template <class Visitor>
void describe_parameters(Visitor& v, LocalisationModule::Parameters& p) {
    v("field", p.field, File{true}, "field and goals; empty: KidSize 2013");
    describe_parameters(v, p.localiser);
}

}  // namespace goalmouth
