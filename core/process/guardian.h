#pragma once

#include <functional>
#include <set>
#include <sys/types.h>

namespace goalmouth {

/// Process groups that hold at least one process that is not a zombie.
std::set<pid_t> living_groups();

/// A process of its own that outlives this one by a moment: when this process dies, however that happens, it
/// ends every process group it was told of (SIGTERM, after the grace time SIGKILL), does a last errand, and
/// goes.
///
/// Forked without exec: make it early, before there are threads.
class Guardian {
  public:
    /// `grace` [s]; `errand` runs in the guardian, after the groups are gone.
    Guardian(double grace, std::function<void()> errand);
    /// Lets it go: nothing is ended.
    ~Guardian();
    Guardian(const Guardian&) = delete;
    Guardian& operator=(const Guardian&) = delete;

    void watch(pid_t group);
    void forget(pid_t group);
    /// Puts a new one in its place if it was killed. True if it did.
    bool keep_alive();
    pid_t pid() const { return pid_; }

  private:
    void fork_it();
    void tell(char what, pid_t group) const;
    void end();

    double grace_;
    std::function<void()> errand_;
    std::set<pid_t> groups_;
    pid_t pid_ = 0;
    int line_ = -1;  // our end of a socket pair; its end of file is what the guardian waits for
};

}  // namespace goalmouth
