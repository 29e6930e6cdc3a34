#pragma once

#include <string>

namespace goalmouth::test {

/// "" where every element of the HTML or SVG text is closed in order, quotes end and ampersands begin a
/// reference; else what is wrong first.
std::string fault_in_markup(const std::string& text);

/// "" where every id is there once; else the first that is not.
std::string repeated_id(const std::string& html);

std::size_t count(const std::string& text, const std::string& part);

}  // namespace goalmouth::test
