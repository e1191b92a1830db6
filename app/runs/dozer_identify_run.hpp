// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A hidden dozer is commissioned over its bus, identified from the frames, and grades: with the
/// profile as shipped, as identified, and as its truth would have it.

#include <cstddef>

#include "app/identify/dozer/dozer_estimate.hpp"
#include "app/machines/simulated/simulated_dozer.hpp"
#include "app/runs/figures.hpp"
#include "app/runs/logged_run.hpp"

namespace graben::runs {

enum class DozerIdentifyEnd : std::size_t {
  kDone,
  kCommissioningStopped,
  kNotIdentified,
  kIdentifiedStopped
};

/// Figures of one machine. Errors are the true edge's off the grade, its worse end where it tilts;
/// what a run that did not come to its end was off until then counts.
struct DozerIdentifySummary {
  double commissioning_s = kAbsent;
  double max_error_as_shipped_m = kAbsent;
  double max_error_identified_m = kAbsent;
  double max_error_exact_m = kAbsent;
  double error_ratio = kAbsent;  ///< Identified over exact.
  double time_identified_s = kAbsent;
  double time_exact_s = kAbsent;
  double time_as_shipped_s = kAbsent;
  double identified_fault = kAbsent;  ///< Number of the fault that stopped it; 0: none.
  double exact_fault = kAbsent;
  double shipped_fault = kAbsent;
  double edge_error_ratio = kAbsent;  ///< Largest, of the travel, as the next ones.
  double dead_time_error_s = kAbsent;
  double lag_error_s = kAbsent;
  double pump_flow_error_ratio = kAbsent;
  double track_error_ratio = kAbsent;
  double speed_error_ratio = kAbsent;   ///< Of full speed, largest of all sides.
  double sides_within_share = kAbsent;  ///< Sides within 3 % of full.
  double within_band_share = kAbsent;   ///< Of edges: the truth within 1.96 deviations.
  LimitShares limit_share;
};

struct DozerIdentifyResult {
  DozerIdentifyEnd end = DozerIdentifyEnd::kDone;
  Fault fault = Fault::kNone;
  DozerIdentifySummary summary;
};

/// What a perfect identification would find of this machine, its tracks on the level.
[[nodiscard]] identify::DozerEstimate known_dozer(const machines::SimulatedDozer& hidden);

/// `hidden` with its own controller profile as the shipped one.
[[nodiscard]] DozerIdentifyResult run_dozer_identification(const machines::SimulatedDozer& hidden,
                                                           const Progress& progress);

[[nodiscard]] const FigureTable<DozerIdentifySummary>& dozer_identify_figures();

}  // namespace graben::runs
