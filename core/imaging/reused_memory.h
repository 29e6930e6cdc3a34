#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace goalmouth {

/// Memory that is used for one image after the other gets a size. One large image does not keep its memory
/// for ever: what is megabytes and more than four times what is needed now is given back first. Then what the
/// memory held is lost.
inline void fit(std::vector<std::uint8_t>& memory, std::size_t bytes) {
    constexpr std::size_t worth_giving_back = std::size_t{1} << 20;
    if (memory.capacity() > worth_giving_back && bytes < memory.capacity() / 4)
        std::vector<std::uint8_t>().swap(memory);
    memory.resize(bytes);
}

}  // namespace goalmouth
