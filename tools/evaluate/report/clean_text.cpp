#include "tools/evaluate/report/clean_text.h"

#include <algorithm>
#include <cstdint>

namespace goalmouth {
namespace {

std::uint8_t byte_at(const std::string& text, std::size_t i) {
    return i < text.size() ? static_cast<std::uint8_t>(text[i]) : 0;
}

/// Bytes of the character that begins at `i`; 0 where there is none (overlong forms and surrogates too).
std::size_t character_length(const std::string& text, std::size_t i) {
    const std::uint8_t first = byte_at(text, i);
    const std::uint8_t second = byte_at(text, i + 1);
    if (first < 0x80) return 1;
    std::size_t length = 0;
    std::uint8_t lowest = 0x80;
    std::uint8_t highest = 0xBF;
    if (first >= 0xC2 && first <= 0xDF) {
        length = 2;
    } else if (first >= 0xE0 && first <= 0xEF) {
        length = 3;
        if (first == 0xE0) lowest = 0xA0;
        if (first == 0xED) highest = 0x9F;
    } else if (first >= 0xF0 && first <= 0xF4) {
        length = 4;
        if (first == 0xF0) lowest = 0x90;
        if (first == 0xF4) highest = 0x8F;
    } else {
        return 0;
    }
    if (second < lowest || second > highest) return 0;
    for (std::size_t k = 2; k < length; ++k) {
        if ((byte_at(text, i + k) & 0xC0) != 0x80) return 0;
    }
    return length;
}

}  // namespace

std::string clean_text(const std::string& text) {
    const std::string replacement = "\xEF\xBF\xBD";
    std::string result;
    result.reserve(text.size());
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = character_length(text, i);
        const std::uint8_t first = byte_at(text, i);
        if (length == 0) {
            result += replacement;
        } else if (length > 1 || first == '\n' || first == '\t' || (first >= 0x20 && first != 0x7F)) {
            result.append(text, i, length);
        }
        i += std::max<std::size_t>(length, 1);
    }
    return result;
}

std::size_t characters_in(const std::string& text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace goalmouth
