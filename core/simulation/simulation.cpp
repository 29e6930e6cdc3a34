#include "core/simulation/simulation.h"

namespace goalmouth {
namespace {

/// Independent generators for the parts of a run: none disturbs another's numbers.
Random part(const Random& run, int number) {
    Random copy = run;
    std::uint64_t seed = 0;
    for (int i = 0; i <= number; ++i) seed = copy.bits();
    return Random(seed);
}

}  // namespace

Simulation::Simulation(const SimulationParameters& parameters, const Field& field, const Intrinsics& camera,
                       const Random& run)
    : renderer_(make_scene(field, parameters.formation.hall), camera, parameters.formation),
      walker_(parameters.walk, field, paper_route(field), part(run, 0)),
      kinematics_(parameters.kinematics, part(run, 1)),
      exposure_(parameters.formation.exposure, parameters.formation.light.temperature, part(run, 2)) {}

SimulatedFrame Simulation::capture(double time, Random& frame, std::uint8_t* out, std::ptrdiff_t stride) {
    walker_.advance(time);
    SimulatedFrame result;
    result.truth.robot = walker_.pose();
    result.truth.T_WC = walker_.T_WC();
    result.truth.ball = scene().ball.centre.head<2>();
    result.truth.posts = true_posts(scene(), camera(), result.truth.T_WC);
    result.odometry = walker_.odometry();
    result.T_BC = kinematics_.measure(walker_.T_BC(), frame);
    result.T_BC_covariance = kinematics_.covariance();
    renderer_.render({walker_.motion(), exposure_.gains(time)}, frame, out, stride);
    return result;
}

}  // namespace goalmouth
