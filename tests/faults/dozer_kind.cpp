// SPDX-License-Identifier: Apache-2.0
#include "tests/faults/dozer_kind.hpp"

#include <algorithm>
#include <cmath>

#include "app/machines/simulated/simulated_excavator.hpp"
#include "firmware/dozer/blade.hpp"

namespace graben {

/// The controller's friend: what it keeps from cycle to cycle.
struct DozerMemoryAccess {
  static auto& memory(ecu::DozerKind::Ecu& ecu) { return ecu.controller_.memory_; }
};

}  // namespace graben

namespace graben::faults {
namespace {

namespace bus = dbc::dozer;

/// It brakes for a lower wanted speed with travel.deceleration_max, 1 m/s2; the limit is a little
/// less.
constexpr double kBrakesWith_mps2 = 0.95;
constexpr double kRoundOff_mps = 1e-3;
/// A speed that is held by nothing but the operator's share gets that much higher in kBack_us.
constexpr double kFaster_mps = 0.1;

const machines::SimulatedDozer& shipped() {
  static const machines::SimulatedDozer machine =
      machines::load_simulated_dozer(machines::find_profile(Dozer::kProfile));
  return machine;
}

}  // namespace

Dozer::Scenery Dozer::scenery_of(std::uint64_t seed) {
  Scenery scenery{shipped()};
  if (seed % 2 == 1) {
    scenery.machine.plant = machines::draw_dozer(scenery.machine, seed);
  }
  scenery.machine.plant.seed = seed;
  scenery.machine.plant.sensor_errors = true;
  return scenery;
}

Dozer::Scenery Dozer::stall_scenery_of(std::uint64_t seed) {
  constexpr double kWeak_pa = 3e6;  // Less than what it takes to roll.
  Scenery scenery = scenery_of(seed);
  scenery.machine.plant.hst_relief_pa = kWeak_pa;
  scenery.machine.plant.ground.rolling_resistance = 0.4;
  return scenery;
}

plant::DozerNode Dozer::node(const Scenery& scenery, CanPort& port) {
  return {scenery.machine.plant, port, scenery.machine.hash};
}

std::vector<Defect> Dozer::defects() {
  return {{"mass_centre_height = 0.85", "mass_centre_height = nan", "body.mass_centre_height"},
          {"cutting_edge = 1.60", "cutting_edge = 1600.0", "blade.cutting_edge"},
          {"half_gauge = 0.90", "half_gauge = -inf", "body.half_gauge"},
          {"valve_flow_max = 2.0e-3", "valve_flow_max = 120.0", "implement.valve_flow_max"},
          {"motor_ratio_min = 0.35", "motor_ratio_min = 35.0", "hst.motor_ratio_min"},
          {"gear_ratio = 70.9", "", "hst.gear_ratio"},
          {"acceleration_max = 0.5", "", "travel.acceleration_max"},
          {"sensor_timeout = 0.045", "sensor_timeout = 0.045\nsensor_timeuot = 0.1",
           "control.sensor_timeuot"},
          {"displacement_settle = 0.5", "displacement_settle = inf", "safety.displacement_settle"},
          {"rounding = 0.3", "rounding = \"round\"", "grade.rounding"}};
}

std::vector<Sensor> Dozer::strokes() {
  return {{bus::BladeStroke::kId, {bus::BladeStroke::kBladeStroke}, Fault::kStrokeMissing}};
}

const std::vector<Sensor>& Dozer::vital() {
  static const std::vector<Sensor> sensors = {
      {bus::BladeStroke::kId, {bus::BladeStroke::kBladeStroke}, Fault::kStrokeMissing},
      {bus::BodyPosition::kId,
       {bus::BodyPosition::kPosition, bus::BodyPosition::kHeight},
       Fault::kPoseMissing},
      {bus::BodyPitch::kId,
       {bus::BodyPitch::kPitch, bus::BodyPitch::kPitchRate},
       Fault::kPoseMissing},
      {bus::BodyVelocity::kId,
       {bus::BodyVelocity::kForward, bus::BodyVelocity::kClimb},
       Fault::kPoseMissing},
      {bus::LeftTransmission::kId,
       {bus::LeftTransmission::kPump, bus::LeftTransmission::kMotor},
       Fault::kTransmissionMissing},
      {bus::RightTransmission::kId,
       {bus::RightTransmission::kPump, bus::RightTransmission::kMotor},
       Fault::kTransmissionMissing},
      {bus::TrackSpeed::kId,
       {bus::TrackSpeed::kLeftTrack, bus::TrackSpeed::kRightTrack},
       Fault::kTransmissionMissing}};
  return sensors;
}

const std::vector<Sensor>& Dozer::slowing() {
  static const std::vector<Sensor> sensors = {
      {bus::EEC1::kId, {bus::EEC1::kEngineSpeed}, Fault::kEngineSpeedMissing}};
  return sensors;
}

const std::vector<std::uint32_t>& Dozer::protected_ids() {
  static const std::vector<std::uint32_t> ids = {
      bus::BladeStroke::kId,  bus::BodyPosition::kId,     bus::BodyPitch::kId,
      bus::BodyVelocity::kId, bus::LeftTransmission::kId, bus::RightTransmission::kId,
      bus::TrackSpeed::kId,   bus::ValveState::kId,       bus::OperatorCommand::kId};
  return ids;
}

const std::vector<std::uint32_t>& Dozer::command_ids() {
  static const std::vector<std::uint32_t> ids = {bus::SpoolCommand::kId,
                                                 bus::PumpDisplacementCommand::kId,
                                                 bus::MotorDisplacementCommand::kId};
  return ids;
}

bool Dozer::is_read(std::uint32_t id) { return id != bus::OperatorCommand::kId; }

const std::vector<Fault>& Dozer::missing() {
  static const std::vector<Fault> faults = {Fault::kStrokeMissing, Fault::kPoseMissing,
                                            Fault::kTransmissionMissing, Fault::kSpoolMissing};
  return faults;
}

bool Dozer::read_command(const CanFrame& frame, BusRecord::Command& command) {
  using Pumps = bus::PumpDisplacementCommand;
  using Motors = bus::MotorDisplacementCommand;
  switch (frame.id) {
    case Dbc::SpoolCommand::kId: {
      const auto message = read_spool_command<Dbc::SpoolCommand>(frame, command);
      command.neutral = command.neutral && says(message.blade_duty_ratio, 0.0);
      return true;
    }
    case Pumps::kId: {
      const Pumps message = Pumps::decode(frame.data);
      command.neutral = command.neutral && says(message.left_pump_ratio, 0.0) &&
                        says(message.right_pump_ratio, 0.0);
      command.brake =
          message.brake.state == dbc::RawState::kValid && message.brake.value == Pumps::Brake::kOn;
      return true;
    }
    case Motors::kId: {
      const Motors message = Motors::decode(frame.data);
      command.neutral = command.neutral && says(message.left_motor_ratio, 1.0) &&
                        says(message.right_motor_ratio, 1.0);
      return true;
    }
    default:
      return false;
  }
}

double Dozer::wanted_mps(const CanFrame& motion) {
  return Dbc::EcuMotion::decode(motion.data).wanted_speed_mps.value;
}

double Dozer::slowed_mps(const Machine& machine, double before_mps, TimeUs after_us) {
  const DozerProfile& profile = machine.profile;
  const double degraded_mps =
      profile.safety.degraded_speed_ratio * profile.travel.speed_desired_mps;
  const double after_s = static_cast<double>(after_us) * 1e-6;
  return std::max(degraded_mps, before_mps - kBrakesWith_mps2 * after_s) + kRoundOff_mps;
}

/// Faster; or what holds it is what would without any fault.
bool Dozer::is_back(double slow_mps, double wanted_mps, Limit limit) {
  const bool held = limit.kind == LimitKind::kImplementFlow || limit.kind == LimitKind::kAhead ||
                    limit.kind == LimitKind::kOffGrade || limit.kind == LimitKind::kRise;
  return held || wanted_mps > slow_mps + kFaster_mps;
}

Dozer::AxisArray Dozer::longest_m(const Plant& plant) {
  return {BladeKinematics(plant.profile().machine.blade).stroke_max_m()};
}

std::optional<Rolling> Dozer::rolling(const Plant& plant) {
  const auto speed_mps = plant.track_speeds_mps();
  return Rolling{std::max({std::abs(speed_mps[kLeft]), std::abs(speed_mps[kRight]),
                           std::abs(plant.velocity_mps())}),
                 plant.position_m()};
}

void Dozer::make_neutral_and_sound(Plant& plant) {
  plant.set_blade_duty(0.0, false);
  plant.set_displacements({}, {1.0, 1.0});
  plant.set_pilot_fault(std::nullopt, 0.0);
  for (std::size_t i = 0; i < kTrackCount; ++i) {
    plant.set_pump_fault(i, {});
    plant.set_motor_fault(i, {});
  }
}

/// The stroke, or one of the coordinates of the body.
Reading Dozer::any_reading(Node& node, plant::Random& random) {
  plant::DozerFaults& faults = node.faults();
  const double way = random.uniform() < 0.5 ? 1.0 : -1.0;
  const double size = way * (1.0 + 3.0 * random.uniform());
  constexpr double kStroke_m = 0.06;
  constexpr double kPosition_m = 0.15;
  constexpr double kHeight_m = 0.05;
  constexpr double kPitch_rad = 0.04;
  switch (static_cast<int>(random.uniform() * 4.0)) {
    case 0:
      return {&faults.stroke.jump_m, kStroke_m * size, Fault::kStrokeJump, Fault::kStrokeMissing};
    case 1:
      return {&faults.pose.position.jump, kPosition_m * size, Fault::kPoseImplausible,
              Fault::kPoseMissing};
    case 2:
      return {&faults.pose.height.jump, kHeight_m * size, Fault::kPoseImplausible,
              Fault::kPoseMissing};
    default:
      return {&faults.pose.pitch.jump, kPitch_rad * size, Fault::kPoseImplausible,
              Fault::kPoseMissing};
  }
}

std::pair<void*, std::size_t> Dozer::memory(Ecu& ecu) {
  auto& memory = DozerMemoryAccess::memory(ecu);
  return {&memory, sizeof memory};
}

}  // namespace graben::faults
