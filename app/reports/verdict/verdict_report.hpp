// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A verdict on a log as one HTML page that opens without a network.

#include <string>

#include "app/identify/verdict/verdict.hpp"

namespace graben::reports {

[[nodiscard]] std::string verdict_page(const identify::Verdict& verdict);

}  // namespace graben::reports
