#include "core/conversion/particles.h"

namespace goalmouth {

particles_t to_message(const Particles& particles, std::int64_t utime, std::int64_t seq) {
    particles_t m{};
    m.utime = utime;
    m.seq = seq;
    m.num_particles = static_cast<std::int32_t>(particles.size());
    for (const Particle& p : particles) {
        m.x.push_back(static_cast<float>(p.pose.x));
        m.y.push_back(static_cast<float>(p.pose.y));
        m.theta.push_back(static_cast<float>(p.pose.theta));
        m.weight.push_back(static_cast<float>(p.weight));
    }
    return m;
}

Particles from_message(const particles_t& m) {
    Particles particles;
    for (std::size_t i = 0; i < m.x.size(); ++i)
        particles.push_back({{m.x[i], m.y[i], m.theta[i]}, m.weight[i]});
    return particles;
}

}  // namespace goalmouth
