// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A case as a line of text: which machine, where it starts, and what is done to it and its bus.
///
///   GROUP SETUP cycles=120 seed=3 soil start=0.2,0.6,0.5 speed=0.8 | @60+5 EDIT | @70 EDIT ...
///   GROUP SETUP row=33 seed=4 cycles=620
///
/// GROUP is free; the maxima are kept by it. SETUP: 22t, 12t, dozer, bumps. The operator enables at
/// 200 ms and gives the task 100 ms later. `start`: shares of the strokes, of an excavator; else
/// drawn from the seed. `row`: of tests/faults, 22t and dozer; of the controllers that it
/// starts, the one that ran longest. Only even seeds leave the controller's profile as it is
/// shipped. EDIT holds for the cycles from 60 to 64, or for one cycle:
///
///   raw MESSAGE.FIELD N   the field's raw value; counter and CRC stay right
///   mute MESSAGE          lost
///   wrong MESSAGE         a bit of the CRC flipped
///   as MESSAGE OTHER      protected as another message
///   length MESSAGE N      another length
///   odd MESSAGE N         bit 0 remote, 1 CAN FD, 2 an 11-bit id
///   good MESSAGE N        so many more, right but too many
///   flood MESSAGE N B     so many with a wrong CRC, bytes B; `foreign`: with an id of nobody;
///                         `error`: error frames
///   late N                the cycle comes so many ms late
///   port N                state of the port, as CanPortState counts
///   refuse                nothing can be sent
///   hold N                0: the operator lets go; 1: enables; 2: with the task
///   speed N               what the operator lets it run at, percent

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tests/timing/counts/trace.hpp"

namespace graben::timing {

struct Edit {
  int from = 0;
  int cycles = 1;
  std::string what;
  std::string message;
  std::string other;  ///< Message, or field.
  std::uint64_t number = 0;
  std::uint64_t bytes = 0;

  [[nodiscard]] bool holds(int cycle) const { return cycle >= from && cycle < from + cycles; }
};

struct Script {
  std::string group;
  Setup setup = Setup::kExcavator22t;
  int cycles = 100;
  std::uint64_t seed = 1;
  bool soil = false;
  std::vector<double> start;  ///< Empty: drawn.
  double speed_ratio = 1.0;
  std::optional<int> row;
  std::uint8_t task_number = 0;
  std::vector<Edit> edits;
};

/// Throws std::runtime_error, which names what is wrong.
[[nodiscard]] Script parse_script(const std::string& line);

}  // namespace graben::timing
