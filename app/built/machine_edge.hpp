// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A machine's cutting edge by the frames of its bus: as the controller has it, with the same
/// receiver, validation and kinematics.

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>

#include "app/machines/any_machine.hpp"
#include "hal/can_frame.hpp"
#include "hal/link/message_links.hpp"

namespace graben::built {

/// Ends of the edge in the machine's ground frame, m: an excavator's as swing_kinematics.hpp has
/// it, a dozer's world (dozer_signals.hpp) with y to the left of its track.
struct EdgePlace {
  Eigen::Vector3d left_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d right_m = Eigen::Vector3d::Zero();
  double outwards_m = 0.0;  ///< Of an excavator's teeth from its swing axis.
  /// Level force of the ground on an excavator's teeth, away from the machine, as its controller
  /// told it last (EcuTipLoad), and its standard deviation; both 0: not told.
  double level_n = 0.0;
  double deviation_n = 0.0;
  bool at_work = false;  ///< At the ground; an excavator's: see work_sweeps.hpp.
};
/// Told so long ago, a force says nothing.
inline constexpr double kForceOld_s = 0.25;
// A dozer's edge is at work where the machine goes ahead as fast as this with its edge no more
// than so much over the line that its tracks stand on.
inline constexpr double kAtWork_mps = 0.05;
inline constexpr double kAtWorkOverTracks_m = 0.15;

class MachineEdge {
 public:
  virtual ~MachineEdge() = default;

  /// A frame of the machine's bus; `now_us` is when it was there.
  virtual void take(const CanFrame& frame, TimeUs now_us) = 0;
  /// After the frames up to now, each kPeriod_us. Nothing where not all of the pose is known.
  [[nodiscard]] virtual std::optional<EdgePlace> look(TimeUs now_us) = 0;
  /// What became of the frames of its messages.
  [[nodiscard]] virtual LinkCounters counters() const = 0;
  /// The bus has said what tells when the edge is at work.
  [[nodiscard]] virtual bool tells_work() const = 0;
};
inline constexpr TimeUs kPeriod_us = 10 * kMillisecondUs;

/// `width_m` of the edge, where the profile does not say it: 0 without. `machine` has to outlive
/// it. Throws std::runtime_error where nobody says a width, or both do.
[[nodiscard]] std::unique_ptr<MachineEdge> machine_edge(const machines::AnyMachine& machine,
                                                        double width_m);

// Parts of that, one a kind.
[[nodiscard]] std::unique_ptr<MachineEdge> excavator_edge(const machines::ExcavatorMachine& machine,
                                                          double width_m);
[[nodiscard]] std::unique_ptr<MachineEdge> dozer_edge(const machines::DozerMachine& machine,
                                                      double width_m);
/// Of the two widths the one that is said; `key` is the profile's.
[[nodiscard]] double width_of(double profile_m, double told_m, const char* key);

}  // namespace graben::built
