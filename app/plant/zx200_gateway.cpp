// SPDX-License-Identifier: Apache-2.0
#include "app/plant/zx200_gateway.hpp"

#include <algorithm>

#include "app/plant/random.hpp"

namespace graben::plant {
namespace {

namespace own_bus = dbc::zx200;

constexpr double kGatewayCycle_s = 0.01;
/// Of the pilot pressure behind what is asked for.
constexpr double kPilotLag_s = 0.02;
constexpr std::uint32_t kExternal = 1;
constexpr std::uint32_t kByPilot = 1;
constexpr double kOil_degc = 50.0;
constexpr std::uint32_t kCounts = 256;

dbc::Physical told(double value) { return {value, dbc::RawState::kValid}; }
dbc::Count counted(std::uint32_t value) { return {value, dbc::RawState::kValid}; }

bool is_frame_of(const CanFrame& frame, std::uint32_t id) {
  return same_message(frame.id, id) && frame.extended && !frame.remote && !frame.error &&
         !frame.fd && frame.length == 8;
}

double share(const dbc::Physical& one_way, const dbc::Physical& other_way) {
  return std::clamp((one_way.value - other_way.value) / Zx200Gateway::kFullPilot_pa, -1.0, 1.0);
}

dbc::Physical one_way(double pilot) {
  return told(Zx200Gateway::kFullPilot_pa * std::max(0.0, pilot));
}

}  // namespace

Zx200Gateway::Zx200Gateway(const ExcavatorPlantProfile& profile) {
  if (profile.sensor_errors) {
    Random bias(profile.seed, Draw::kJointBias);
    for (double& each : bias_rad_) {
      each = bias.symmetric(profile.sensors.joint_bias_rad);
    }
  }
}

void Zx200Gateway::take(const CanFrame& frame, TimeUs now) {
  if (is_frame_of(frame, own_bus::MachineSettingCmd::kId)) {
    const auto setting = own_bus::MachineSettingCmd::decode(frame.data);
    const bool goes_on = counts_ && setting.alive_counter.value != counter_;
    counts_ = true;
    counter_ = setting.alive_counter.value;
    if (goes_on) {
      has_setting_ = true;
      setting_us_ = now;
      wants_ = setting.front_signal_switch.value == kByPilot;
      needs_levers_ = needs_levers_ && wants_;
    }
  }
  if (is_frame_of(frame, own_bus::PilotPressureCmd1::kId)) {
    const auto command = own_bus::PilotPressureCmd1::decode(frame.data);
    has_command_ = true;
    command_us_ = now;
    duty_[kBoom] = share(command.boom_up_pa, command.boom_down_pa);
    duty_[kArm] = share(command.arm_crowd_pa, command.arm_dump_pa);
    duty_[kBucket] = share(command.bucket_crowd_pa, command.bucket_dump_pa);
  }
}

void Zx200Gateway::decide(const Zx200Faults& faults, TimeUs now) {
  const bool heard = has_setting_ && now - setting_us_ <= kSettingTimeoutUs && has_command_ &&
                     now - command_us_ <= kCommandTimeoutUs;
  const bool may = heard && wants_ && !faults.locked && !faults.stopped;
  if (drives_ && !may) {
    needs_levers_ = wants_;
  }
  drives_ = may && !needs_levers_;
}

void Zx200Gateway::follow_pilots() {
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    const double wanted = drives_ ? duty_[i] : 0.0;
    pilot_[i] += kGatewayCycle_s / (kGatewayCycle_s + kPilotLag_s) * (wanted - pilot_[i]);
  }
}

own_bus::FrontAngle Zx200Gateway::front_angle(const ExcavatorPlant& plant,
                                              const ExcavatorFaults& faults) {
  const JointArray joint_rad = plant.joint_angles_rad();
  std::array<dbc::Physical, kAxisCount> shown;
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    // A link that sinks turns positive.
    shown[i] = told(
        -shown_[i].show(joint_rad[i] + bias_rad_[i], ReadingFault(faults.axis[i].stroke)).value);
  }
  return {shown[kBoom], shown[kArm], shown[kBucket], told(plant.swing_rad())};
}

