#pragma once

#include <cstddef>

#include <Eigen/Core>

namespace goalmouth {

/// Sums over every eighth of many terms, so that they do not depend on how long vectors are.
struct LaneSums {
    static constexpr std::size_t lanes = 8;
    alignas(64) double parts[lanes];

    double total() const {
        double sum = 0.0;
        for (const double part : parts) sum += part;
        return sum;
    }
};

/// Such sums for the equations of four unknowns.
struct EquationSums {
    LaneSums information[10];  // from the diagonal on, row by row
    LaneSums pull[4];

    Eigen::Matrix4d total_information() const {
        Eigen::Matrix4d total;
        const LaneSums* sum = information;
        for (int i = 0; i < 4; ++i)
            for (int k = i; k < 4; ++k) total(i, k) = total(k, i) = (sum++)->total();
        return total;
    }
    Eigen::Vector4d total_pull() const {
        return {pull[0].total(), pull[1].total(), pull[2].total(), pull[3].total()};
    }
};

}  // namespace goalmouth
