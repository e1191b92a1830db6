// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Fences of a task file: what the machine must not pass or touch.

#include <Eigen/Core>
#include <string>

#include "firmware/excavator/fences/fence.hpp"

namespace graben::machines {

class TomlReader;

/// A direction of any length but none, of `count` numbers; the others are 0.
[[nodiscard]] Eigen::Vector3d read_direction(TomlReader& reader, const std::string& key,
                                             std::size_t count, const char* help);

/// The table at this key: ceiling, floor, wall, box or cylinder.
[[nodiscard]] Fence read_fence(TomlReader& reader, const std::string& at);

/// Kind and place, as "ceiling at 6.50 m", "box at 3.00, 2.00 m".
[[nodiscard]] std::string fence_text(const Fence& fence);

}  // namespace graben::machines
