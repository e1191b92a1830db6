// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A machine's cutting edge by the frames of its bus: as the controller has it, with the same
/// receiver, validation and kinematics.

#include <cstdint>
#include <memory>
#include <optional>

#include "app/ecu/ground/edge_place.hpp"
#include "app/machines/any_machine.hpp"
#include "hal/can_frame.hpp"
#include "hal/link/message_links.hpp"

namespace graben::built {

using ground::EdgePlace;

/// Told so long ago, a force says nothing.
inline constexpr double kForceOld_s = 0.25;

class MachineEdge {
 public:
  virtual ~MachineEdge() = default;

  /// A frame of the machine's bus; `now_us` is when it was there.
  virtual void take(const CanFrame& frame, TimeUs now_us) = 0;
  /// After the frames up to now, each ground::kPeriod_us. Nothing where not all of the pose is
  /// known.
  [[nodiscard]] virtual std::optional<EdgePlace> look(TimeUs now_us) = 0;
  /// What became of the frames of its messages.
  [[nodiscard]] virtual LinkCounters counters() const = 0;
  /// The bus has said what tells when the edge is at work.
  [[nodiscard]] virtual bool tells_work() const = 0;
};

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
