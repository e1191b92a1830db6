// SPDX-License-Identifier: Apache-2.0
#include "app/plant/dozer_plant.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/numeric/constants.hpp"

namespace graben::plant {
namespace {

// Ground that is kept beyond the grade: what lies before the start and the machine itself.
constexpr double kGroundBehindM = 6.0;
constexpr double kGroundAheadM = 10.0;
/// How much harder than its power the part beyond the full one pulls an engine down.
constexpr double kOverload = 5.0;

Terrain ground_of(const DozerPlantProfile& profile) {
  const GradeDesign& grade = profile.machine.grade;
  const double end =
      grade.count > 0 ? grade.point[static_cast<std::size_t>(grade.count) - 1].x_m : 0.0;
  return {profile.start_position_m - kGroundBehindM,
          std::max(end, profile.start_position_m) + kGroundAheadM, profile.terrain_cell_m};
}

}  // namespace

DozerPlant::DozerPlant(const DozerPlantProfile& profile)
    : profile_(profile),
      step_s_(profile.step_s()),
      engine_radps_(profile.machine.hst.engine_radps),
      engine_(profile.soil ? profile.engine_sag : EngineSag{}, step_s_),
      terrain_(ground_of(profile)),
      body_(profile),
      path_{HstPath(profile), HstPath(profile)},
      traction_{Traction(profile), Traction(profile)},
      pilot_(profile.dead_time_s, 0.0, step_s_),
      implement_(profile),
      blade_(profile),
      cylinder_(profile.blade_cylinder(blade_.linkage().full_stroke_m()), step_s_) {
  cylinder_.start(blade_.stroke_m(), blade_.holding_force_n(0.0));
  if (profile.soil) {
    soil_.emplace(*profile.soil, profile);
  }
}

void DozerPlant::set_blade_duty(double duty_ratio, bool enable) {
  duty_ = enable && std::isfinite(duty_ratio) ? duty_ratio : 0.0;
}

void DozerPlant::set_displacements(const TrackArray& pump_ratio, const TrackArray& motor_ratio) {
  for (std::size_t i = 0; i < path_.size(); ++i) {
    path_[i].pump().set_wanted(pump_ratio[i]);
    path_[i].motor().set_wanted(motor_ratio[i]);
  }
}

void DozerPlant::set_engine_radps(double engine_radps) {
  engine_radps_ = std::isfinite(engine_radps) ? std::max(0.0, engine_radps) : 0.0;
}

void DozerPlant::advance(TimeUs duration_us) {
  pending_us_ += duration_us;
  while (pending_us_ >= profile_.step_us) {
    pending_us_ -= profile_.step_us;
    step();
  }
}

void DozerPlant::step() {
  const Eigen::Vector2d edge_before = cutting_edge_m();
  resist();
  drive();
  move_blade();
  const Eigen::Vector2d edge_after = cutting_edge_m();
  if (soil_) {
    soil_->move(edge_before, edge_after, terrain_);
    load_engine();
  } else {
    terrain_.cut(edge_before, edge_after);
  }
  edge_mps_ = (edge_after - edge_before) / step_s_;
}

void DozerPlant::resist() {
  if (soil_) {
    soil_force_n_ = soil_->force_n(cutting_edge_m(), edge_mps_, body_.pitch_rad(), terrain_);
  }
}

void DozerPlant::load_engine() {
  double power_w = 0.0;
  for (HstPath& path : path_) {
    const auto pressure_pa = path.pressures_pa();
    power_w += path.pump().ratio() * profile_.machine.hst.pump_m3prev / kTwoPi * engine_radps() *
               (pressure_pa[0] - pressure_pa[1]);
  }
  const double share = std::max(0.0, power_w) / profile_.engine_power_w;
  // Beyond its full power it is pulled down until the pumps take less.
  engine_.step(share + kOverload * std::max(0.0, share - 1.0));
}

void DozerPlant::drive() {
  double traction_n = 0.0;
  for (std::size_t i = 0; i < path_.size(); ++i) {
    const double force_n = traction_[i].step(path_[i].track_speed_mps(), body_.ground_speed_mps(),
                                             0.5 * body_.load_n(), step_s_);
    path_[i].step(engine_radps(), force_n, brake_);
    traction_n += force_n;
  }
  BodyLoad load;
  if (soil_) {
    const Eigen::Vector2d edge = cutting_edge_m();
    const Eigen::Vector2d arm = {
        edge.x() - body_.position_m() +
            profile_.machine.body.mass_centre_height_m * std::sin(body_.pitch_rad()),
        edge.y() - body_.mass_centre_m()};
    load = {soil_force_n_, arm.x() * soil_force_n_.y() - arm.y() * soil_force_n_.x(), true};
  }
  body_.step(terrain_, traction_n, step_s_, load);
}

void DozerPlant::move_blade() {
  implement_.set_command(way_ * pilot_.step(duty_, pilot_cut_));
  const ImplementFlows& flows =
      implement_.solve(engine_radps(), cylinder_.cap_port(), cylinder_.rod_port());
  const double velocity =
      blade_.accelerate(cylinder_.load(), body_.pitch_rad(), step_s_, soil_moment_nm());
  blade_.move(step_s_);
  cylinder_.step(flows.cap_in, flows.rod_in, velocity);
  cylinder_.set_motion(blade_.stroke_m(), blade_.velocity_mps());
  implement_.step(step_s_);
}

double DozerPlant::soil_moment_nm() const {
  const double cosine = std::cos(body_.pitch_rad());
  const double sine = std::sin(body_.pitch_rad());
  const Eigen::Vector2d in_body = {cosine * soil_force_n_.x() + sine * soil_force_n_.y(),
                                   cosine * soil_force_n_.y() - sine * soil_force_n_.x()};
  const Eigen::Vector2d arm =
      blade_.linkage().edge_m(blade_.angle_rad()) - profile_.machine.blade.pivot_m;
  return arm.x() * in_body.y() - arm.y() * in_body.x();
}

DozerPlant::TrackArray DozerPlant::pump_ratios() const {
  return {path_[kLeft].pump().ratio(), path_[kRight].pump().ratio()};
}

DozerPlant::TrackArray DozerPlant::motor_ratios() const {
  return {path_[kLeft].motor().ratio(), path_[kRight].motor().ratio()};
}

DozerPlant::TrackArray DozerPlant::track_speeds_mps() const {
  return {path_[kLeft].track_speed_mps(), path_[kRight].track_speed_mps()};
}

DozerPlant::TrackArray DozerPlant::slips() const {
  return {traction_[kLeft].slip(), traction_[kRight].slip()};
}

Eigen::Vector2d DozerPlant::cutting_edge_m() const {
  const double pitch = body_.pitch_rad();
  const double cosine = std::cos(pitch);
  const double sine = std::sin(pitch);
  const Eigen::Vector2d edge = blade_.linkage().edge_m(blade_.angle_rad());
  return {body_.position_m() + edge.x() * cosine - edge.y() * sine,
          body_.height_m() + edge.x() * sine + edge.y() * cosine};
}

}  // namespace graben::plant
