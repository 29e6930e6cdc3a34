#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>

#include <Eigen/Geometry>

namespace goalmouth {

/// The latest few poses of a camera, for stages that want to know roughly how it stood and do not wait for
/// it.
class LatestPoses {
  public:
    void add(std::int64_t utime, const Eigen::Isometry3d& T_BC) {
        // Time ran back: a replay began again.
        if (!poses_.empty() && utime < poses_.rbegin()->first - backwards) poses_.clear();
        poses_[utime] = T_BC;
        if (poses_.size() > kept) poses_.erase(poses_.begin());
    }
    /// The latest that is not younger than `utime`.
    std::optional<Eigen::Isometry3d> at(std::int64_t utime) const {
        const auto after = poses_.upper_bound(utime);
        if (after == poses_.begin()) return std::nullopt;
        return std::prev(after)->second;
    }

  private:
    static constexpr std::size_t kept = 64;
    static constexpr std::int64_t backwards = 1'000'000;  // µs
    std::map<std::int64_t, Eigen::Isometry3d> poses_;
};

}  // namespace goalmouth
