// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The simulated dozer on the bus: valve side, transmission, sensors, engine.

#include <array>
#include <cstdint>

#include "app/plant/dozer_faults.hpp"
#include "app/plant/dozer_plant.hpp"
#include "app/plant/dozer_sensors.hpp"
#include "app/plant/machine_node.hpp"
#include "can_dbc/generated/dozer_dbc.hpp"
#include "hal/can_port.hpp"

namespace graben::plant {

/// The bus port belongs to the caller, who opens it.
///
/// Blade: as ExcavatorNode for its spools. Without a command for `kCommandTimeoutUs`, with
/// enable off or unusable, or with an unusable duty the spool is sent to neutral; after such a
/// silence enable has to be Off before it counts again. With PilotCut On the spool centres at once,
/// until it is Off; an unusable one changes nothing of that.
///
/// Transmission: pumps and brake follow PumpDisplacementCommand. Without it for as long, or with an
/// unusable value, both pumps go to 0, and the parking brake closes once the tracks stand, or after
/// `kBrakeLatestUs` if they do not; after such a silence both have to be commanded to 0 before they
/// count again. The motors follow MotorDisplacementCommand; without it, or without a value, they go
/// to full displacement.
class DozerNode : public MachineNode<dbc::dozer::Dbc, DozerPlant, DozerFaults> {
 public:
  /// No stop by the pumps takes longer than 1 s.
  static constexpr TimeUs kBrakeLatestUs = 2 * kSecondUs;

  DozerNode(const DozerPlantProfile& profile, CanPort& port, std::uint32_t profile_hash);

  /// To be called every 10 ms: takes the commands that are pending, runs the plant on by 10 ms,
  /// then reports its state: stroke, body, transmission and tracks each time, the engine's every
  /// second time, the valve's in the times between, identity every hundredth; in the first all but
  /// the valve's. `now` is for stamps, timeouts and delays only.
  void step(TimeUs now);

  [[nodiscard]] const CommandCounters& pump_counters() const { return pump_link_.counters(); }
  [[nodiscard]] const CommandCounters& motor_counters() const { return motor_link_.counters(); }

 private:
  void take(const CanFrame& frame, TimeUs now);
  void watch_commands(TimeUs now);
  void apply_faults();
  void take_spool_command(const CanFrame& frame, TimeUs now);
  void take_pump_command(const CanFrame& frame, TimeUs now);
  void take_motor_command(const CanFrame& frame, TimeUs now);
  void go_neutral();
  void stop_pumps(TimeUs now);
  void brake_when_stopped(TimeUs now);
  void send_transmission(TimeUs now);
  void send_valve(TimeUs now);
  template <class Message>
  [[nodiscard]] Message path_state(std::size_t track) const;
  void show_pumps();

  DozerReadings readings_;
  CommandLink pump_link_;
  CommandLink motor_link_;
  NeutralFirst pump_silence_;
  bool stopping_ = false;  ///< By itself; the brake is to close.
  TimeUs stopping_since_us_ = 0;
  double blade_duty_ = 0.0;  ///< That its valve is sent.
  DozerPlant::TrackArray pump_ratio_{};
  DozerPlant::TrackArray obeyed_pump_ratio_{};  ///< By both pumps.
  DozerPlant::TrackArray shown_pump_ratio_{};   ///< By their feedback.
  DozerPlant::TrackArray motor_ratio_ = {1.0, 1.0};
};

}  // namespace graben::plant
