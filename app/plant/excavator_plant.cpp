// SPDX-License-Identifier: Apache-2.0
#include "app/plant/excavator_plant.hpp"

#include <algorithm>
#include <cmath>

namespace graben::plant {
namespace {

std::size_t sections_on(const ExcavatorPlantProfile& profile, int pump) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < profile.drive_count(); ++i) {
    count += profile.machine.valve.spool[i].pump == pump ? 1U : 0U;
  }
  return count;
}

std::vector<ValveSection> sections_of(const ExcavatorPlantProfile& profile) {
  std::vector<ValveSection> sections;
  sections.reserve(profile.drive_count());
  for (int drive = 0; drive < profile.machine.drive_count; ++drive) {
    sections.emplace_back(profile.section(drive));
  }
  return sections;
}

std::vector<PilotValve> pilots_of(const ExcavatorPlantProfile& profile) {
  std::vector<PilotValve> pilots;
  pilots.reserve(profile.drive_count());
  for (std::size_t i = 0; i < profile.drive_count(); ++i) {
    pilots.emplace_back(profile.dead_time[i], profile.pilot_lag_s[i], profile.step_s());
  }
  return pilots;
}

}  // namespace

ExcavatorPlant::ExcavatorPlant(const ExcavatorPlantProfile& profile,
                               const AxisArray& start_strokes_m, double start_swing_rad)
    : profile_(profile),
      step_s_(profile.step_s()),
      pump_count_(static_cast<std::size_t>(profile.machine.pump_count)),
      pump_{PumpLine(profile.pump_line(0), sections_on(profile, 0)),
            PumpLine(profile.pump_line(1), sections_on(profile, 1))},
      engine_(profile.engine, step_s_),
      section_(sections_of(profile)),
      cylinder_{Cylinder(profile.cylinder(kBoom), step_s_),
                Cylinder(profile.cylinder(kArm), step_s_),
                Cylinder(profile.cylinder(kBucket), step_s_)},
      links_(profile),
      start_swing_(start_swing_rad),
      pilot_(pilots_of(profile)),
      wanted_swash_(profile.swash_ratio),
      swash_share_(-std::expm1(-step_s_ / profile.swash_time_constant_s)) {
  std::array<std::size_t, kPumpCount> next_place{};
  for (std::size_t i = 0; i < section_.size(); ++i) {
    pump_of_[i] = static_cast<std::size_t>(profile.machine.valve.spool[i].pump);
    place_of_[i] = next_place[pump_of_[i]]++;
  }
  set_soil(profile.soil);
  set_obstacle(profile.obstacle);
  if (profile.digging) {
    digging_.emplace(*profile.digging, profile.seed, step_s_);
  }
  set_bypasses();
  for (std::size_t p = 0; p < pump_count_; ++p) {
    pump_[p].start();
  }
  engine_.start(pump_power_share());
  links_.start(LinkageGeometry(profile.machine.geometry).angles_at(start_strokes_m), {});
  const JointArray holding = links_.holding_forces();
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    cylinder_[i].start(links_.levers()[i].stroke_m, holding[i]);
  }
  if (profile.rocking_rad > 0.0) {
    rocking_.emplace(profile);
    settled_nm_ = links_.weight_moment_nm();
  }
  if (profile.machine.has_swing()) {
    swing_.emplace(Swing{SwingMotor(profile.motor(), step_s_),
                         Platform(profile.platform, start_swing_, links_.swing_inertia_kgm2())});
  }
}

void ExcavatorPlant::set_duty(const DriveArray& duty_ratio, bool enable) {
  for (std::size_t i = 0; i < kDriveCount; ++i) {
    duty_[i] = enable && std::isfinite(duty_ratio[i]) ? duty_ratio[i] : 0.0;
  }
}

void ExcavatorPlant::set_soil(const std::optional<SoilProfile>& soil) {
  profile_.soil = soil;
  soil_.reset();
  if (soil) {
    soil_.emplace(*soil, profile_.seed, step_s_);
  }
}

