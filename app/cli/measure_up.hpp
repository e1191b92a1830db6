// SPDX-License-Identifier: Apache-2.0
#pragma once
/// `graben measure-up`: how a machine's IMUs sit on their links.

#include <array>
#include <optional>
#include <string>

#include "app/machines/simulated/simulation_file.hpp"
#include "app/runs/scenarios.hpp"

namespace graben::cli {

inline constexpr std::array<const char*, kAxisCount> kImuNames = {"boom", "arm", "bucket"};

struct MeasureUpCommand {
  std::string log;
  std::string record;
  std::string profile;
  std::string out;
  bool force = false;
  bool any_machine = false;
  std::string touches;  ///< Rests on the peg; empty: all that --second does not name.
  std::string second;
  std::optional<double> height_m;
  std::optional<double> rise_m;
  std::string keep;
  double touch_m = 0.005;
  // Of --record.
  machines::SimulatedChoice simulated;
  runs::DigScenario scenario;
  int pegs = 2;
  int each = 6;
};

/// From a log to the turns of the IMUs, and into a profile where --out names one. Prints the rests,
/// the touches and what was found. Throws std::runtime_error where the log does not say it.
void measure_up(const MeasureUpCommand& options);

/// A simulated machine touches pegs; its log.
void record_touches(const MeasureUpCommand& options);

/// Throws std::runtime_error where a file is there already and --force was not given.
void assert_new(const std::string& file, bool force);

}  // namespace graben::cli
