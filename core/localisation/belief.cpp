#include "core/localisation/belief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <tuple>

namespace goalmouth {
namespace {

constexpr double kernel_position = 0.01;  // m
constexpr double kernel_heading = 0.01;   // rad

using Key = std::array<int, 3>;

struct Cell {
    double weight = 0.0;
    std::vector<std::size_t> members;
    int cluster = -1;
};

using Cells = std::map<Key, Cell>;  // ordered: what is found first must not depend on hashing

template <class F>
void for_each_neighbour(Cells& cells, const Key& key, int headings, F visit) {
    for (int dx = -1; dx <= 1; ++dx) {
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dh = -1; dh <= 1; ++dh) {
                const auto found =
                    cells.find({key[0] + dx, key[1] + dy, (key[2] + dh + headings) % headings});
                if (found != cells.end()) visit(found->first, found->second);
            }
        }
    }
}

Cells sort_into_cells(const Particles& particles, const ClusterParameters& parameters) {
    Cells cells;
    const auto index = [&](double position) {
        return static_cast<int>(std::floor(std::clamp(position / parameters.cell, -1e6, 1e6)));
    };
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const Pose2& p = particles[i].pose;
        const double turn = (wrap_angle(p.theta) + std::numbers::pi) / (2.0 * std::numbers::pi);
        const int heading = std::min(parameters.headings - 1, static_cast<int>(turn * parameters.headings));
        Cell& cell = cells[{index(p.x), index(p.y), heading}];
        cell.weight += particles[i].weight;
        cell.members.push_back(i);
    }
    return cells;
}

int join_cores(Cells& cells, const ClusterParameters& parameters) {
    int clusters = 0;
    for (auto& [first, start] : cells) {
        if (start.weight < parameters.core_share || start.cluster >= 0) continue;
        start.cluster = clusters;
        std::vector<Key> open{first};
        while (!open.empty()) {
            const Key key = open.back();
            open.pop_back();
            for_each_neighbour(cells, key, parameters.headings, [&](const Key& other, Cell& cell) {
                if (cell.weight < parameters.core_share || cell.cluster >= 0) return;
                cell.cluster = clusters;
                open.push_back(other);
            });
        }
        ++clusters;
    }
    return clusters;
}

}  // namespace

PoseHypothesis summarise(const Particles& particles) {
    PoseHypothesis result;
    for (const Particle& p : particles) result.weight += p.weight;
    const bool weighted = result.weight > 0.0;
    const double total = weighted ? result.weight : static_cast<double>(particles.size());
    double s = 0.0;
    double c = 0.0;
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const Particle& p : particles) {
        const double w = (weighted ? p.weight : 1.0) / total;
        mean += w * p.pose.position();
        s += w * std::sin(p.pose.theta);
        c += w * std::cos(p.pose.theta);
    }
    result.pose = {mean.x(), mean.y(), std::hypot(s, c) > 1e-9 ? std::atan2(s, c) : 0.0};
    for (const Particle& p : particles) {
        const double w = (weighted ? p.weight : 1.0) / total;
        const Eigen::Vector3d d(p.pose.x - mean.x(), p.pose.y - mean.y(),
                                wrap_angle(p.pose.theta - result.pose.theta));
        result.covariance += w * d * d.transpose();
    }
    result.covariance.diagonal() +=
        Eigen::Vector3d(kernel_position * kernel_position, kernel_position * kernel_position,
                        kernel_heading * kernel_heading);
    return result;
}

std::vector<PoseHypothesis> cluster(const Particles& particles, const ClusterParameters& parameters) {
    if (particles.empty()) return {};
    Cells cells = sort_into_cells(particles, parameters);
    const int clusters = join_cores(cells, parameters);

    std::vector<Particles> members(static_cast<std::size_t>(clusters));
    for (auto& [key, cell] : cells) {
        int target = cell.cluster;
        double heaviest = 0.0;
        if (target < 0) {
            for_each_neighbour(cells, key, parameters.headings, [&](const Key&, Cell& other) {
                if (other.weight < parameters.core_share || other.weight <= heaviest) return;
                heaviest = other.weight;
                target = other.cluster;
            });
        }
        if (target < 0) continue;
        for (const std::size_t i : cell.members)
            members[static_cast<std::size_t>(target)].push_back(particles[i]);
    }

    std::vector<PoseHypothesis> result;
    for (const Particles& group : members) {
        PoseHypothesis hypothesis = summarise(group);
        if (hypothesis.weight >= parameters.least_share) result.push_back(std::move(hypothesis));
    }
    if (result.empty()) result.push_back(summarise(particles));
    std::sort(result.begin(), result.end(), [](const PoseHypothesis& a, const PoseHypothesis& b) {
        return std::tuple(-a.weight, a.pose.x, a.pose.y, a.pose.theta) <
               std::tuple(-b.weight, b.pose.x, b.pose.y, b.pose.theta);
    });
    if (result.size() > static_cast<std::size_t>(parameters.most_hypotheses)) {
        result.resize(static_cast<std::size_t>(parameters.most_hypotheses));
    }
    return result;
}

}  // namespace goalmouth
