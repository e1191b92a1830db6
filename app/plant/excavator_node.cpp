// SPDX-License-Identifier: Apache-2.0
#include "app/plant/excavator_node.hpp"

namespace graben::plant {
namespace {

namespace bus = dbc::excavator;
using dbc::Physical;
using dbc::RawState;

bool all_valid(const bus::SpoolCommand& command) {
  return is_valid(command.boom_duty_ratio) && is_valid(command.arm_duty_ratio) &&
         is_valid(command.bucket_duty_ratio);
}

}  // namespace

ExcavatorNode::ExcavatorNode(const ExcavatorPlantProfile& profile, const ExcavatorStart& start,
                             CanPort& port, std::uint32_t profile_hash)
    : MachineNode(port, profile_hash, profile, start.strokes_m, start.swing_rad),
      sensors_(profile),
      imus_(profile, profile.sensor_errors ? std::optional(profile.seed) : std::nullopt),
      seconds_(profile),
      canopen_(profile),
      wanted_swash_(profile.swash_ratio) {
  if (profile.zx200) {
    zx200_.emplace(profile);
  }
  if (profile.sold.slopes) {
    slopes_.emplace(profile);
  }
  if (profile.sold.aux_valves || profile.sold.valve_driver) {
    valves_.emplace(profile.sold.aux_valves ? SoldValves::Kind::kAuxiliary
                                            : SoldValves::Kind::kDriver);
  }
}

void ExcavatorNode::step_zx200(TimeUs now) {
  const Zx200Faults& faults = faults_.zx200;
  receive([&](const CanFrame& frame) {
    if (!faults.lost) {
      zx200_->take(frame, now);
    }
  });
  zx200_->decide(faults, now);
  duty_ = zx200_->duty();
  enabled_ = zx200_->drives();
  plant_.set_pilot_cut(!enabled_);
  set_duties();
  apply_faults();
  advance(now);
  send_seconds(now);
  if (!faults.lost) {
    zx200_->report(plant_, faults_, sensors_, cycle(),
                   [this, now](const auto& message) { send(message, now); });
  }
  end_silent_cycle();
}

void ExcavatorNode::step(TimeUs now) {
  if (zx200_) {
    step_zx200(now);
    return;
  }
  receive([this, now](const CanFrame& frame) { take(frame, now); });
  watch_commands(now);
  obey_sold_valves(now);
  apply_faults();
  advance(now);
  send_canopen(now);
  send_seconds(now);
  if (plant_.profile().sold.silent) {
    if (is_due<bus::EEC1>()) {
      send(bus::EEC1{shown_engine_radps()}, now);
    }
    end_silent_cycle();
    return;
  }
  send_axes(now);
  if (is_due<bus::PumpState>()) {
    send_pumps(now);
  }
  if (is_due<bus::ValveState>(1)) {
    send_valve(now);
  }
  end_cycle(now);
}

void ExcavatorNode::watch_commands(TimeUs now) {
  if (spool_command_dies(now)) {
    enabled_ = false;
    set_duties();
  }
  if (swing_link_.dies(now)) {
    swing_silence_.command_lost();
    swing_enabled_ = false;
    set_duties();
  }
  if (pump_link_.dies(now)) {
    wanted_swash_ = plant_.profile().swash_ratio;
  }
}

/// Beside our SpoolCommand, which enables and cuts as ever, or, of a machine that does not speak
/// our bus, in its place.
void ExcavatorNode::obey_sold_valves(TimeUs now) {
  if (!valves_) {
    return;
  }
  valves_->decide(now);
  enabled_ = valves_->drives() && (enabled_ || plant_.profile().sold.silent);
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    duty_[i] = valves_->duty(i);
  }
  set_duties();
}

void ExcavatorNode::set_duties() {
  ExcavatorPlant::DriveArray duty = duty_;
  duty[kSwing] = swing_enabled_ ? duty_[kSwing] : 0.0;
  plant_.set_duty(duty, enabled_);
}

