#include "tools/evaluate/command_line.h"

namespace goalmouth {
namespace {

std::string quoted(const std::string& text) {
    constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./,=:+";
    if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result + "'";
}

}  // namespace

CommandLine& CommandLine::word(const std::string& word) {
    text_ += " " + quoted(word);
    return *this;
}

CommandLine& CommandLine::option(const std::string& name, const std::string& value) {
    if (!value.empty()) text_ += " " + name + " " + quoted(value);
    return *this;
}

}  // namespace goalmouth
