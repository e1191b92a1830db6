// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a simulated excavator is told to be, as its user writes it.

#include <string>

#include "app/machines/simulated/found.hpp"

namespace graben::runs {

/// Of "oil=0.7,exponent=1.2..1.8": a value, or a range that each draw, spool, axis and pump has its
/// own value of. Throws std::runtime_error that names the key, and what is allowed,
/// where a key is unknown or there twice, or its value missing, no number, or out of its range.
[[nodiscard]] machines::Found found_of(const std::string& text);
/// "oil 0.7 GPa, exponent 1.2 .. 1.8"; empty where nothing is told. The same text, the same
/// machine.
[[nodiscard]] std::string found_text(const machines::Found& found);
/// "oil (0.1 .. 100 GPa), exponent (0.5 .. 4), ...": every key.
[[nodiscard]] std::string found_keys();

}  // namespace graben::runs
