#pragma once

#include <cstddef>
#include <string>

namespace goalmouth {

/// `text` as valid UTF-8 without control characters: bytes that are none become U+FFFD; line ends and tabs
/// stay.
std::string clean_text(const std::string& text);

/// Characters in valid UTF-8.
std::size_t characters_in(const std::string& text);

}  // namespace goalmouth
