// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The simulated excavator on the bus: valve side, sensors, engine.

#include <array>
#include <cstdint>
#include <optional>

#include "app/plant/canopen_parts.hpp"
#include "app/plant/excavator_faults.hpp"
#include "app/plant/excavator_plant.hpp"
#include "app/plant/excavator_sensors.hpp"
#include "app/plant/link_imus.hpp"
#include "app/plant/machine_node.hpp"
#include "app/plant/second_sensors.hpp"
#include "app/plant/slope_sensors.hpp"
#include "app/plant/sold_valves.hpp"
#include "app/plant/zx200_gateway.hpp"
#include "can_dbc/generated/excavator_dbc.hpp"
#include "hal/can_port.hpp"

namespace graben::plant {

/// Where a machine starts.
struct ExcavatorStart {
  // NOLINTNEXTLINE(google-explicit-constructor): it looks along x unless told.
  ExcavatorStart(const ExcavatorPlant::AxisArray& strokes, double swing = 0.0)
      : strokes_m(strokes), swing_rad(swing) {}

  ExcavatorPlant::AxisArray strokes_m;
  double swing_rad;
};

/// The bus port belongs to the caller, who opens it. Without a command for `kCommandTimeoutUs`,
/// with enable off or unusable, or with an unusable duty every spool is sent to neutral, which
/// takes its dead time. Once a command has been missing for so long, enable has to be Off before it
/// counts again: what comes first may be frames that were stuck in a controller's queue, each of
/// them right and in order. With PilotCut On every spool centres at once, until it is Off; an
/// unusable one changes nothing of that and is neutral like the others. A pump follows PumpCommand;
/// without it for as long, or without a value, it goes back to the profile's swash. The swing spool
/// follows SwingCommand by the same rules as the others SpoolCommand, and opens only while
/// SpoolCommand lets them open too. A machine without a swing drive neither listens to nor says
/// anything of the swing. One whose profile has IMUs sends their frames and no strokes, and so does
/// one with parts off the shelf (SoldParts) that measure. Second sensors, where its profile has
/// them, speak our bus whatever the rest does. One of the ZX200 class speaks its own bus instead of
/// all that, see zx200_gateway.hpp.
class ExcavatorNode : public MachineNode<dbc::excavator::Dbc, ExcavatorPlant, ExcavatorFaults> {
 public:
  ExcavatorNode(const ExcavatorPlantProfile& profile, const ExcavatorStart& start, CanPort& port,
                std::uint32_t profile_hash);

  /// To be called every 10 ms: takes the commands that are pending, runs the plant on by 10 ms,
  /// then reports its state: strokes, swing and pressures each time, pumps and engine every second
  /// time, the valve's in the times between, identity every hundredth; in the first all but the
  /// valve's. `now` is for stamps, timeouts and delays only.
  void step(TimeUs now);

  /// What SwingCommand says; the spool opens only with the others enabled.
  [[nodiscard]] bool swing_enabled() const { return swing_enabled_; }

  [[nodiscard]] const CommandCounters& swing_counters() const { return swing_link_.counters(); }
  [[nodiscard]] const CommandCounters& pump_counters() const { return pump_link_.counters(); }

 private:
  void take(const CanFrame& frame, TimeUs now);
  void step_zx200(TimeUs now);
  void apply_faults();
  void watch_commands(TimeUs now);
  void take_spool_command(const CanFrame& frame, TimeUs now);
  void take_swing_command(const CanFrame& frame, TimeUs now);
  void take_pump_command(const CanFrame& frame, TimeUs now);
  void set_duties();
  void send_axes(TimeUs now);
  void send_pressures(TimeUs now);
  void send_swing(TimeUs now);
  void send_imus(TimeUs now);
  void send_slopes(TimeUs now);
  void send_canopen(TimeUs now);
  void send_seconds(TimeUs now);
  void obey_sold_valves(TimeUs now);
  void send_pumps(TimeUs now);
  void send_valve(TimeUs now);
  [[nodiscard]] dbc::Physical stroke(std::size_t axis);
  [[nodiscard]] bool has_swing() const { return plant_.profile().machine.has_swing(); }

  FaultySensors sensors_;
  LinkImuModel imus_;
  SecondSensorModel seconds_;
  std::optional<Zx200Gateway> zx200_;
  std::optional<SlopeSensors> slopes_;
  CanopenParts canopen_;
  std::optional<SoldValves> valves_;
  CommandLink swing_link_;
  CommandLink pump_link_;
  bool swing_enabled_ = false;
  ExcavatorPlant::DriveArray duty_{};
  NeutralFirst swing_silence_;
  ExcavatorPlant::PumpArray wanted_swash_;
};

}  // namespace graben::plant
