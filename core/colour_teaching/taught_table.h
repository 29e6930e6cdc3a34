#pragma once

#include "core/colour_teaching/colour_mark.h"
#include "core/imaging/colour.h"
#include "core/imaging/colour_table.h"
#include "core/imaging/yuyv.h"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace goalmouth {

/// The colours a person marked, by class.
using ClassSamples = std::array<std::vector<CountedColour>, colour_count>;

/// The table that ColourTrainer makes of them; nothing where no class but unclassified has a sample.
std::optional<ColourTable> taught_table(const ClassSamples& samples, int bits, const std::string& name);

/// Shares of the samples, by the class the table gives them. There must be samples.
std::array<double, colour_count> shares_by_class(std::span<const CountedColour> samples,
                                                 const ColourTable& table);

/// Classes that were taught the same colours cannot be told apart, so one of them would be lost: a class of
/// which less than half comes back, and more as another one. The sentence that says which; "" if there is
/// none.
std::string clash_of_classes(const ClassSamples& samples, const ColourTable& table);

/// Whether no pixel is brighter than 16 of 255: a covered lens, or a camera that was not ready.
bool is_black(YuyvView picture);

}  // namespace goalmouth
