// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The automation controller of a simulated machine of the ZX200 class: lock, mode and commands as
/// that machine's bus has them (can_dbc/zx200.dbc), and what it says of itself.
///
/// An external controller drives it while
///
///   nobody has locked it, and no emergency stop is pressed
///   MachineSettingCmd comes, its counter goes on, and FrontSignalSwitch is 1
///   PilotPressureCmd1 comes
///
/// The first must not be older than 150 ms, the second than 50 ms. Otherwise it shuts the pilot
/// pressure off, and needs to see FrontSignalSwitch 0 once before it gives it again. What the codes
/// of ControlState and FrontSignalSwitch mean is assumed: the bus's facts name their bits alone.

#include <array>
#include <cstdint>

#include "app/plant/excavator_faults.hpp"
#include "app/plant/excavator_plant.hpp"
#include "app/plant/excavator_sensors.hpp"
#include "can_dbc/generated/zx200_dbc.hpp"
#include "firmware/core/time.hpp"
#include "hal/can_frame.hpp"

namespace graben::plant {

class Zx200Gateway {
 public:
  static constexpr TimeUs kSettingTimeoutUs = 150 * kMillisecondUs;
  static constexpr TimeUs kCommandTimeoutUs = 50 * kMillisecondUs;
  static constexpr double kFullPilot_pa = 5e6;

  explicit Zx200Gateway(const ExcavatorPlantProfile& profile);

  void take(const CanFrame& frame, TimeUs now);
  /// Of all that has been taken; once a cycle, before the plant runs on.
  void decide(const Zx200Faults& faults, TimeUs now);
  /// The external controller drives: pilot pressure reaches the valves.
  [[nodiscard]] bool drives() const { return drives_; }
  /// Duties that its pilot pressures stand for.
  [[nodiscard]] const ExcavatorPlant::DriveArray& duty() const { return duty_; }

  /// Gives each message that is due in this cycle to `send`.
  template <class Send>
  void report(const ExcavatorPlant& plant, const ExcavatorFaults& faults, FaultySensors& sensors,
              std::uint64_t cycle, const Send& send) {
    follow_pilots();
    send(front_angle(plant, faults));
    send(front_rate(plant));
    send(pilot_pressure());
    send(pressure(plant, faults, sensors));
    if (cycle % kCyclesOf<dbc::zx200::FlowRate1> == 0) {
      send(flow(plant));
    }
    if (cycle % kCyclesOf<dbc::zx200::RollPitchAngle> == 0) {
      send(level());
    }
    if (cycle % kCyclesOf<dbc::zx200::MachineState> == 0) {
      send(state(plant, faults.zx200));
    }
  }

 private:
  template <class Message>
  static constexpr std::uint64_t kCyclesOf = Message::kCycleTimeMs / 10;

  void follow_pilots();
  [[nodiscard]] dbc::zx200::FrontAngle front_angle(const ExcavatorPlant& plant,
                                                   const ExcavatorFaults& faults);
  [[nodiscard]] dbc::zx200::FrontAngularVelocity front_rate(const ExcavatorPlant& plant);
  [[nodiscard]] dbc::zx200::PilotPressure1 pilot_pressure() const;
  [[nodiscard]] static dbc::zx200::Pressure1 pressure(const ExcavatorPlant& plant,
                                                      const ExcavatorFaults& faults,
                                                      FaultySensors& sensors);
  [[nodiscard]] static dbc::zx200::FlowRate1 flow(const ExcavatorPlant& plant);
  [[nodiscard]] static dbc::zx200::RollPitchAngle level();
  [[nodiscard]] dbc::zx200::MachineState state(const ExcavatorPlant& plant,
                                               const Zx200Faults& faults);

  std::array<double, kAxisCount> bias_rad_{};
  std::array<FaultyReading, kAxisCount> shown_;
  JointArray last_rad_{};  ///< Of the cycle before.
  bool has_last_ = false;
  ExcavatorPlant::DriveArray duty_{};
  std::array<double, kAxisCount> pilot_{};  ///< Signed, of full: behind what is wanted.
  bool drives_ = false;
  bool needs_levers_ = true;  ///< To see the levers asked for, before it is driven.
  bool wants_ = false;        ///< FrontSignalSwitch is 1.
  bool counts_ = false;
  std::uint32_t counter_ = 0;
  bool has_setting_ = false;
  bool has_command_ = false;
  TimeUs setting_us_ = 0;
  TimeUs command_us_ = 0;
  std::uint32_t alive_ = 0;
};

}  // namespace graben::plant
