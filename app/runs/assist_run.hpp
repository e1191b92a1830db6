// SPDX-License-Identifier: Apache-2.0
#pragma once
/// An operator with task Assist on the simulated machine: the arm's lever draws the bucket's edge
/// along a design, in to the machine and out again.

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/machines/height_grid.hpp"
#include "app/machines/simulated/simulated_excavator.hpp"
#include "app/runs/campaign_run.hpp"
#include "app/runs/figures.hpp"
#include "firmware/core/codes.hpp"

namespace graben::runs {

/// What the hands do; the arm's lever is meant where nothing else is said.
enum class LeverRecord : std::size_t {
  kFull,      ///< Wholly on, in a step.
  kThird,     ///< A third of that.
  kRamps,     ///< From rest to full and back within 3 s.
  kReleases,  ///< Two thirds for 1.2 s, then let go for 1 s.
  kNoise,     ///< About 0.6, with a hand's noise below 3 Hz.
  kTwo,       ///< Two thirds; the boom's downwards at times, the bucket's to both sides at others.
};
inline constexpr std::array<const char*, 6> kLeverRecords = {"full",     "third", "ramps",
                                                             "releases", "noise", "two levers"};
enum class AssistDesign : std::size_t { kFlat, kSlope };
inline constexpr std::array<const char*, 2> kAssistDesigns = {"flat", "slope 1:2"};

/// A ground that is no plane: what the controller has of it, and what it truly is.
struct AssistGround {
  std::string name;
  std::shared_ptr<const machines::HeldSurface> surface;
  /// At a place of the ground frame; not a number: it has none.
  std::function<double(const Eigen::Vector2d&)> height_m;
};

/// Flat, a slope of 1:2 and a V ditch with sides of 1:2 across the way of this machine's edge, all
/// as heights on a grid.
[[nodiscard]] std::vector<std::shared_ptr<const AssistGround>> assist_grounds(
    const ExcavatorProfile& profile);

struct AssistOptions {
  LeverRecord record = LeverRecord::kFull;
  AssistDesign design = AssistDesign::kFlat;
  std::shared_ptr<const AssistGround> ground;  ///< In the place of that design.
  bool marked = true;                          ///< The edge was touched to a mark at the start.
  std::uint64_t seed = 1;
};

/// True edge against the line that is held, assist.offset over the design, from the first 0.3 m of
/// way on. Not a number: nothing of it was seen.
struct AssistSummary {
  double rmse_m = kAbsent;
  double most_off_m = kAbsent;
  double over_cut_m = kAbsent;  ///< Under the design; 0: none.
  double wave_rms_m = kAbsent;  ///< Of what changes faster than 0.5 Hz.
  /// Over the fastest that the arm's lever, the drives' and the pumps' flow allow (FastestByFlow),
  /// on the way in and out; of records in which the lever stands still.
  double time_ratio = kAbsent;
  /// From letting go until the edge moves no faster than 20 mm/s, its links' ringing too, longest.
  double stop_s = kAbsent;
  /// From letting go until it stays within 15 mm of where it comes to rest, longest.
  double halt_s = kAbsent;
  double stop_off_m = kAbsent;  ///< Off the design from letting go on, farthest.
  double unsaid_s = 0.0;        ///< It stood with the lever on and no limit was told.
  double fault = 0.0;           ///< Code of that which stopped it; 0: none.
};

/// In the order of the ends of the campaign's rows.
enum class AssistEnd { kDone = 0, kNotFinished = 1, kFault = 2 };

struct AssistResult {
  AssistEnd end = AssistEnd::kDone;
  AssistSummary summary;
};

[[nodiscard]] const FigureTable<AssistSummary>& assist_figures();

/// Throws std::runtime_error where the machine can't hold its bucket all along the design.
[[nodiscard]] AssistResult run_assist(const machines::SimulatedExcavator& machine,
                                      const AssistOptions& options);

[[nodiscard]] const CampaignKind& assist_kind();

/// What a campaign tries.
struct AssistTrial {
  std::string errors;
  bool marked = true;
  /// In the place of the designs that are planes; none: these.
  std::vector<std::shared_ptr<const AssistGround>> grounds;
  machines::Found found;  ///< What the machine is told to be.
  bool imus = false;      ///< As machines::Scenario has it.

  [[nodiscard]] std::size_t designs() const {
    return grounds.empty() ? kAssistDesigns.size() : grounds.size();
  }
  /// Records times designs.
  [[nodiscard]] std::uint64_t cells() const { return kLeverRecords.size() * designs(); }
};

/// Every record on every design, then the next draw of each.
[[nodiscard]] CampaignOutcome campaign_assist(const CampaignOptions& options,
                                              const machines::SimulatedExcavator& nominal,
                                              const AssistTrial& trial, const Progress& progress);

}  // namespace graben::runs
