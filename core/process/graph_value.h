#pragma once

#include <string>

namespace goalmouth {

/// Whether a value, as YAML, is what a program's description says is valid: one of the forms that
/// parameters.h's rules give
///     a number | a whole number | a list of numbers, each with  in A…B | of at least A | above A |
///     of at most B  or nothing behind it
///     true or false | one of: A, B, C | the name of a file | a text
/// Anything holds against a description of another form: the program itself will judge.
bool value_is_valid(const std::string& value, const std::string& valid);

}  // namespace goalmouth
