#pragma once

#include <cstdint>

namespace goalmouth::test {

/// Blocks of memory the calling thread has asked the heap for since it began, by whatever way: new, malloc,
/// and what libraries do with them.
std::uint64_t allocations();

/// Whether allocations() counts here: not under a sanitizer, which has a heap of its own, nor with another C
/// library than glibc.
bool allocations_are_counted();

/// The calling thread's allocations since this was made:
///
///     const AllocationCount count;
///     stage.run(frame);
///     EXPECT_EQ(count.so_far(), 0U);
class AllocationCount {
  public:
    AllocationCount() : before_(allocations()) {}
    std::uint64_t so_far() const { return allocations() - before_; }

  private:
    std::uint64_t before_;
};

}  // namespace goalmouth::test