own_bus::FrontAngularVelocity Zx200Gateway::front_rate(const ExcavatorPlant& plant) {
  const JointArray joint_rad = plant.joint_angles_rad();
  JointArray rate_radps{};
  for (std::size_t i = 0; i < kAxisCount && has_last_; ++i) {
    rate_radps[i] = -(joint_rad[i] - last_rad_[i]) / kGatewayCycle_s;
  }
  last_rad_ = joint_rad;
  has_last_ = true;
  return {told(rate_radps[kBoom]), told(rate_radps[kArm]), told(rate_radps[kBucket]), told(0.0)};
}

own_bus::PilotPressure1 Zx200Gateway::pilot_pressure() const {
  own_bus::PilotPressure1 message;
  message.boom_up_pilot_pa = one_way(pilot_[kBoom]);
  message.boom_down_pilot_pa = one_way(-pilot_[kBoom]);
  message.arm_crowd_pilot_pa = one_way(pilot_[kArm]);
  message.arm_dump_pilot_pa = one_way(-pilot_[kArm]);
  message.bucket_crowd_pilot_pa = one_way(pilot_[kBucket]);
  message.bucket_dump_pilot_pa = one_way(-pilot_[kBucket]);
  message.swing_right_pilot_pa = told(0.0);
  message.swing_left_pilot_pa = told(0.0);
  return message;
}

own_bus::Pressure1 Zx200Gateway::pressure(const ExcavatorPlant& plant,
                                          const ExcavatorFaults& faults, FaultySensors& sensors) {
  const auto cap_pa = plant.cap_pressures_pa();
  const auto rod_pa = plant.rod_pressures_pa();
  const auto cap = [&](std::size_t i) {
    return sensors.cap_pressure(i, cap_pa[i], faults.axis[i].cap);
  };
  const auto rod = [&](std::size_t i) {
    return sensors.rod_pressure(i, rod_pa[i], faults.axis[i].rod);
  };
  own_bus::Pressure1 message;
  message.boom_bottom_pressure_pa = cap(kBoom);
  message.boom_rod_pressure_pa = rod(kBoom);
  message.arm_bottom_pressure_pa = cap(kArm);
  message.arm_rod_pressure_pa = rod(kArm);
  message.bucket_bottom_pressure_pa = cap(kBucket);
  message.bucket_rod_pressure_pa = rod(kBucket);
  message.swing_a_pressure_pa = told(0.0);
  message.swing_b_pressure_pa = told(0.0);
  return message;
}

own_bus::FlowRate1 Zx200Gateway::flow(const ExcavatorPlant& plant) {
  const auto flows = plant.section_flows();
  own_bus::FlowRate1 message;
  message.boom_bottom_flow_m3ps = told(flows[kBoom].cap_in_m3ps);
  message.boom_rod_flow_m3ps = told(flows[kBoom].rod_in_m3ps);
  message.arm_bottom_flow_m3ps = told(flows[kArm].cap_in_m3ps);
  message.arm_rod_flow_m3ps = told(flows[kArm].rod_in_m3ps);
  message.bucket_bottom_flow_m3ps = told(flows[kBucket].cap_in_m3ps);
  message.bucket_rod_flow_m3ps = told(flows[kBucket].rod_in_m3ps);
  message.swing_a_flow_m3ps = told(0.0);
  message.swing_b_flow_m3ps = told(0.0);
  return message;
}

own_bus::RollPitchAngle Zx200Gateway::level() { return {told(0.0), told(0.0)}; }

own_bus::MachineState Zx200Gateway::state(const ExcavatorPlant& plant, const Zx200Faults& faults) {
  own_bus::MachineState message;
  message.lock_cmd_state = counted(faults.locked ? 1 : 0);
  message.pilot_shutoff_valve_state = counted(drives_ ? 1 : 0);
  message.system_error = counted(0);
  message.can_error_pl = counted(0);
  message.can_error_body = counted(0);
  message.can_error_ict = counted(0);
  message.lock_receiver_error = counted(0);
  message.emergency_stop_receiver_error = counted(faults.stopped ? 1 : 0);
  message.switch_error = counted(0);
  message.control_state = counted(drives_ ? kExternal : 0);
  message.oil_temperature_degc = told(kOil_degc);
  message.engine_state = counted(plant.engine_radps() > 0.0 ? 1 : 0);
  message.alive_counter = counted(alive_);
  alive_ = faults.frozen ? alive_ : (alive_ + 1) % kCounts;
  return message;
}

}  // namespace graben::plant
