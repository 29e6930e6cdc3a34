#pragma once

#include "core/field/field.h"
#include "core/localisation/particle.h"
#include "core/parameters/parameters.h"
#include "core/random/random.h"

#include <string>
#include <vector>

namespace goalmouth {

/// Where the robot may be when the filter starts. The default is the start of the paper's localisation
/// experiment: on either side line, half-way between the own goal and the centre circle, facing the field
/// (KidSize 2013).
struct PriorParameters {
    std::string kind = "poses";
    std::vector<double> x = {-1.8, -1.8};
    std::vector<double> y = {2.0, -2.0};
    std::vector<double> theta = {-1.5708, 1.5708};
    double position_sigma = 0.25;
    double heading_sigma = 0.25;
    double elsewhere_share = 0.1;
};

template <class Visitor>
void describe_parameters(Visitor& v, PriorParameters& p) {
    v("kind", p.kind, Choice{"poses", "own_half", "field"},
      "poses: near one of the poses below; own_half, field: anywhere there, in any direction");
    v("x", p.x, Range{-100, 100}, "m",
      "start poses, field frame; x, y and theta have one entry for each pose");
    v("y", p.y, Range{-100, 100}, "m", "start poses");
    v("theta", p.theta, Range{-7, 7}, "rad", "start poses; 0 looks at the opponents' goal");
    v("position_sigma", p.position_sigma, Range{0, 10}, "m", "σ about a start pose, in x and in y");
    v("heading_sigma", p.heading_sigma, Range{0, 4}, "rad", "σ about a start pose's heading");
    v("elsewhere_share", p.elsewhere_share, Range{0, 1}, "1",
      "with poses: share of the belief that is anywhere in the own half");
}

/// A sentence about lists that do not fit together; "" where they do.
std::string prior_problem(const PriorParameters& parameters);

/// `count` ≥ 1 particles of equal weight. Start poses get equal numbers of particles, one after the other.
Particles draw_prior(const Field& field, const PriorParameters& parameters, int count, Random& random);

}  // namespace goalmouth