void ExcavatorNode::apply_faults() {
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    plant_.set_pilot_fault(i, faults_.axis[i].spool_held_ratio, faults_.axis[i].spool_offset_ratio);
    plant_.set_reversed(i, faults_.axis[i].reversed);
  }
  if (has_swing()) {
    plant_.set_pilot_fault(kSwing, faults_.swing.spool_held_ratio,
                           faults_.swing.spool_offset_ratio);
    plant_.set_reversed(kSwing, faults_.swing.reversed);
  }
  ExcavatorPlant::PumpArray swash = wanted_swash_;
  for (std::size_t i = 0; i < kPumpCount; ++i) {
    swash[i] = faults_.pump[i].actual_swash_ratio.value_or(swash[i]);
  }
  plant_.set_swash(swash);
  plant_.set_engine_ratio(faults_.engine_ratio);
}

void ExcavatorNode::take(const CanFrame& frame, TimeUs now) {
  canopen_.take(frame);
  if (valves_) {
    valves_->take(frame, now);
  }
  if (plant_.profile().sold.silent) {
    return;
  }
  if (same_message(frame.id, bus::SpoolCommand::kId)) {
    take_spool_command(frame, now);
  }
  if (same_message(frame.id, bus::SwingCommand::kId) && has_swing()) {
    take_swing_command(frame, now);
  }
  if (same_message(frame.id, bus::PumpCommand::kId)) {
    take_pump_command(frame, now);
  }
}

void ExcavatorNode::take_spool_command(const CanFrame& frame, TimeUs now) {
  const auto request = take_spool_request(frame, now);
  if (!request) {
    return;
  }
  const bus::SpoolCommand& command = request->command;
  enabled_ = request->enabled && all_valid(command);
  duty_[kBoom] = command.boom_duty_ratio.value;
  duty_[kArm] = command.arm_duty_ratio.value;
  duty_[kBucket] = command.bucket_duty_ratio.value;
  set_duties();
}

void ExcavatorNode::take_swing_command(const CanFrame& frame, TimeUs now) {
  if (!swing_link_.accepts<bus::SwingCommand>(frame, now)) {
    return;
  }
  const bus::SwingCommand command = bus::SwingCommand::decode(frame.data);
  const bool lets = lets_through(command, swing_silence_);
  swing_enabled_ = lets && is_valid(command.swing_duty_ratio);
  duty_[kSwing] = command.swing_duty_ratio.value;
  set_duties();
}

void ExcavatorNode::take_pump_command(const CanFrame& frame, TimeUs now) {
  if (!pump_link_.accepts<bus::PumpCommand>(frame, now)) {
    return;
  }
  const bus::PumpCommand command = bus::PumpCommand::decode(frame.data);
  const auto& set = plant_.profile().swash_ratio;
  const auto wanted = [](const Physical& swash, double otherwise) {
    return is_valid(swash) ? swash.value : otherwise;
  };
  wanted_swash_ = {wanted(command.pump1_swash_ratio, set[0]),
                   wanted(command.pump2_swash_ratio, set[1])};
}

Physical ExcavatorNode::stroke(std::size_t axis) {
  return sensors_.stroke(axis, plant_.strokes_m()[faults_.stroke_from[axis]],
                         faults_.axis[axis].stroke);
}

void ExcavatorNode::send_axes(TimeUs now) {
  if (plant_.profile().machine.imu.known()) {
    send_imus(now);
  } else if (slopes_) {
    send_slopes(now);
  } else if (!canopen_.measures_joints()) {
    send(bus::BoomStroke{stroke(kBoom)}, now);
    send(bus::ArmStroke{stroke(kArm)}, now);
    send(bus::BucketStroke{stroke(kBucket)}, now);
  }
  if (!canopen_.measures_pressures()) {
    send_pressures(now);
  }
  if (has_swing()) {
    send_swing(now);
  }
}

void ExcavatorNode::send_imus(TimeUs now) {
  imus_.look(plant_);
  const auto& mounts = plant_.profile().machine.imu.mount;
  for (std::size_t imu = 0; imu < mounts.size(); ++imu) {
    if (mounts[imu].address != 0) {
      send_from(mounts[imu].address, imus_.rates(imu), now);
      send_from(mounts[imu].address, imus_.forces(imu), now);
    }
  }
}

void ExcavatorNode::send_canopen(TimeUs now) {
  for (const CanFrame& frame : canopen_.report(plant_, faults_, sensors_, cycle())) {
    send_frame(frame, now);
  }
}

