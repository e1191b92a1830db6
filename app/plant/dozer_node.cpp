// SPDX-License-Identifier: Apache-2.0
#include "app/plant/dozer_node.hpp"

#include <algorithm>
#include <cmath>

namespace graben::plant {
namespace {

namespace bus = dbc::dozer;
using dbc::Physical;
using dbc::RawState;

// What a parking brake may close at.
constexpr double kStanding_mps = 0.03;

}  // namespace

DozerNode::DozerNode(const DozerPlantProfile& profile, CanPort& port, std::uint32_t profile_hash)
    : MachineNode(port, profile_hash, profile), readings_(profile) {}

void DozerNode::step(TimeUs now) {
  receive([this, now](const CanFrame& frame) { take(frame, now); });
  watch_commands(now);
  brake_when_stopped(now);
  apply_faults();
  advance(now);
  readings_.sense(plant_, faults_.pose.later_ps);
  send(readings_.stroke(plant_, faults_), now);
  send(readings_.position(faults_.pose), now);
  send(readings_.pitch(faults_.pose), now);
  send(readings_.velocity(faults_.pose), now);
  send_transmission(now);
  send(readings_.tracks(plant_, faults_), now);
  if (plant_.tilt()) {
    send(readings_.tilt(plant_, faults_), now);
  }
  if (plant_.plan()) {
    send(readings_.course(faults_.pose), now);
  }
  if (is_due<bus::EEC1>()) {
    send(bus::EEC1{shown_engine_radps()}, now);
  }
  if (is_due<bus::ValveState>(1)) {
    send_valve(now);
  }
  end_cycle(now);
}

void DozerNode::take(const CanFrame& frame, TimeUs now) {
  if (same_message(frame.id, bus::SpoolCommand::kId)) {
    take_spool_command(frame, now);
  }
  if (faults_.loses_displacement_commands) {
    return;
  }
  if (same_message(frame.id, bus::PumpDisplacementCommand::kId)) {
    take_pump_command(frame, now);
  }
  if (same_message(frame.id, bus::MotorDisplacementCommand::kId)) {
    take_motor_command(frame, now);
  }
}

void DozerNode::watch_commands(TimeUs now) {
  if (spool_command_dies(now)) {
    go_neutral();
  }
  if (pump_link_.dies(now)) {
    pump_silence_.command_lost();
    stop_pumps(now);
  }
  if (motor_link_.dies(now)) {
    motor_ratio_ = {1.0, 1.0};
  }
}

void DozerNode::apply_faults() {
  plant_.set_pilot_fault(faults_.spool_held_ratio, faults_.spool_offset_ratio);
  plant_.set_tilt_pilot_fault(faults_.tilt_spool_held_ratio);
  plant_.set_reversed(faults_.reversed);
  for (std::size_t i = 0; i < kTrackCount; ++i) {
    plant_.set_pump_fault(i, faults_.path[i].pump);
    plant_.set_motor_fault(i, faults_.path[i].motor);
  }
  if (!faults_.pumps_stay) {
    obeyed_pump_ratio_ = pump_ratio_;
  }
  plant_.set_displacements(obeyed_pump_ratio_, motor_ratio_);
  plant_.set_engine_ratio(faults_.engine_ratio);
}

void DozerNode::take_spool_command(const CanFrame& frame, TimeUs now) {
  const auto request = take_spool_request(frame, now);
  if (!request) {
    return;
  }
  const Physical& duty_ratio = request->command.blade_duty_ratio;
  const Physical& tilt_ratio = request->command.tilt_duty_ratio;
  const bool usable = is_valid(duty_ratio) && (!plant_.tilt() || is_valid(tilt_ratio));
  if (!request->enabled || !usable) {
    go_neutral();
    return;
  }
  enabled_ = true;
  blade_duty_ = duty_ratio.value;
  plant_.set_blade_duty(blade_duty_, true);
  plant_.set_tilt_duty(tilt_ratio.value, true);
}

void DozerNode::take_pump_command(const CanFrame& frame, TimeUs now) {
  if (!pump_link_.accepts<bus::PumpDisplacementCommand>(frame, now)) {
    return;
  }
  const bus::PumpDisplacementCommand command = bus::PumpDisplacementCommand::decode(frame.data);
  const DozerPlant::TrackArray wanted = {command.left_pump_ratio.value,
                                         command.right_pump_ratio.value};
  const bool known = is_valid(command.left_pump_ratio) && is_valid(command.right_pump_ratio) &&
                     command.brake.state == RawState::kValid;
  if (known && wanted == DozerPlant::TrackArray{}) {
    pump_silence_.saw_neutral();
  }
  if (!known || pump_silence_.holds()) {
    stop_pumps(now);
    return;
  }
  stopping_ = false;
  pump_ratio_ = wanted;
  plant_.set_brake(command.brake.value == bus::PumpDisplacementCommand::Brake::kOn);
}

void DozerNode::take_motor_command(const CanFrame& frame, TimeUs now) {
  if (!motor_link_.accepts<bus::MotorDisplacementCommand>(frame, now)) {
    return;
  }
  const bus::MotorDisplacementCommand command = bus::MotorDisplacementCommand::decode(frame.data);
  const auto wanted = [](const Physical& ratio) { return is_valid(ratio) ? ratio.value : 1.0; };
  motor_ratio_ = {wanted(command.left_motor_ratio), wanted(command.right_motor_ratio)};
}

void DozerNode::go_neutral() {
  enabled_ = false;
  blade_duty_ = 0.0;
  plant_.set_blade_duty(0.0, false);
  plant_.set_tilt_duty(0.0, false);
}

void DozerNode::stop_pumps(TimeUs now) {
  pump_ratio_ = {};
  if (!stopping_) {
    stopping_ = true;
    stopping_since_us_ = now;
  }
}

void DozerNode::brake_when_stopped(TimeUs now) {
  if (!stopping_) {
    return;
  }
  const DozerPlant::TrackArray speed = plant_.track_speeds_mps();
  const double fastest = std::max(std::abs(speed[kLeft]), std::abs(speed[kRight]));
  if (fastest < kStanding_mps || now - stopping_since_us_ >= kBrakeLatestUs) {
    plant_.set_brake(true);
  }
}

template <class Message>
Message DozerNode::path_state(std::size_t track) const {
  const PathFaults& faults = faults_.path[track];
  const auto pressure = plant_.path(track).pressures_pa();
  return {valid(faults.shown_pump_ratio.value_or(shown_pump_ratio_[track])),
          valid(faults.shown_motor_ratio.value_or(plant_.motor_ratios()[track])),
          valid(std::max(pressure[0], pressure[1]))};
}

void DozerNode::show_pumps() {
  if (!faults_.pump_feedback_stuck) {
    shown_pump_ratio_ = faults_.pump_feedback_echoes ? pump_ratio_ : plant_.pump_ratios();
  }
}

void DozerNode::send_transmission(TimeUs now) {
  show_pumps();
  send(path_state<bus::LeftTransmission>(kLeft), now);
  send(path_state<bus::RightTransmission>(kRight), now);
}

void DozerNode::send_valve(TimeUs now) {
  bus::ValveState message = valve_state();
  const double travel_ratio = faults_.echoes ? blade_duty_ : plant_.spool_travel_ratio();
  message.blade_spool_ratio = valid(faults_.reversed ? -travel_ratio : travel_ratio);
  if (plant_.tilt()) {
    message.tilt_spool_ratio = valid(plant_.tilt()->spool_travel_ratio());
  }
  send(message, now);
}

}  // namespace graben::plant
