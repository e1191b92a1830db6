// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A hidden machine is commissioned over its bus, identified from the frames, and digs: with the
/// profile as shipped, as identified, and as its truth would have it.

#include <cstdint>
#include <filesystem>

#include "app/machines/simulated/simulated_excavator.hpp"
#include "app/runs/figures.hpp"
#include "app/runs/logged_run.hpp"

namespace graben::runs {

struct IdentifyRunOptions {
  /// Its plant says all that is true of it; else a seed has drawn zeros beside it, and what was
  /// found is compared with nothing, nor is an exact profile tried.
  bool truth_is_known = true;
  double speed_override_ratio = 1.0;  ///< Halved where a dead time passes kLateHydraulics_s.
  std::filesystem::path log_file;     ///< candump log of the commissioning; none if empty.
};

inline constexpr double kLateHydraulics_s = 0.100;

enum class IdentifyEnd { kDone, kCommissioningStopped, kNotIdentified, kIdentifiedStopped };

/// Figures of one machine. What a dig that did not come to its end was off until then counts.
struct IdentifySummary {
  double commissioning_s = kAbsent;
  double max_error_as_shipped_m = kAbsent;
  double max_error_identified_m = kAbsent;
  double max_error_exact_m = kAbsent;
  double error_ratio = kAbsent;  ///< Identified over exact.
  double ringing_as_shipped_m = kAbsent;
  double ringing_identified_m = kAbsent;
  double ringing_exact_m = kAbsent;
  double loop_identified_s = kAbsent;
  double loop_exact_s = kAbsent;
  double shipped_fault = kAbsent;  ///< Number of the fault that stopped it; 0: none.
  double exact_fault = kAbsent;
  double edge_error_ratio = kAbsent;
  double dead_time_error_s = kAbsent;
  double lag_error_s = kAbsent;
  double stroke_zero_error_m = kAbsent;
  double pressure_zero_error_pa = kAbsent;
  double pump_flow_error_ratio = kAbsent;
  double speed_error_ratio = kAbsent;
  double sides_within_share = kAbsent;  ///< Of the cylinders and the swing, within 3 % of full.
  double within_band_share = kAbsent;
  double longest_dead_time_s = kAbsent;
  double longest_lag_s = kAbsent;
  double swing_left_error_ratio =
      kAbsent;  ///< Speed of the swing alone, of full; without one absent.
  double swing_right_error_ratio = kAbsent;
  LimitShares limit_share;
};

struct IdentifyResult {
  IdentifyEnd end = IdentifyEnd::kDone;
  Fault fault = Fault::kNone;
  IdentifySummary summary;
};

/// Hidden machine of a seed, whose sensors also have the noise of the nominal one's. Their zeros
/// are the hidden machine's own.
[[nodiscard]] machines::SimulatedExcavator hidden_with_noise(
    const machines::SimulatedExcavator& nominal, std::uint64_t seed);

/// The nominal machine with what Kim's errors draw of sensors and of the controller's parameters.
[[nodiscard]] machines::SimulatedExcavator nominal_with_errors(
    const machines::SimulatedExcavator& nominal, std::uint64_t seed);

/// `hidden` with its own controller profile as the shipped one.
[[nodiscard]] IdentifyResult run_identification(const machines::SimulatedExcavator& hidden,
                                                const IdentifyRunOptions& options,
                                                const Progress& progress);

[[nodiscard]] const FigureTable<IdentifySummary>& identify_figures();

}  // namespace graben::runs
