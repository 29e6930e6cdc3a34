#include "tests/core/segmentation/guarded_image.h"

#include <sys/mman.h>
#include <system_error>
#include <unistd.h>

namespace goalmouth::test {

GuardedImage::GuardedImage(int width, int height, int gap)
    : width_(width), height_(height), stride_(yuyv_row_bytes(width) + gap) {
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    const std::size_t bytes = static_cast<std::size_t>(height - 1) * static_cast<std::size_t>(stride_) +
                              static_cast<std::size_t>(yuyv_row_bytes(width));
    const std::size_t readable = (bytes + page - 1) / page * page;
    size_ = readable + page;
    memory_ =
        mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory_ == MAP_FAILED) throw std::system_error(errno, std::generic_category(), "guarded image");
    auto* const start = static_cast<std::uint8_t*>(memory_);
    if (mprotect(start + readable, page, PROT_NONE) != 0)
        throw std::system_error(errno, std::generic_category(), "guarded image");
    pixels_ = start + readable - bytes;
}

GuardedImage::~GuardedImage() {
    munmap(memory_, size_);
}

}  // namespace goalmouth::test
