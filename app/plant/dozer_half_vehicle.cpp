// SPDX-License-Identifier: Apache-2.0
#include "app/plant/dozer_half_vehicle.hpp"

#include <algorithm>
#include <cmath>

namespace graben::plant {

HalfVehicle::HalfVehicle(const DozerPlantProfile& profile)
    : body_(profile.machine.body),
      pitch_inertia_(profile.pitch_inertia_kgm2),
      gravity_(profile.gravity_mps2),
      rolling_resistance_(profile.ground.rolling_resistance),
      rolling_onset_(profile.rolling_onset_mps),
      wheel_half_width_(profile.wheel_half_width_m),
      wheel_depth_(body_.mass_centre_height_m +
                   body_.mass_kg * gravity_ / (body_.wheels * body_.suspension_npm)),
      position_(profile.start_position_m),
      mass_centre_(body_.mass_centre_height_m),
      roll_inertia_(profile.tilt.roll_inertia_kgm2),
      track_load_{0.5 * body_.mass_kg * gravity_, 0.5 * body_.mass_kg * gravity_},
      whole_load_(body_.mass_kg * gravity_) {
  for (int i = 0; i < body_.wheels; ++i) {
    load_[static_cast<std::size_t>(i)] = whole_load_ / body_.wheels;
  }
}

double HalfVehicle::wheel_place_m(int wheel) const {
  return body_.track_contact_m * (static_cast<double>(wheel) / (body_.wheels - 1) - 0.5);
}

double HalfVehicle::height_m() const {
  return mass_centre_ - body_.mass_centre_height_m * std::cos(pitch_) * std::cos(roll_);
}

double HalfVehicle::climb_mps() const {
  const double high = body_.mass_centre_height_m;
  return mass_centre_climb_ + high * std::sin(pitch_) * std::cos(roll_) * pitch_rate_ +
         high * std::cos(pitch_) * std::sin(roll_) * roll_rate_;
}

double HalfVehicle::ground_speed_mps() const {
  return velocity_ * std::cos(pitch_) + climb_mps() * std::sin(pitch_);
}

double HalfVehicle::wheel_load(const Terrain& terrain, double along_m, double cosine,
                               double sine) const {
  // The wheel's bottom, l along and the sag below the origin, in the world and against the ground.
  const double sag = wheel_depth_ - body_.mass_centre_height_m;
  const double ahead = along_m * cosine + sag * sine;
  const double x = position_ + ahead;
  const double z = mass_centre_ + along_m * sine - wheel_depth_ * cosine;
  const double compression = terrain.mean_height_m(x, wheel_half_width_) - z;
  if (compression <= 0.0) {
    return 0.0;
  }
  const double forward = velocity_ - pitch_rate_ * (along_m * sine - sag * cosine);
  const double upward = mass_centre_climb_ + pitch_rate_ * (along_m * cosine + wheel_depth_ * sine);
  const double rate = terrain.mean_slope(x, wheel_half_width_) * forward - upward;
  return std::max(0.0, body_.suspension_npm * compression + body_.suspension_nspm * rate);
}

double HalfVehicle::rolling_resistance_n() const {
  return rolling_resistance_ * whole_load_ * std::tanh(ground_speed_mps() / rolling_onset_);
}

void HalfVehicle::step(const Terrain& terrain, double traction_n, double step_s,
                       const BodyLoad& load) {
  const double cosine = std::cos(pitch_);
  const double sine = std::sin(pitch_);
  whole_load_ = 0.0;
  double moment = 0.0;
  for (int i = 0; i < body_.wheels; ++i) {
    const double along = wheel_place_m(i);
    const double pressed = wheel_load(terrain, along, cosine, sine);
    load_[static_cast<std::size_t>(i)] = pressed;
    whole_load_ += pressed;
    moment += pressed * (along * cosine + wheel_depth_ * sine);
  }
  move(moment, traction_n, step_s, load);
}

double HalfVehicle::SideGround::height_m(double x_m, double half_width_m) const {
  const double own_m = own.mean_height_m(x_m, half_width_m);
  return beyond == 0.0 ? own_m : own_m + beyond * (own_m - other.mean_height_m(x_m, half_width_m));
}

double HalfVehicle::SideGround::slope(double x_m, double half_width_m) const {
  const double slope = own.mean_slope(x_m, half_width_m);
  return beyond == 0.0 ? slope : slope + beyond * (slope - other.mean_slope(x_m, half_width_m));
}

double HalfVehicle::half_wheel_load(const SideGround& ground, double along_m,
                                    double across_m) const {
  const double cosine = std::cos(pitch_);
  const double sine = std::sin(pitch_);
  const double sag = wheel_depth_ - body_.mass_centre_height_m;
  // In the body's roll: the bottom's height below the mass centre, and how a roll moves it.
  const double below = wheel_depth_ * std::cos(roll_) - across_m * std::sin(roll_);
  const double beside = wheel_depth_ * std::sin(roll_) + across_m * std::cos(roll_);
  const double x = position_ + along_m * cosine + sag * sine;
  const double z = mass_centre_ + along_m * sine - below * cosine;
  const double compression = ground.height_m(x, wheel_half_width_) - z;
  if (compression <= 0.0) {
    return 0.0;
  }
  const double forward = velocity_ - pitch_rate_ * (along_m * sine - sag * cosine);
  const double upward = mass_centre_climb_ + pitch_rate_ * (along_m * cosine + below * sine) +
                        roll_rate_ * beside * cosine;
  const double rate = ground.slope(x, wheel_half_width_) * forward - upward;
  return 0.5 * std::max(0.0, body_.suspension_npm * compression + body_.suspension_nspm * rate);
}

HalfVehicle::Side HalfVehicle::press(const SideGround& ground, double across_m) {
  const double cosine = std::cos(pitch_);
  const double sine = std::sin(pitch_);
  const double below = wheel_depth_ * std::cos(roll_) - across_m * std::sin(roll_);
  const double beside = wheel_depth_ * std::sin(roll_) + across_m * std::cos(roll_);
  Side side;
  for (int i = 0; i < body_.wheels; ++i) {
    const double along = wheel_place_m(i);
    const double pressed = half_wheel_load(ground, along, across_m);
    load_[static_cast<std::size_t>(i)] += pressed;
    side.load_n += pressed;
    side.pitch_nm += pressed * (along * cosine + below * sine);
    side.roll_nm += pressed * beside * cosine;
  }
  return side;
}

void HalfVehicle::step(const TracksGround& ground, double traction_n, double step_s,
                       const BodyLoad& load) {
  load_ = {};
  const Side left = press({ground.left, ground.right, ground.beyond}, body_.half_gauge_m);
  const Side right = press({ground.right, ground.left, -ground.beyond}, -body_.half_gauge_m);
  track_load_ = {left.load_n, right.load_n};
  whole_load_ = left.load_n + right.load_n;
  move(left.pitch_nm + right.pitch_nm, traction_n, step_s, load);
  roll_rate_ += step_s * (left.roll_nm + right.roll_nm + load.roll_nm) / roll_inertia_;
  roll_ += step_s * roll_rate_;
}

void HalfVehicle::move(double moment, double traction_n, double step_s, const BodyLoad& load) {
  const double cosine = std::cos(pitch_);
  const double sine = std::sin(pitch_);
  const double mass = body_.mass_kg;
  const double along_body = traction_n - mass * gravity_ * sine - rolling_resistance_n();
  moment += load.moment_nm;
  if (load.tracks_turn) {
    // Only what is more than the slope takes: that much the wheels' levers have already.
    moment += along_body * body_.mass_centre_height_m;
  }
  velocity_ += step_s * (cosine * along_body + load.force_n.x()) / mass;
  mass_centre_climb_ += step_s * ((whole_load_ + load.force_n.y()) / mass - gravity_);
  pitch_rate_ += step_s * moment / pitch_inertia_;
  position_ += step_s * station_share_ * velocity_;
  mass_centre_ += step_s * mass_centre_climb_;
  pitch_ += step_s * pitch_rate_;
}

}  // namespace graben::plant