void ExcavatorPlant::set_obstacle(const std::optional<ObstacleProfile>& obstacle) {
  profile_.obstacle = obstacle;
  obstacle_.reset();
  if (obstacle) {
    obstacle_.emplace(*obstacle, step_s_);
  }
}

void ExcavatorPlant::set_engine_ratio(double ratio) {
  engine_.set_ratio(ratio);
  drive_pumps();
}

void ExcavatorPlant::drive_pumps() {
  for (PumpLine& pump : pump_) {
    pump.set_speed_ratio(engine_.speed_ratio());
    pump.set_swash(pump.swash_ratio());
  }
}

double ExcavatorPlant::pump_power_share() const {
  double power_w = 0.0;
  double full_w = 0.0;
  for (std::size_t p = 0; p < pump_count_; ++p) {
    power_w += pump_[p].ideal_flow_m3ps() * pump_[p].flows().pump_port_pa;
    full_w += pump_[p].rated_flow_m3ps() * profile_.machine.pump[p].relief_pa;
  }
  return power_w / full_w;
}

void ExcavatorPlant::load_engine() {
  if (engine_.sags()) {
    engine_.step(pump_power_share());
    drive_pumps();
  }
}

void ExcavatorPlant::advance(TimeUs duration_us) {
  pending_us_ += duration_us;
  while (pending_us_ >= profile_.step_us) {
    pending_us_ -= profile_.step_us;
    step();
  }
}

void ExcavatorPlant::set_bypasses() {
  std::array<double, kPumpCount> inverse_square{};
  for (std::size_t i = 0; i < section_.size(); ++i) {
    inverse_square[pump_of_[i]] += section_[i].bypass_inverse_square();
  }
  for (std::size_t p = 0; p < pump_count_; ++p) {
    pump_[p].set_bypass(inverse_square[p]);
  }
}

void ExcavatorPlant::push_tip() {
  tip_force_n_ = outer_force_n_;
  if (soil_ || obstacle_) {
    const Eigen::Vector2d tip_m = tip().position_m;
    if (soil_) {
      tip_force_n_ += soil_->step(tip_m);
    }
    if (obstacle_) {
      tip_force_n_ += obstacle_->step(tip_m);
    }
  }
  double moment_nm = 0.0;
  if (digging_) {
    const TipPose pose = tip();
    const Eigen::Vector2d at_m = profile_.machine.geometry.boom_foot_m + pose.position_m;
    const BucketForce soil = digging_->step({at_m.x(), at_m.y(), pose.attitude_rad, swing_rad()});
    tip_force_n_ += soil.force_n;
    moment_nm = soil.moment_nm;
    links_.carry(digging_->fill());
  }
  if (!rocking_) {
    links_.set_tip_force(tip_force_n_, moment_nm);
    return;
  }
  links_.set_tip_force(Rotation::by(-rocking_->angle_rad()).apply(tip_force_n_), moment_nm);
  tip_moment_nm_ = moment_nm;
}

void ExcavatorPlant::rock() {
  BaseLoad load = links_.base_load();
  const Eigen::Vector2d at_m = profile_.machine.geometry.boom_foot_m + tip().position_m;
  load.moment_nm =
      cross(at_m, tip_force_n_) + tip_moment_nm_ + links_.weight_moment_nm() - settled_nm_;
  load.up_n = tip_force_n_.y();
  rocking_->step(load, step_s_);
  links_.set_base(rocking_->angle_rad(), rocking_->acceleration_radps2());
}

SectionPorts ExcavatorPlant::ports_of(std::size_t drive) const {
  const PumpLine& pump = pump_[pump_of_[drive]];
  const WavePort supply = pump.supply_port(place_of_[drive]);
  const WavePort recycle = pump.recycle_port(place_of_[drive]);
  if (drive == kSwing) {
    return {swing_->motor.left_port(), swing_->motor.right_port(), supply, recycle};
  }
  const Cylinder& cylinder = cylinder_[drive];
  return {cylinder.cap_port(),
          cylinder.rod_port(),
          supply,
          recycle,
          cylinder.cap_cushion_pas2pm6(),
          cylinder.rod_cushion_pas2pm6()};
}

