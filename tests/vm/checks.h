#pragma once

#include <string>

namespace goalmouth::test {

/// One line for each check; false also counts as a failure of the program.
void expect(bool holds, const std::string& what);

/// Frames by user pointers, in in_place.cpp.
void driver_writes_into_the_ring();
void vanished_driver_leaves_the_ring_alone();

}  // namespace goalmouth::test
