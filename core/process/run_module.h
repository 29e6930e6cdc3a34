#pragma once

#include "core/process/configuration.h"
#include "core/process/module.h"

#include <functional>
#include <memory>
#include <vector>

namespace goalmouth {

/// A module type as data: what a registry holds and what a program of one module runs.
struct ModuleType {
    ModuleInfo info;
    std::vector<ParameterInfo> parameters;  // with their defaults
    std::function<std::unique_ptr<Module>(ModuleContext&, const Configuration&)>
        create;  // throws ConfigurationError
};

template <class M>
ModuleType module_type() {
    return {M::info(), list_parameters<typename M::Parameters>(),
            [](ModuleContext& context, const Configuration& configuration) -> std::unique_ptr<Module> {
                return std::make_unique<M>(context, load_parameters<typename M::Parameters>(configuration));
            }};
}

/// A whole program around one module: command line, configuration, LCM, status once a second, clean end on
/// SIGINT and SIGTERM.
///
///     --lcm-url URL  --config FILE  --set KEY=VALUE …  --name NAME  --channel DEFAULT=NAME …  --seed N
///     --describe (YAML: executable, summary, subscribes, publishes, parameters)  --print-config  --help
///     --version
///
/// Without --config, config/modules/EXECUTABLE.yaml of the installation is read if there is one.
/// Exit codes: 0 ended as asked, 1 failure while running, 2 wrong command line or configuration.
int run_module_program(const ModuleType& type, int argc, char** argv);

template <class M>
int run_module(int argc, char** argv) {
    return run_module_program(module_type<M>(), argc, argv);
}

}  // namespace goalmouth
