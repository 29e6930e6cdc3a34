#include "core/localisation/resampling.h"

#include <numeric>

namespace goalmouth {

double effective_sample_size(const Particles& particles) {
    double squares = 0.0;
    for (const Particle& p : particles) squares += p.weight * p.weight;
    return squares > 0.0 ? 1.0 / squares : 0.0;
}

std::vector<std::size_t> systematic_resample(const std::vector<double>& weights, std::size_t count,
                                             Random& random) {
    std::vector<std::size_t> chosen;
    if (weights.empty() || count == 0) return chosen;
    chosen.reserve(count);
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::size_t last =
        weights.size() - 1;  // where rounding lets a pointer pass the end: the last that has weight
    while (last > 0 && !(weights[last] > 0.0)) --last;
    const double start = random.uniform();
    std::size_t j = 0;
    double passed = weights[0];
    for (std::size_t i = 0; i < count; ++i) {
        const double pointer = (static_cast<double>(i) + start) / static_cast<double>(count) * total;
        while (j < last && passed <= pointer) passed += weights[++j];
        chosen.push_back(j);
    }
    return chosen;
}

}  // namespace goalmouth
