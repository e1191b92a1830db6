#pragma once
/// What must hold of a solution whatever went in.

#include <string>

#include "firmware/mcv/optimiser.hpp"

namespace graben::test {

/// Empty, or in words what is unsafe: a number that is not finite, a lambda out of its range, a
/// spool that is open too far, the wrong way or without a solution behind it, bad input that went
/// through or good input that did not.
[[nodiscard]] std::string unsafe(const McvMachine& machine, const McvInput& input,
                                 const LambdaRange& range, const McvSolution& solution);

}  // namespace graben::test
