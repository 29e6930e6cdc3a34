#include "core/localisation/prior.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace goalmouth {

std::string prior_problem(const PriorParameters& parameters) {
    if (parameters.kind != "poses") return "";
    if (parameters.x.empty()) return "initial: kind is poses, but x, y and theta list none";
    if (parameters.x.size() != parameters.y.size() || parameters.x.size() != parameters.theta.size()) {
        return "initial: x, y and theta must have the same number of entries, one for each start pose";
    }
    return "";
}

Particles draw_prior(const Field& field, const PriorParameters& parameters, int count, Random& random) {
    Particles particles;
    particles.reserve(static_cast<std::size_t>(count));
    const double weight = 1.0 / count;
    const bool poses = parameters.kind == "poses" && prior_problem(parameters).empty();
    const int near = poses ? count - static_cast<int>(std::lround(parameters.elsewhere_share * count)) : 0;
    const auto starts = static_cast<int>(parameters.x.size());
    for (int i = 0; i < near; ++i) {
        const auto k = static_cast<std::size_t>(static_cast<long>(i) * starts / near);
        particles.push_back({{parameters.x[k] + parameters.position_sigma * random.normal(),
                              parameters.y[k] + parameters.position_sigma * random.normal(),
                              wrap_angle(parameters.theta[k] + parameters.heading_sigma * random.normal())},
                             weight});
    }
    const double farthest_x = parameters.kind == "field" ? field.length / 2.0 : 0.0;
    for (int i = near; i < count; ++i) {
        const double x = random.uniform(-field.length / 2.0, farthest_x);
        const double y = random.uniform(-field.width / 2.0, field.width / 2.0);
        particles.push_back({{x, y, random.uniform(-std::numbers::pi, std::numbers::pi)}, weight});
    }
    // Neighbours in space are neighbours in the list: systematic resampling then keeps the shares of the
    // field's two halves.
    std::stable_sort(particles.begin() + near, particles.end(),
                     [](const Particle& a, const Particle& b) { return a.pose.x < b.pose.x; });
    return particles;
}

}  // namespace goalmouth
