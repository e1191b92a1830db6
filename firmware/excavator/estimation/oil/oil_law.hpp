// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Feedback that has the oil as a state: observer and law for boom and arm, see control.law.

#include <array>

#include "firmware/excavator/estimation/oil/oil_gains.hpp"
#include "firmware/excavator/estimation/oil/oil_modes.hpp"
#include "firmware/excavator/excavator_drives.hpp"

namespace graben {

/// A command on its way to its flow: two lags of the first order.
struct TwoLags {
  double first_mps = 0.0;
  double second_mps = 0.0;
};

/// State from cycle to cycle, of boom and arm. As constructed it has not seen the machine.
struct OilState {
  bool begun = false;
  double weight = 0.0;  ///< 0 .. 1: how far it leads, instead of the servo.
  Eigen::Vector2d travel_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d speed_mps = Eigen::Vector2d::Zero();
  Eigen::Vector2d force_n = Eigen::Vector2d::Zero();  ///< Of the oil; extension is positive.
  Eigen::Vector2d load_n = Eigen::Vector2d::Zero();   ///< Whatever else pushes; at rest -force.
  Eigen::Vector2d flow_error_mps = Eigen::Vector2d::Zero();  ///< Of the flow besides the command.
  std::array<TwoLags, 2> asked;                              ///< Commands with corrections.
  std::array<TwoLags, 2> expected;                           ///< The part of them without.
};

/// What is seen of boom and arm, and what the last cycle asked of them.
struct OilSeen {
  Eigen::Vector2d asked_mps = Eigen::Vector2d::Zero();
  Eigen::Vector2d expected_mps = Eigen::Vector2d::Zero();
  Eigen::Vector2d stroke_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d force_n = Eigen::Vector2d::Zero();  ///< Of measured pressures, not filtered.
  /// What the valves are opened for, and by how much their flow is less for each newton more; 0:
  /// whatever the force.
  Eigen::Vector2d opened_for_n = Eigen::Vector2d::Zero();
  Eigen::Vector2d yield_mpsn = Eigen::Vector2d::Zero();
  bool force_known = false;
  /// Of the strokes: a miss of so much counts half, what is within it less; 0: all counts whole.
  double stroke_step_m = 0.0;
  int cycles = 1;  ///< Since it was last seen (cycles_in).
  /// Its spool is open, but its line does not press as hard as its load yet: no flow moves it, and
  /// none is missing.
  Eigen::Array<bool, 2, 1> stands = Eigen::Array<bool, 2, 1>::Constant(false);
};

/// Of the measured pressures of boom and arm; known where both axes' pressures are.
[[nodiscard]] OilSeen oil_seen(DriveRows drives, Span<const ValidDrive> seen);

/// A cycle on: predicted over the modes, then corrected by what is seen; a force that is not known
/// corrects nothing. Not `active`, it begins newly, at rest. The weight rises and falls within half
/// a second, up while `leads`.
void next_oil(const OilGains& gains, const OilModes& modes, const OilSeen& seen, bool active,
              bool leads, OilState& state);

/// Speeds to ask for besides the wanted ones, m/s, to undo `off_m`, the travels beyond where they
/// should be, and to keep the oil from swinging. Not yet weighted.
[[nodiscard]] Eigen::Vector2d oil_correction_mps(const OilGains& gains, const OilModes& modes,
                                                 const OilState& state,
                                                 const Eigen::Vector2d& off_m);

}  // namespace graben
