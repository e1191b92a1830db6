// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a machine's commissioning left out, as its controller has to know it.

#include <cstdint>

#include "firmware/signals/machine_signals.hpp"

namespace graben {

/// Tasks that need drives of which nothing was measured. As constructed every drive is known.
struct UnknownDrives {
  std::uint32_t tasks = 0;     ///< A bit for each, by its number in Task.
  std::uint32_t programs = 0;  ///< Of Task::kProgram, a bit for each, by its task number.
  double speed_ratio = 0.0;    ///< Of the speed that is asked for in such a task; 0: it is refused.

  /// What is left of the speed of a task; `number` is of Task::kProgram, else of no account.
  [[nodiscard]] double left_ratio(Task task, int number) const {
    const bool needs =
        has(tasks, static_cast<int>(task)) || (task == Task::kProgram && has(programs, number));
    return needs ? speed_ratio : 1.0;
  }

 private:
  /// Bits of a word. [-; size: of the word]
  static constexpr int kBits = 32;

  [[nodiscard]] static bool has(std::uint32_t bits, int number) {
    return number >= 0 && number < kBits && (bits >> static_cast<unsigned>(number) & 1U) != 0;
  }
};

}  // namespace graben