void ExcavatorNode::send_seconds(TimeUs now) {
  const SecondSensors& second = plant_.profile().machine.second;
  if (!second.any()) {
    return;
  }
  seconds_.look(plant_, faults_);
  if (second.strokes() && is_due<bus::SecondStrokes>(1)) {
    send(bus::SecondStrokes{seconds_.shown(kBoom), seconds_.shown(kArm), seconds_.shown(kBucket)},
         now);
  }
  if (second.has[kSwing] && is_due<bus::SecondSwing>(3)) {
    send(bus::SecondSwing{seconds_.shown(kSwing)}, now);
  }
}

/// The addresses as shipped: the boom's is that of a single sensor.
void ExcavatorNode::send_slopes(TimeUs now) {
  using Slope = dbc::j1939::SSI2;
  constexpr std::uint8_t kFirst = Slope::kId & 0xFFU;
  slopes_->look(plant_);
  for (std::uint8_t link = 0; link < kImuCount; ++link) {
    Slope message;
    message.pitch_rad = valid(slopes_->slope_rad(link));
    message.roll_rad = valid(0.0);
    message.pitch_compensation = {Slope::PitchCompensation::kOn, RawState::kValid};
    message.pitch_merit = {Slope::PitchMerit::kFunctional, RawState::kValid};
    message.roll_compensation = {Slope::RollCompensation::kOn, RawState::kValid};
    message.roll_merit = {Slope::RollMerit::kFunctional, RawState::kValid};
    message.latency_s = valid(SlopeSensors::kLatency_s);
    send_from(static_cast<std::uint8_t>(kFirst + link), message, now);
  }
}

void ExcavatorNode::send_swing(TimeUs now) {
  const auto [left_pa, right_pa] = plant_.swing_pressures_pa();
  bus::SwingState message;
  message.swing_angle_rad = sensors_.swing(plant_.swing_rad(), faults_.swing.angle);
  message.swing_left_pressure_pa = sensors_.cap_pressure(kSwing, left_pa, faults_.swing.left);
  message.swing_right_pressure_pa = sensors_.rod_pressure(kSwing, right_pa, faults_.swing.right);
  send(message, now);
}

void ExcavatorNode::send_pressures(TimeUs now) {
  const auto cap = plant_.cap_pressures_pa();
  const auto rod = plant_.rod_pressures_pa();
  std::array<Physical, kAxisCount> cap_shown;
  std::array<Physical, kAxisCount> rod_shown;
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    const AxisFaults& faults = faults_.axis[i];
    cap_shown[i] = sensors_.cap_pressure(i, faults.pressures_swapped ? rod[i] : cap[i], faults.cap);
    rod_shown[i] = sensors_.rod_pressure(i, faults.pressures_swapped ? cap[i] : rod[i], faults.rod);
  }
  send(bus::BoomPressure{cap_shown[kBoom], rod_shown[kBoom]}, now);
  send(bus::ArmPressure{cap_shown[kArm], rod_shown[kArm]}, now);
  send(bus::BucketPressure{cap_shown[kBucket], rod_shown[kBucket]}, now);
}

void ExcavatorNode::send_pumps(TimeUs now) {
  ExcavatorPlant::PumpArray swash = plant_.swash_ratios();
  for (std::size_t i = 0; i < kPumpCount; ++i) {
    swash[i] = faults_.pump[i].shown_swash_ratio.value_or(swash[i]);
  }
  const bool second = plant_.profile().machine.pump_count > 1;
  send(bus::PumpState{valid(swash[0]), second ? valid(swash[1]) : Physical{}}, now);
  send(bus::EEC1{shown_engine_radps()}, now);
}

void ExcavatorNode::send_valve(TimeUs now) {
  auto spool = plant_.spool_travels_ratio();
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    spool[i] = faults_.axis[i].reversed ? -spool[i] : spool[i];
    spool[i] = faults_.axis[i].echoes ? (enabled_ ? duty_[i] : 0.0) : spool[i];
  }
  bus::ValveState message = valve_state();
  message.boom_spool_ratio = valid(spool[kBoom]);
  message.arm_spool_ratio = valid(spool[kArm]);
  message.bucket_spool_ratio = valid(spool[kBucket]);
  send(message, now);
  if (has_swing()) {
    const double swing = plant_.swing_spool_ratio();
    send(bus::SwingValveState{valid(faults_.swing.reversed ? -swing : swing)}, now);
  }
}

}  // namespace graben::plant
