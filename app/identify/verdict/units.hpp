// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What unit numbers are in, by how they lie, where a name says none or another one.

#include <string>
#include <vector>

#include "app/identify/verdict/meaning.hpp"

namespace graben::identify {

/// value * scale + offset is in our unit: a ratio of -1 .. 1, rad or m.
struct UnitGuess {
  double scale = 1.0;
  double offset = 0.0;
  std::string said;  ///< "degrees", "per mille by its name".
};

/// Of a command: a ratio, %, per mille, else parts of its largest value; one that rests in the
/// middle of positive numbers, as a joystick's or a PWM's, counts from there.
[[nodiscard]] UnitGuess command_unit(const std::vector<double>& values, Unit named, bool one_sided);

/// Of a position.
[[nodiscard]] UnitGuess position_unit(const std::vector<double>& values, Unit named, bool length,
                                      bool turns);

}  // namespace graben::identify
