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
/// Station of an edge that does not reach a line.
constexpr double kBesideM = -1e9;
// On a curve the edge's ends leave their lines of ground for a while.
constexpr double kInsideEndM = 0.15;
/// How much harder than its power the part beyond the full one pulls an engine down.
constexpr double kOverload = 5.0;

Terrain ground_of(const DozerPlantProfile& profile) {
  const double end = profile.machine.grade.end_m();
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
      implement_(profile, lift_section(profile)),
      blade_(profile),
      cylinder_(profile.blade_cylinder(blade_.linkage().full_stroke_m()), step_s_) {
  cylinder_.start(blade_.stroke_m(), blade_.holding_force_n(0.0));
  if (profile.machine.tilt.present) {
    tilt_.emplace(profile, step_s_);
    const bool curves = profile.machine.grade.curves();
    cross_.emplace(terrain_, profile.machine.tilt.half_width_m() - (curves ? kInsideEndM : 0.0),
                   profile.machine.body.half_gauge_m);
    if (curves) {
      plan_.emplace(profile);
    }
  }
  if (profile.soil) {
    soil_.emplace(*profile.soil, profile);
  }
}

void DozerPlant::set_blade_duty(double duty_ratio, bool enable) {
  duty_ = enable && std::isfinite(duty_ratio) ? duty_ratio : 0.0;
}

void DozerPlant::set_tilt_duty(double duty_ratio, bool enable) {
  if (tilt_) {
    tilt_->set_duty(enable && std::isfinite(duty_ratio) ? duty_ratio : 0.0);
  }
}

void DozerPlant::set_tilt_pilot_fault(std::optional<double> held_ratio) {
  if (tilt_) {
    tilt_->set_pilot_fault(held_ratio);
  }
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
  const Eigen::Vector2d edge_before = cutting_middle_m();
  const auto beside_before = edge_beside_m();
  resist();
  drive();
  move_blade();
  const Eigen::Vector2d edge_after = cutting_middle_m();
  if (soil_) {
    soil_->move(edge_before, edge_after, terrain_);
    load_engine();
  } else {
    terrain_.cut(edge_before, edge_after);
  }
  cut_beside(beside_before);
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
  double more_right_n = 0.0;
  for (std::size_t i = 0; i < path_.size(); ++i) {
    const double load_n = cross_ ? body_.track_load_n(i) : 0.5 * body_.load_n();
    const double side = i == kLeft ? -1.0 : 1.0;
    const double turns_mps =
        plan_ ? side * plan_->yaw_rate_radps() * profile_.machine.body.half_gauge_m : 0.0;
    const double force_n = traction_[i].step(path_[i].track_speed_mps(),
                                             body_.ground_speed_mps() + turns_mps, load_n, step_s_);
    path_[i].step(engine_radps(), force_n, brake_);
    traction_n += force_n;
    more_right_n += side * force_n;
  }
  if (cross_) {
    TracksGround ground{cross_->left_track(), cross_->right_track()};
    if (plan_) {
      plan_->step(more_right_n, body_.load_n(), body_.ground_speed_mps(), position_m(), step_s_);
      body_.set_station_share(plan_->station_share(position_m()));
      ground.beyond = 0.5 * plan_->offset_m() / profile_.machine.body.half_gauge_m;
    }
    body_.step(ground, traction_n, step_s_);
    return;
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

double DozerPlant::share_flow() {
  const double pump_m3ps = implement_.pump_flow_m3ps(engine_radps());
  if (!tilt_) {
    return pump_m3ps;
  }
  const double lift_m3ps = implement_.demand_m3ps();
  const double tilt_m3ps = tilt_->demand_m3ps();
  const double share = std::min(1.0, pump_m3ps / std::max(lift_m3ps + tilt_m3ps, 1e-12));
  tilt_->step(share * tilt_m3ps, body_.roll_rad(), pilot_cut_);
  return share * lift_m3ps;
}

std::array<Eigen::Vector2d, CrossGround::kLines> DozerPlant::edge_beside_m() const {
  std::array<Eigen::Vector2d, CrossGround::kLines> at_m;
  at_m.fill(Eigen::Vector2d::Zero());
  for (std::size_t i = 0; cross_ && i < CrossGround::kLines; ++i) {
    const Eigen::Vector3d point = edge_over_m(cross_->across_m[i]);
    at_m[i] = {point.x(), point.z()};
    if (std::abs(point.y()) > profile_.machine.tilt.half_width_m()) {
      at_m[i].x() = kBesideM;
    }
  }
  return at_m;
}

Eigen::Vector3d DozerPlant::edge_over_m(double line_m) const {
  double along_edge_m = line_m;
  Eigen::Vector3d point = edge_point_m(along_edge_m);
  constexpr int kSteps = 2;
  for (int i = 0; plan_ && i < kSteps; ++i) {
    along_edge_m += line_m - point.y();
    point = edge_point_m(along_edge_m);
  }
  return {point.x(), along_edge_m, point.z()};
}

Eigen::Vector2d DozerPlant::cutting_middle_m() const {
  if (!plan_) {
    return cutting_edge_m();
  }
  const Eigen::Vector3d point = edge_over_m(0.0);
  return {point.x(), point.z()};
}

void DozerPlant::cut_beside(const std::array<Eigen::Vector2d, CrossGround::kLines>& from_m) {
  if (cross_) {
    const auto to_m = edge_beside_m();
    for (std::size_t i = 0; i < CrossGround::kLines; ++i) {
      if (from_m[i].x() != kBesideM && to_m[i].x() != kBesideM) {
        cross_->line[i].cut(from_m[i], to_m[i]);
      }
    }
  }
}

void DozerPlant::move_blade() {
  implement_.set_command(way_ * pilot_.step(duty_, pilot_cut_));
  const ImplementFlows& flows =
      implement_.solve(share_flow(), cylinder_.cap_port(), cylinder_.rod_port());
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
  const Eigen::Vector3d middle = edge_point_m(0.0);
  return {middle.x(), middle.z()};
}

Eigen::Vector3d DozerPlant::edge_point_m(double along_edge_m) const {
  const double pitch = body_.pitch_rad();
  const double cosine = std::cos(pitch);
  const double sine = std::sin(pitch);
  Eigen::Vector2d edge = blade_.linkage().edge_m(blade_.angle_rad());
  double across = along_edge_m;
  if (tilt_) {
    // Along the blade by its tilt, then with the frame's angle and the body's roll: from the left.
    const double raised = along_edge_m * std::sin(tilt_->angle_rad());
    const double level = along_edge_m * std::cos(tilt_->angle_rad());
    edge += raised * Eigen::Vector2d(-std::sin(blade_.angle_rad()), std::cos(blade_.angle_rad()));
    const double roll = body_.roll_rad();
    across = level * std::cos(roll) - edge.y() * std::sin(roll);
    edge.y() = edge.y() * std::cos(roll) + level * std::sin(roll);
  }
  const double ahead = edge.x() * cosine - edge.y() * sine;
  const double height = body_.height_m() + edge.x() * sine + edge.y() * cosine;
  if (plan_) {
    const PlanPlace place = plan_->place_of(body_.position_m(), ahead, across);
    return {place.station_m, place.offset_m, height};
  }
  return {body_.position_m() + ahead, across, height};
}

}  // namespace graben::plant
