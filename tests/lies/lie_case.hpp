// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A sensor that lives and lies, tried once: from when on, until the controller has seen it, and
/// how far the true tool was off by then.

#include <cstdint>
#include <string>
#include <vector>

namespace graben::lies {

struct LieCase {
  std::string machine;              ///< See machines().
  bool seconds = false;             ///< An excavator with second sensors on every joint.
  std::vector<std::string> faults;  ///< NAME or NAME=VALUE, as `graben plant --fault` has them.
  double speed_ratio = 1.0;         ///< The operator's.
  bool soil = false;
  bool from_start = false;  ///< They are there from power-on.
  double looked_s = 0.0;    ///< So long it may go on; 0: 20 s at full speed, 60 s at most.
};

struct LieOutcome {
  bool works = true;     ///< It armed and worked until the lie came.
  double seen_s = -1.0;  ///< Until a fault stopped it; -1: not.
  std::string fault;     ///< Which.
  /// The worst until it stood: of an excavator's teeth, true against those of the strokes that the
  /// controller hears; of a dozer's edge against the design. In m; of a swing's lie in rad.
  double off = 0.0;
};

/// 22t, 12t (a task with swing), retrofit (22t on that bus), dozer.
[[nodiscard]] const std::vector<std::string>& machines();

/// Throws std::runtime_error for a machine or fault that there is not.
[[nodiscard]] LieOutcome tried(const LieCase& lie, std::uint64_t seed);

}  // namespace graben::lies