void ExcavatorPlant::move_swash() {
  for (std::size_t i = 0; i < pump_count_; ++i) {
    if (pump_[i].regulator().sets_swash()) {
      pump_[i].regulate(felt_load_pa(i));
      continue;
    }
    const double missing = wanted_swash_[i] - pump_[i].swash_ratio();
    if (missing != 0.0) {
      pump_[i].set_swash(pump_[i].swash_ratio() + swash_share_ * missing);
    }
  }
}

void ExcavatorPlant::meter() {
  for (std::size_t i = 0; i < section_.size(); ++i) {
    section_[i].set_command(way_[i] * pilot_[i].step(duty_[i], pilot_cut_));
    const SectionPorts ports = ports_of(i);
    flows_[i] = section_[i].solve(ports);
    pump_[pump_of_[i]].set_section_flows(place_of_[i], flows_[i].supply_out_m3ps,
                                         flows_[i].recycle_in_m3ps);
    if (account_ != nullptr) {
      account_->add_section(profile_.oil(), ports, flows_[i], step_s_);
    }
  }
  for (std::size_t p = 0; p < pump_count_; ++p) {
    pump_[p].step();
    if (account_ != nullptr) {
      account_->add_pump(profile_.oil(), pump_[p], step_s_);
    }
  }
}

void ExcavatorPlant::move_links() {
  std::array<PistonLoad, kAxisCount> load;
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    load[i] = cylinder_[i].load();
  }
  const JointArray velocity = links_.accelerate(load, step_s_);
  if (account_ != nullptr) {
    add_pistons_to_account(velocity);
  }
  links_.move(step_s_);
  const JointArray rate = links_.rates();
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    cylinder_[i].step(flows_[i].cap_in_m3ps, flows_[i].rod_in_m3ps, velocity[i]);
    const Lever& lever = links_.levers()[i];
    cylinder_[i].set_motion(lever.stroke_m, lever.stroke_per_angle_m * rate[i]);
    peak_chamber_pressure_pa_ =
        std::max({peak_chamber_pressure_pa_, cylinder_[i].cap().pressure_pa(),
                  cylinder_[i].rod().pressure_pa()});
  }
}

void ExcavatorPlant::turn_platform() {
  SwingMotor& motor = swing_->motor;
  Platform& platform = swing_->platform;
  const double rate = platform.accelerate(motor.load(), links_.swing_inertia_kgm2(), step_s_);
  if (account_ != nullptr) {
    ChamberPower power = motor.power(rate);
    power.viscous_w = platform.viscous_w(rate);
    account_->add_motor(profile_.oil(), power, platform.friction_nm(), rate, step_s_);
  }
  platform.move(step_s_);
  motor.step(flows_[kSwing].cap_in_m3ps, flows_[kSwing].rod_in_m3ps, rate);
  motor.set_rate(platform.rate_radps());
  links_.set_swing_rate(platform.rate_radps());
  peak_chamber_pressure_pa_ = std::max(
      {peak_chamber_pressure_pa_, motor.left().pressure_pa(), motor.right().pressure_pa()});
}

void ExcavatorPlant::step() {
  push_tip();
  move_swash();
  load_engine();
  meter();
  move_links();
  if (rocking_) {
    rock();
  }
  if (swing_) {
    turn_platform();
  }
  bool spool_moved = false;
  for (ValveSection& section : section_) {
    spool_moved = section.step(step_s_) || spool_moved;
  }
  if (spool_moved) {
    set_bypasses();
  }
}

void ExcavatorPlant::add_pistons_to_account(const JointArray& velocity_mps) {
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    account_->add_piston(profile_.oil(), cylinder_[i].power(velocity_mps[i]),
                         links_.friction_n()[i], velocity_mps[i], step_s_);
  }
  account_->tip_j += step_s_ * links_.tip_power_w();
}

