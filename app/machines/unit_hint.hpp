// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which other unit a number that is out of range may have been written in.

#include <string>

namespace graben::machines {

/// "; in rpm? then it is 151.8 rad/s" where that would be within `least` .. `most` of the SI
/// `unit`; empty where no usual unit would.
[[nodiscard]] std::string unit_hint(double value, double least, double most,
                                    const std::string& unit);

}  // namespace graben::machines
