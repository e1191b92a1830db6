// SPDX-License-Identifier: Apache-2.0
#include "app/plant/dozer_plant.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "firmware/numeric/constants.hpp"

namespace graben::plant {
namespace {

// Ground that is kept beyond the grade: what lies before the start and the machine itself.
constexpr double kGroundBehindM = 6.0;
constexpr double kGroundAheadM = 10.0;
/// Of the strips of the edge, the one over the middle line.
constexpr std::size_t kMiddle = kEdgeStrips / 2;
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
      path_{HstPath(profile, kLeft), HstPath(profile, kRight)},
      traction_{Traction(profile), Traction(profile)},
      pilot_(profile.valve(0).dead_time, profile.valve(0).pilot_lag_s, step_s_),
      implement_(profile, lift_section(profile)),
      blade_(profile),
      cylinder_(profile.blade_cylinder(blade_.linkage().full_stroke_m()), step_s_) {
  cylinder_.start(blade_.stroke_m(), blade_.holding_force_n(0.0));
  edge_mps_.fill(Eigen::Vector2d::Zero());
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
  const EdgePlaces before = edge_places();
  if (soil_) {
    resist(before);
  }
  drive();
  move_blade();
  cut(before, edge_places());
  if (soil_) {
    load_engine();
  }
}

void DozerPlant::resist(const EdgePlaces& edge) {
  if (!cross_) {
    soil_load_.force_n =
        soil_->force_n(edge[kMiddle].at_m, edge_mps_[kMiddle], body_.pitch_rad(), terrain_);
    return;
  }
  const double half_m = profile_.machine.tilt.half_width_m();
  const auto share = strip_shares(edge, half_m);
  const EdgeStand stand = edge_stand();
  soil_load_ = {};
  for (std::size_t i = 0; i < kEdgeStrips; ++i) {
    if (edge[i].reached) {
      const double along_m = edge[i].along_m;
      const Eigen::Vector2d force_n =
          share[i] * soil_->force_n(edge[i].at_m, edge_mps_[i], body_.pitch_rad(), ground_below(i),
                                    along_m / half_m);
      add_strip(stand, body_rotation() * edge_in_body_m(along_m), force_n, soil_load_);
    }
  }
}

void DozerPlant::cut(const EdgePlaces& from, const EdgePlaces& to) {
  std::array<double, kEdgeStrips> share{};
  share[kMiddle] = 1.0;
  if (cross_) {
    share = strip_shares(to, profile_.machine.tilt.half_width_m());
  }
  for (std::size_t i = 0; i < kEdgeStrips; ++i) {
    edge_mps_[i].setZero();
    if (!from[i].reached || !to[i].reached) {
      continue;
    }
    if (soil_) {
      soil_->cut_strip(from[i].at_m, to[i].at_m, share[i], ground_below(i));
    } else {
      ground_below(i).cut(from[i].at_m, to[i].at_m);
    }
    edge_mps_[i] = (to[i].at_m - from[i].at_m) / step_s_;
  }
  if (soil_) {
    soil_->go_on(to[kMiddle].at_m.x() - from[kMiddle].at_m.x());
  }
}

Terrain& DozerPlant::ground_below(std::size_t strip) {
  return strip == kMiddle ? terrain_ : cross_->line[strip < kMiddle ? strip : strip - 1];
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
      plan_->step(more_right_n, soil_load_.yaw_nm, body_.load_n(), body_.ground_speed_mps(),
                  position_m(), step_s_);
      body_.set_station_share(plan_->station_share(position_m()));
      ground.beyond = 0.5 * plan_->offset_m() / profile_.machine.body.half_gauge_m;
    }
    body_.step(ground, traction_n, step_s_, body_load());
    return;
  }
  body_.step(terrain_, traction_n, step_s_, body_load());
}

BodyLoad DozerPlant::body_load() const {
  if (!soil_) {
    return {};
  }
  const Eigen::Vector2d& force_n = soil_load_.force_n;
  if (cross_) {
    return {force_n, soil_load_.pitch_nm, true, soil_load_.roll_nm};
  }
  const Eigen::Vector2d edge = cutting_edge_m();
  const Eigen::Vector2d arm = {
      edge.x() - body_.position_m() +
          profile_.machine.body.mass_centre_height_m * std::sin(body_.pitch_rad()),
      edge.y() - body_.mass_centre_m()};
  return {force_n, arm.x() * force_n.y() - arm.y() * force_n.x(), true};
}

