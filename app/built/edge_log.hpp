// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A log as the way of a machine's cutting edge.

#include <filesystem>
#include <functional>
#include <string>

#include "app/built/machine_edge.hpp"
#include "app/ecu/ground/work_sweeps.hpp"
#include "app/identify/machine/candump_reader.hpp"

namespace graben::built {

using ground::EdgeStep;

struct EdgeAsk {
  std::string profile;  ///< As it was told, for messages; `bus` too.
  std::string bus;
  double width_m = 0.0;      ///< See machine_edge().
  bool any_machine = false;  ///< Take a log whose machine says another profile, or none.
  bool every = false;        ///< Each place of the edge counts as one at work.
};

struct EdgeLog {
  identify::LogRead read;
  double from_s = 0.0;  ///< Times of the first and the last frame, as the log has them.
  double until_s = 0.0;
  double known_s = 0.0;   ///< The edge's place was known for so long.
  double way_m = 0.0;     ///< That the edge's middle went.
  double worked_m = 0.0;  ///< The same at work.
};

/// Calls `take` for each step. Throws std::runtime_error, one sentence with the log's name: it is
/// no log, has no frame of such a machine, is of another profile or of two, frames are damaged or
/// of two senders, the place of the edge is never known, the machine does not move, nothing says
/// when the edge is at work.
EdgeLog read_edge(const std::filesystem::path& file, const machines::AnyMachine& machine,
                  const EdgeAsk& ask, const std::function<void(const EdgeStep&)>& take);

}  // namespace graben::built
