// SPDX-License-Identifier: Apache-2.0
#include "tests/faults/excavator_kind.hpp"

#include <cmath>

#include "app/machines/simulated/simulated_excavator.hpp"
#include "app/machines/task_file.hpp"
#include "firmware/excavator/motion/field/rounded_rectangle.hpp"

namespace graben {

/// The controller's friend: what it keeps from cycle to cycle.
struct ControllerMemoryAccess {
  static auto& memory(ecu::ExcavatorKind::Ecu& ecu) { return ecu.controller_.memory_; }
};

}  // namespace graben

namespace graben::faults {
namespace {

namespace bus = dbc::excavator;

/// Of every stroke, at the start.
constexpr double kLeastShare = 0.08;
/// Above the ground, so that the machine does not start in the soil.
constexpr double kLowestStart_m = -0.9;
/// degraded_speed is 0.3 of full speed; the field itself changes a little meanwhile.
constexpr double kSlower_share = 0.5;

const machines::SimulatedExcavator& shipped() {
  static const machines::SimulatedExcavator machine =
      machines::load_simulated_excavator(machines::find_profile(Excavator::kProfile));
  return machine;
}

bool well_inside(const ExcavatorGeometry& geometry, const StrokeResult& strokes) {
  bool inside = strokes.status == ReachStatus::kOk;
  for (unsigned i = 0; i < kAxisCount && inside; ++i) {
    const double share = strokes.strokes_m[i] / geometry.cylinder[i].stroke_m;
    inside = share > kLeastShare && share < 1.0 - kLeastShare;
  }
  return inside;
}

Eigen::Vector3d start_of(const machines::SimulatedExcavator& machine, std::uint64_t seed) {
  plant::Random random(seed, plant::Draw::kStart);
  const ExcavatorKinematics kinematics(machine.profile.geometry);
  const RoundedRectangle path(machine.profile.dig_path);
  for (;;) {
    const PathPoint point = path.at_share(random.uniform());
    constexpr double kAround_m = 0.4;
    constexpr double kTurned_rad = 0.3;
    const TipPose pose{point.position_m.x() + random.symmetric(kAround_m),
                       point.position_m.y() + random.symmetric(kAround_m),
                       point.attitude_rad + random.symmetric(kTurned_rad)};
    const StrokeResult strokes = kinematics.strokes_from_pose(pose);
    if (pose.y_m > kLowestStart_m && well_inside(machine.profile.geometry, strokes)) {
      return strokes.strokes_m;
    }
  }
}

machines::Scenario of_errors(std::uint64_t seed, machines::Errors errors) {
  machines::Scenario scenario;
  scenario.seed = seed;
  scenario.errors = errors;
  return scenario;
}

machines::Errors sensors_or_kim(bool sensors) {
  return sensors ? machines::Errors::kSensors : machines::Errors::kKim;
}

/// The shipped machine, arranged so, at a random pose.
Excavator::Scenery near_the_path(const machines::Scenario& scenario) {
  Excavator::Scenery scenery{machines::arranged(shipped(), scenario)};
  scenery.start_strokes_m = start_of(scenery.machine, scenario.seed);
  return scenery;
}

template <class Pressure>
Sensor pressure(const dbc::Field& cap, const dbc::Field& rod) {
  return {Pressure::kId, {cap, rod}, Fault::kPressureMissing};
}

}  // namespace

Excavator::Scenery Excavator::scenery_of(std::uint64_t seed) {
  machines::Scenario scenario = of_errors(seed, sensors_or_kim(seed % 2 == 0));
  scenario.soil = seed % 4 < 2;
  return near_the_path(scenario);
}

Excavator::Scenery Excavator::stall_scenery_of(std::uint64_t seed) {
  machines::Scenario scenario = of_errors(seed, sensors_or_kim(seed % 2 == 0));
  scenario.obstacle = true;
  Scenery scenery{machines::arranged(shipped(), scenario)};
  scenery.machine.plant.obstacle->hold_s = 1e4;
  scenery.start_strokes_m = machines::dig_start(scenery.machine.profile);
  return scenery;
}

Excavator::Scenery Excavator::imu_scenery_of(std::uint64_t seed) {
  machines::Scenario scenario = of_errors(seed, machines::Errors::kAll);
  scenario.imus = true;
  return near_the_path(scenario);
}

Excavator::Scenery Excavator::found_scenery_of(std::uint64_t seed, const std::string& bus,
                                               bool soil, bool seconds) {
  machines::Scenario scenario = of_errors(seed, machines::Errors::kAll);
  scenario.bus = bus;
  scenario.soil = soil;
  scenario.seconds = seconds;
  return near_the_path(scenario);
}

namespace {

const machines::SimulatedExcavator& swinging() {
  static const machines::SimulatedExcavator machine =
      machines::load_simulated_excavator(machines::find_profile("excavator_12t"));
  return machine;
}

/// A line of the teeth with 30 degrees of swing.
const TaskProgram& line_with_swing() {
  static const machines::TaskFile task =
      machines::load_task(machines::find_task("flatten"), swinging().profile);
  return task.result.program;
}

}  // namespace

Excavator::Scenery Excavator::swinging_scenery_of(std::uint64_t seed, bool seconds) {
  machines::Scenario scenario = of_errors(seed, sensors_or_kim(seed % 4 < 2));
  scenario.seconds = seconds;
  return {machines::arranged(swinging(), scenario), line_with_swing().start.head<kAxisCount>(),
          line_with_swing().start[kSwing]};
}

ExcavatorSetup Excavator::setup_of(const Machine& machine) {
  TaskBook book;
  if (machine.profile.has_swing()) {
    book.program[0] = line_with_swing();
    book.count = 1;
  }
  return {machine.profile, book};
}

plant::ExcavatorNode Excavator::node(const Scenery& scenery, CanPort& port) {
  const Eigen::Vector3d& start_m = scenery.start_strokes_m;
  return {scenery.machine.plant,
          plant::ExcavatorStart({start_m[0], start_m[1], start_m[2]}, scenery.start_swing_rad),
          port, scenery.machine.hash};
}

std::vector<Defect> Excavator::defects() {
  return {{"closed_length = 1.760", "closed_length = nan", "boom.cylinder.closed_length"},
          {"stroke = 1.260", "stroke = inf", "boom.cylinder.stroke"},
          {"length = 2.90", "length = 2900.0", "arm.length"},
          {"spool_travel = 0.010", "spool_travel = 10.0", "valve.spool_travel"},
          {"pressure_range = 40e6", "pressure_range = 400.0", "sensors.pressure_range"},
          {"servo_gain = 2.0", "", "control.servo_gain"},
          {"degraded_speed = 0.3", "", "safety.degraded_speed"},
          {"sensor_timeout = 0.045", "sensor_timeout = 0.045\nsensor_timeuot = 0.1",
           "control.sensor_timeuot"},
          {"opening_exponent = 1.6", "opening_exponent = -inf", "valve.opening_exponent"},
          {"swash = 0.643", "swash = \"full\"", "task.swash"}};
}

std::vector<Sensor> Excavator::strokes() {
  return {{bus::BoomStroke::kId, {bus::BoomStroke::kBoomStroke}, Fault::kStrokeMissing},
          {bus::ArmStroke::kId, {bus::ArmStroke::kArmStroke}, Fault::kStrokeMissing},
          {bus::BucketStroke::kId, {bus::BucketStroke::kBucketStroke}, Fault::kStrokeMissing}};
}

const std::vector<Sensor>& Excavator::vital() {
  static const std::vector<Sensor> sensors = strokes();
  return sensors;
}

const std::vector<Sensor>& Excavator::slowing() {
  static const std::vector<Sensor> sensors = {
      pressure<bus::BoomPressure>(bus::BoomPressure::kBoomCapPressure,
                                  bus::BoomPressure::kBoomRodPressure),
      pressure<bus::ArmPressure>(bus::ArmPressure::kArmCapPressure,
                                 bus::ArmPressure::kArmRodPressure),
      pressure<bus::BucketPressure>(bus::BucketPressure::kBucketCapPressure,
                                    bus::BucketPressure::kBucketRodPressure)};
  return sensors;
}

const std::vector<std::uint32_t>& Excavator::protected_ids() {
  static const std::vector<std::uint32_t> ids = {
      bus::BoomStroke::kId,   bus::ArmStroke::kId,   bus::BucketStroke::kId,
      bus::BoomPressure::kId, bus::ArmPressure::kId, bus::BucketPressure::kId,
      bus::PumpState::kId,    bus::ValveState::kId,  bus::OperatorCommand::kId};
  return ids;
}

const std::vector<std::uint32_t>& Excavator::command_ids() {
  static const std::vector<std::uint32_t> ids = {bus::SpoolCommand::kId};
  return ids;
}

bool Excavator::is_read(std::uint32_t id) {
  return id != bus::OperatorCommand::kId && id != bus::PumpState::kId;
}

const std::vector<Fault>& Excavator::missing() {
  static const std::vector<Fault> faults = {Fault::kStrokeMissing, Fault::kSwashMissing,
                                            Fault::kSpoolMissing};
  return faults;
}

bool Excavator::read_command(const CanFrame& frame, BusRecord::Command& command) {
  if (frame.id != Dbc::SpoolCommand::kId) {
    return false;
  }
  const auto message = read_spool_command<Dbc::SpoolCommand>(frame, command);
  for (const dbc::Physical& duty :
       {message.boom_duty_ratio, message.arm_duty_ratio, message.bucket_duty_ratio}) {
    command.neutral = command.neutral && says(duty, 0.0);
  }
  return true;
}

double Excavator::wanted_mps(const CanFrame& motion) {
  const Dbc::EcuMotion message = Dbc::EcuMotion::decode(motion.data);
  return std::hypot(message.boom_wanted_velocity_mps.value, message.arm_wanted_velocity_mps.value,
                    message.bucket_wanted_velocity_mps.value);
}

double Excavator::slowed_mps(const Machine& /*machine*/, double before_mps, TimeUs /*after_us*/) {
  return kSlower_share * before_mps;
}

bool Excavator::is_back(double slow_mps, double wanted_mps, Limit /*limit*/) {
  return wanted_mps > slow_mps / kSlower_share;
}

double Excavator::deadband(const Plant& plant) {
  double least = 1.0;
  for (const plant::SpoolDynamics& spool : plant.profile().spool) {
    least = std::min({least, spool.extend.start_ratio(), spool.retract.start_ratio()});
  }
  return least;
}

Excavator::AxisArray Excavator::longest_m(const Plant& plant) {
  AxisArray longest_m{};
  for (unsigned i = 0; i < kAxes; ++i) {
    longest_m[i] = plant.profile().machine.geometry.cylinder[i].stroke_m;
  }
  return longest_m;
}

void Excavator::make_neutral_and_sound(Plant& plant) {
  plant.set_duty({}, false);
  for (std::size_t i = 0; i < kAxes; ++i) {
    plant.set_pilot_fault(i, std::nullopt, 0.0);
  }
}

Reading Excavator::any_reading(Node& node, plant::Random& random) {
  const auto axis = static_cast<unsigned>(random.uniform() * kAxes);
  const double way = random.uniform() < 0.5 ? 1.0 : -1.0;
  return {&node.faults().axis[axis].stroke.jump_m, way * (0.06 + 0.2 * random.uniform()),
          Fault::kStrokeJump, Fault::kStrokeMissing};
}

std::pair<void*, std::size_t> Excavator::memory(Ecu& ecu) {
  auto& memory = ControllerMemoryAccess::memory(ecu);
  return {&memory, sizeof memory};
}

}  // namespace graben::faults