double DozerPlant::share_flow() {
  const double pump_m3ps = implement_.pump_flow_m3ps(engine_radps());
  if (!tilt_) {
    return pump_m3ps;
  }
  const double lift_m3ps = implement_.demand_m3ps();
  const double tilt_m3ps = tilt_->demand_m3ps();
  const double share = std::min(1.0, pump_m3ps / std::max(lift_m3ps + tilt_m3ps, 1e-12));
  tilt_->step(share * tilt_m3ps, body_.roll_rad(), pilot_cut_, soil_load_.tilt_nm);
  return share * lift_m3ps;
}

EdgePlaces DozerPlant::edge_places() const {
  EdgePlaces places;
  for (std::size_t i = 0; i < kEdgeStrips; ++i) {
    if (i == kMiddle) {
      places[i] = edge_over(0.0);
      places[i].reached = true;
    } else if (cross_) {
      places[i] = edge_over(cross_->across_m[i < kMiddle ? i : i - 1]);
    }
  }
  return places;
}

EdgePlace DozerPlant::edge_over(double line_m) const {
  double along_edge_m = line_m;
  Eigen::Vector3d point = edge_point_m(along_edge_m);
  constexpr int kSteps = 2;
  for (int i = 0; plan_ && i < kSteps; ++i) {
    along_edge_m += line_m - point.y();
    point = edge_point_m(along_edge_m);
  }
  const bool reached = std::abs(along_edge_m) <= profile_.machine.tilt.half_width_m();
  return {reached, along_edge_m, {point.x(), point.z()}};
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
  if (cross_) {
    return soil_load_.lift_nm;
  }
  const Eigen::Vector2d& force_n = soil_load_.force_n;
  const double cosine = std::cos(body_.pitch_rad());
  const double sine = std::sin(body_.pitch_rad());
  const Eigen::Vector2d in_body = {cosine * force_n.x() + sine * force_n.y(),
                                   cosine * force_n.y() - sine * force_n.x()};
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

Eigen::Vector3d DozerPlant::edge_in_body_m(double along_edge_m) const {
  const Eigen::Vector2d edge = blade_.linkage().edge_m(blade_.angle_rad());
  const double tilt_rad = tilt_ ? tilt_->angle_rad() : 0.0;
  // Along the blade by its tilt, then with the frame's angle.
  const double raised = along_edge_m * std::sin(tilt_rad);
  return {edge.x() - raised * std::sin(blade_.angle_rad()), along_edge_m * std::cos(tilt_rad),
          edge.y() + raised * std::cos(blade_.angle_rad())};
}

Eigen::Matrix3d DozerPlant::body_rotation() const {
  return (Eigen::AngleAxisd(-body_.pitch_rad(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(body_.roll_rad(), Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

EdgeStand DozerPlant::edge_stand() const {
  const Eigen::Matrix3d body = body_rotation();
  const Eigen::Vector2d& pivot = profile_.machine.blade.pivot_m;
  const double lift_rad = blade_.angle_rad();
  EdgeStand stand;
  stand.edge_middle_m = body * edge_in_body_m(0.0);
  stand.pivot_m = body * Eigen::Vector3d(pivot.x(), 0.0, pivot.y());
  stand.mass_centre_m =
      profile_.machine.body.mass_centre_height_m * body * Eigen::Vector3d::UnitZ();
  stand.blade_axis = body * Eigen::Vector3d(std::cos(lift_rad), 0.0, std::sin(lift_rad));
  stand.body_axis = body * Eigen::Vector3d::UnitX();
  stand.lift_axis = body * Eigen::Vector3d::UnitY();
  return stand;
}

Eigen::Vector3d DozerPlant::edge_point_m(double along_edge_m) const {
  const double pitch = body_.pitch_rad();
  const double cosine = std::cos(pitch);
  const double sine = std::sin(pitch);
  Eigen::Vector3d edge = edge_in_body_m(along_edge_m);
  if (tilt_) {
    const double roll = body_.roll_rad();
    const double level = edge.y();
    edge.y() = level * std::cos(roll) - edge.z() * std::sin(roll);
    edge.z() = edge.z() * std::cos(roll) + level * std::sin(roll);
  }
  const double ahead = edge.x() * cosine - edge.z() * sine;
  const double height = body_.height_m() + edge.x() * sine + edge.z() * cosine;
  if (plan_) {
    const PlanPlace place = plan_->place_of(body_.position_m(), ahead, edge.y());
    return {place.station_m, place.offset_m, height};
  }
  return {body_.position_m() + ahead, edge.y(), height};
}

}  // namespace graben::plant
