#include "tools/evaluate/evaluate.h"

#include "tools/evaluate/colour_matrix.h"
#include "tools/evaluate/images.h"
#include "tools/evaluate/light.h"
#include "tools/evaluate/localisation.h"

#include <CLI/CLI.hpp>

namespace goalmouth {

void add_evaluate_verb(CLI::App& app, Action& action) {
    CLI::App* verb = app.add_subcommand(
        "evaluate", "Measure detection, distance and localisation against truth the detectors cannot see");
    verb->require_subcommand(1);
    verb->fallthrough(false);
    add_evaluate_paper(*verb, action);
    add_evaluate_localisation(*verb, action);
    add_evaluate_images(*verb, action);
    add_evaluate_colours(*verb, action);
    add_evaluate_light(*verb, action);
    add_evaluate_merge(*verb, action);
}

}  // namespace goalmouth