double ExcavatorPlant::stored_energy_j() const {
  double energy = links_.energy_j();
  for (const Cylinder& cylinder : cylinder_) {
    energy += cylinder.cap().energy_j() + cylinder.rod().energy_j();
  }
  if (swing_) {
    energy += swing_->platform.energy_j() + swing_->motor.left().energy_j() +
              swing_->motor.right().energy_j();
  }
  for (std::size_t p = 0; p < pump_count_; ++p) {
    energy += pump_[p].line().energy_j();
  }
  return energy;
}

ExcavatorPlant::AxisArray ExcavatorPlant::strokes_m() const {
  const auto& levers = links_.levers();
  return {levers[0].stroke_m, levers[1].stroke_m, levers[2].stroke_m};
}

ExcavatorPlant::AxisArray ExcavatorPlant::stroke_velocities_mps() const {
  const auto& levers = links_.levers();
  const JointArray rate = links_.rates();
  return {levers[0].stroke_per_angle_m * rate[0], levers[1].stroke_per_angle_m * rate[1],
          levers[2].stroke_per_angle_m * rate[2]};
}

ExcavatorPlant::AxisArray ExcavatorPlant::spool_travels_ratio() const {
  return {section_[0].spool().travel_ratio(), section_[1].spool().travel_ratio(),
          section_[2].spool().travel_ratio()};
}

double ExcavatorPlant::swing_rad() const {
  return swing_ ? swing_->platform.angle_rad() : start_swing_;
}

double ExcavatorPlant::swing_rate_radps() const {
  return swing_ ? swing_->platform.rate_radps() : 0.0;
}

double ExcavatorPlant::swing_inertia_kgm2() const {
  return swing_ ? swing_->platform.inertia_kgm2() : 0.0;
}

std::array<double, 2> ExcavatorPlant::swing_pressures_pa() const {
  if (!swing_) {
    return {};
  }
  const SectionFlows& flows = flows_[kSwing];
  return {valve_pressure_pa(kSwing, swing_->motor.left(), flows.cap_hose_m3ps, 0.0),
          valve_pressure_pa(kSwing, swing_->motor.right(), flows.rod_hose_m3ps, 0.0)};
}

double ExcavatorPlant::swing_spool_ratio() const {
  return swing_ ? section_[kSwing].spool().travel_ratio() : 0.0;
}

TipPose ExcavatorPlant::tip() const {
  TipPose pose = links_.tip();
  if (rocking_) {
    const Eigen::Vector2d& boom_foot_m = profile_.machine.geometry.boom_foot_m;
    pose.position_m = rocking_->on_ground(boom_foot_m + pose.position_m) - boom_foot_m;
    pose.attitude_rad += rocking_->angle_rad();
  }
  return pose;
}

TeethTruth ExcavatorPlant::teeth() const {
  const TipPose pose = tip();
  const Eigen::Vector2d& boom_foot_m = profile_.machine.geometry.boom_foot_m;
  const double radius = boom_foot_m.x() + pose.position_m.x();
  return {{radius * std::cos(swing_rad()), radius * std::sin(swing_rad()),
           boom_foot_m.y() + pose.position_m.y()},
          pose.attitude_rad};
}

ExcavatorPlant::PumpArray ExcavatorPlant::swash_ratios() const {
  return {pump_[0].swash_ratio(), pump_[1].swash_ratio()};
}

ExcavatorPlant::PumpArray ExcavatorPlant::pump_pressures_pa() const {
  return {pump_[0].pressure_pa(), pump_[1].pressure_pa()};
}

ExcavatorPlant::PumpArray ExcavatorPlant::pump_flows_m3ps() const {
  return {pump_[0].flows().delivered_m3ps, pump_[1].flows().delivered_m3ps};
}

}  // namespace graben::plant
