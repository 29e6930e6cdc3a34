#include "tools/evaluate/shard.h"

#include "core/process/configuration.h"

#include <charconv>

namespace goalmouth {

Shard parse_shard(const std::string& text, const std::string& option) {
    constexpr int most = 1'000'000;
    const auto number = [](const char* begin, const char* end) {
        int value = 0;
        const auto [stopped, error] = std::from_chars(begin, end, value);
        return error == std::errc{} && stopped == end ? value : -1;
    };
    const std::size_t slash = text.find('/');
    if (slash != std::string::npos) {
        const Shard shard{number(text.data(), text.data() + slash),
                          number(text.data() + slash + 1, text.data() + text.size())};
        if (shard.part >= 1 && shard.part <= shard.parts && shard.parts <= most) return shard;
    }
    throw ConfigurationError(option + ": \"" + text +
                             "\" is no part of a whole; expected I/N with 1 ≤ I ≤ N, such as 2/4");
}

std::string shard_text(const Shard& shard) {
    return std::to_string(shard.part) + "/" + std::to_string(shard.parts);
}

}  // namespace goalmouth
