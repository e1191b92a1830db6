// SPDX-License-Identifier: Apache-2.0
#pragma once
/// All that identification asks of a machine's profile, made once where the profile enters: its
/// drives and their valve, and by them alone the speeds of all cylinders at one moment, the valve's
/// equations solved for the speeds, at given openings and loads.

#include <array>

#include "firmware/excavator/excavator_signals.hpp"
#include "firmware/mcv/mcv_machine.hpp"

namespace graben {
struct ExcavatorProfile;
}

namespace graben::identify {

inline constexpr double kByOpening = -1.0;

/// One moment of a machine. SI units; extension is positive.
struct ValveMoment {
  /// Share of the travel outside the dead band, its sign the side.
  std::array<double, kDriveCount> opening{};
  /// How far the bypass of each section is closed, 0 .. 1, where that is known by more than the
  /// opening; kByOpening: it is not.
  std::array<double, kDriveCount> bypass_closed = {kByOpening, kByOpening, kByOpening, kByOpening};
  /// True pressures: the sensors' zeros are taken off.
  std::array<double, kDriveCount> cap_pa{};
  std::array<double, kDriveCount> rod_pa{};
  std::array<double, kPumpCount> swash{};
  double engine_radps = 0.0;
};

struct DriveModel {
  explicit DriveModel(const ExcavatorProfile& profile);

  /// At this engine speed and these shares of full swash, without pressure; of a pump that sets its
  /// own the most that it gives.
  [[nodiscard]] PerPump<double> flow_m3ps(double engine_radps,
                                          const std::array<double, kPumpCount>& swash) const;

  /// Speeds that the pumps' lines, the loads and the openings leave: v = c_L(x) sqrt(F), (9) to
  /// (12), and the flow balance (27) of each line, together. A cylinder whose load drives it while
  /// no oil is behind it goes as fast as its draining edge lets it. A line that senses its load has
  /// no more than the margin above the heaviest.
  [[nodiscard]] std::array<double, kDriveCount> speeds_mps(const ValveMoment& moment) const;

  /// With a swing one more than the cylinders.
  [[nodiscard]] std::size_t drives() const {
    return static_cast<std::size_t>(valve.actuator_count);
  }

  /// All pumps are of one kind.
  [[nodiscard]] PumpKind pump_kind() const { return pump[0].regulator.kind; }

  std::array<DriveRow, kDriveCount> drive;
  McvMachine valve;
  bool quick;              ///< See are_quick().
  SpoolMetering metering;  ///< The same of every section.
  SpoolAnswer answer;      ///< Of the whole valve, whatever a side says by itself.
  std::array<PumpProfile, kPumpCount> pump;
  std::array<double, kDriveCount> cap_zero_pa;  ///< What the sensors show of no pressure.
  std::array<double, kDriveCount> rod_zero_pa;
};

}  // namespace graben::identify
