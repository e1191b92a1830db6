// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Tip force and payload from the cylinders' pressures, pose and motion.
///
/// Virtual work gives one balance for each of boom, arm and bucket linkage (load_balance.hpp).
/// While the bucket moves through the air, empty or with what it carries, the balances tell what is
/// off in them: offsets, friction, masses (load_terms.hpp), and the payload with it. While it digs
/// they tell the force on the teeth: three balances for two components, by least squares over all
/// that is not known of the terms.

#include "firmware/excavator/estimation/load/load_balance.hpp"
#include "firmware/excavator/estimation/load/load_phase.hpp"
#include "firmware/excavator/excavator_signals.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben {

/// Cycles whose balances are averaged before the terms are learnt from them, which is spread over
/// the next ones. [cycles; derived: each axis judged, learnt, looked at for the gains, and the
/// gains]
inline constexpr int kLoadBlock = 3 * kAxisCount + 1;

/// Mean of the balances of a few cycles.
struct BalanceBlock {
  Eigen::Vector3d force_n = Eigen::Vector3d::Zero();
  std::array<TermRow, kAxisCount> row{};
  std::array<bool, kAxisCount> steady{};  ///< The axis moved, to one side all the time.
};

/// How balances become force and payload, until the next block.
struct LoadGains {
  Eigen::Matrix3d open_n2 = Eigen::Matrix3d::Zero();  ///< What the terms leave open, as it grows.
  Eigen::Matrix<double, 2, kAxisCount> force = Eigen::Matrix<double, 2, kAxisCount>::Zero();
  double force_sd_n = 0.0;
};

/// State from cycle to cycle.
struct LoadObserver {
  bool begun = false;  ///< The filters.
  BalanceFilter filter;
  PhaseState phase;
  LoadTerms terms;
  int cycle = 0;  ///< Of the block that is being filled.
  BalanceBlock filling;
  BalanceBlock full;
  LoadPhase full_phase = LoadPhase::kUnsaid;  ///< Of the last block; kUnsaid: nothing to learn.
  LoadGains gains;
  int weighed = 0;              ///< Readings of axes that moved that the payload was in.
  int refused = 0;              ///< Blocks in a row that no payload accounts for.
  double last_fill_kg = 0.0;    ///< Carried away from the last dig; 0: none was.
  double poured_kg = 0.0;       ///< Of all digs: it may lie on one heap.
  double unseen_s = kInfinity;  ///< So long there has been no balance.
  TipLoad told;
};

/// A cycle on. `kind` and `share` are those of the step that runs. Not `active`, nothing is learnt.
///
/// Without all pressures, or the pose, the force on the teeth is not known, and the filters begin
/// anew. What was learnt stays: the terms, what the bucket carries, what it has poured and where;
/// what the bucket does is followed by the pose. The payload is told for kPayloadUnseen_s more.
void next_load(const ExcavatorProfile& profile, const LoadSeen& seen, StepKind kind, double share,
               const TipPose& tip, double elapsed_s, bool active, LoadObserver& observer);

}  // namespace graben
