// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What is said by what refuses.

#include <stdexcept>
#include <string>

#include "tests/unit/cmocka_cpp.hpp"

namespace graben::test {

/// What it says where it throws; empty where it does not.
template <class Act>
std::string refusal_of(const Act& act) {
  try {
    static_cast<void>(act());
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

/// It throws, and says these words.
template <class Act>
void expect_refusal(const Act& act, const std::string& words) {
  const std::string said = refusal_of(act);
  if (said.empty() || said.find(words) == std::string::npos) {
    fail_msg("'%s' not in '%s'", words.c_str(), said.c_str());
  }
}

}  // namespace graben::test
