#include "tests/support/allocations.h"

#include <cerrno>
#include <cstddef>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define GOALMOUTH_COUNT_ALLOCATIONS 1
#else
#define GOALMOUTH_COUNT_ALLOCATIONS 0
#endif

namespace {

constinit thread_local std::uint64_t counted = 0;

}  // namespace

namespace goalmouth::test {

std::uint64_t allocations() {
    return counted;
}

bool allocations_are_counted() {
    return GOALMOUTH_COUNT_ALLOCATIONS != 0;
}

}  // namespace goalmouth::test

#if GOALMOUTH_COUNT_ALLOCATIONS

// A program that links this file asks the heap through these; operator new comes here too. What is freed goes
// the C library's own way.
extern "C" {

// glibc's heap under the names it keeps for this purpose.
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) noexcept {
    ++counted;
    return __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) noexcept {
    ++counted;
    return __libc_calloc(count, size);
}

void* realloc(void* block, std::size_t size) noexcept {
    ++counted;
    return __libc_realloc(block, size);
}

void* memalign(std::size_t alignment, std::size_t size) noexcept {
    ++counted;
    return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
    ++counted;
    return __libc_memalign(alignment, size);
}

int posix_memalign(void** block, std::size_t alignment, std::size_t size) noexcept {
    ++counted;
    void* const found = __libc_memalign(alignment, size);
    if (!found) return ENOMEM;
    *block = found;
    return 0;
}

}  // extern "C"

#endif
