// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The dozer's body on its tracks, after Mononen and Mattila (15) - (17).

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "app/plant/dozer_ground.hpp"
#include "app/plant/dozer_plant_profile.hpp"

namespace graben::plant {

/// What acts on the body beside the ground below its tracks.
struct BodyLoad {
  Eigen::Vector2d force_n = Eigen::Vector2d::Zero();  ///< World.
  double moment_nm = 0.0;    ///< About the mass centre; nose up is positive.
  bool tracks_turn = false;  ///< What the tracks drive with beyond the slope turns it about it too.
  double roll_nm = 0.0;      ///< About the longitudinal axis; left side up is positive.
};

/// Ground below each track's middle: straight across from one line of it to the other, and beyond
/// both alike.
struct TracksGround {
  const Terrain& left;
  const Terrain& right;
  double beyond = 0.0;  ///< So far left of them the tracks are, of what lies between them.
};

/// Wheels on springs and dampers that push only, evenly spaced over the contact. World frame, x
/// along the grade, z up; pitch is positive nose up. At rest on level ground the body frame's
/// origin is at the ground: unloaded, the wheels reach below it by the static sag.
///
/// Left out as in the paper, unless a load has it: the traction's moment on the pitch and, which
/// belongs to it, the mass centre's sway over the tracks. So (17) is of the origin, where the
/// tracks grip. What the blade's motion does to the body is left out too; its mass is part of the
/// body's.
class HalfVehicle {
 public:
  /// At rest on flat ground at z = 0.
  explicit HalfVehicle(const DozerPlantProfile& profile);

  /// Goes on by a step with the whole traction of both tracks, N along the body.
  void step(const Terrain& terrain, double traction_n, double step_s, const BodyLoad& load = {});
  /// The same on ground that differs below the two tracks: half of each wheel stands on either.
  void step(const TracksGround& ground, double traction_n, double step_s,
            const BodyLoad& load = {});
  /// Way along a track that curves in plan, on which `position_m` counts, over the body's.
  void set_station_share(double share) { station_share_ = share; }

  /// Of the body frame's origin.
  [[nodiscard]] double position_m() const { return position_; }
  [[nodiscard]] double height_m() const;
  [[nodiscard]] double velocity_mps() const { return velocity_; }
  [[nodiscard]] double climb_mps() const;
  [[nodiscard]] double pitch_rad() const { return pitch_; }
  [[nodiscard]] double pitch_rate_radps() const { return pitch_rate_; }
  /// Of the origin, along the body's x axis: what the tracks see of the ground.
  [[nodiscard]] double ground_speed_mps() const;

  /// What each wheel pressed with in the last step; 0 in the air.
  [[nodiscard]] const std::array<double, kMostWheels>& wheel_loads_n() const { return load_; }
  [[nodiscard]] double load_n() const { return whole_load_; }
  /// About its longitudinal axis, left side up positive. Its tracks grip, so that the origin stays
  /// on the middle line.
  [[nodiscard]] double roll_rad() const { return roll_; }
  [[nodiscard]] double roll_rate_radps() const { return roll_rate_; }
  [[nodiscard]] double track_load_n(std::size_t track) const { return track_load_[track]; }
  /// Of the mass centre, in the world.
  [[nodiscard]] double mass_centre_m() const { return mass_centre_; }
  [[nodiscard]] double wheel_place_m(int wheel) const;

 private:
  /// With cosine and sine of the pitch.
  [[nodiscard]] double wheel_load(const Terrain& terrain, double along_m, double cosine,
                                  double sine) const;
  /// One side's ground: its own line, and that of the other side.
  struct SideGround {
    const Terrain& own;
    const Terrain& other;
    double beyond;

    [[nodiscard]] double height_m(double x_m, double half_width_m) const;
    [[nodiscard]] double slope(double x_m, double half_width_m) const;
  };
  /// Half a wheel `across_m` to the left of the middle.
  [[nodiscard]] double half_wheel_load(const SideGround& ground, double along_m,
                                       double across_m) const;
  /// What is pressed of one side: with its moments about the mass centre.
  struct Side {
    double load_n = 0.0;
    double pitch_nm = 0.0;
    double roll_nm = 0.0;
  };
  Side press(const SideGround& ground, double across_m);
  /// By what the wheels press with, and their moment.
  void move(double moment, double traction_n, double step_s, const BodyLoad& load);
  [[nodiscard]] double rolling_resistance_n() const;

  DozerBody body_;
  double pitch_inertia_;
  double gravity_;
  double rolling_resistance_;
  double rolling_onset_;
  double wheel_half_width_;
  double wheel_depth_;  ///< Of the unloaded wheels' bottoms below the mass centre.

  double position_;
  double mass_centre_;  ///< Its height.
  double pitch_ = 0.0;
  double velocity_ = 0.0;
  double station_share_ = 1.0;
  double mass_centre_climb_ = 0.0;
  double pitch_rate_ = 0.0;
  double roll_inertia_;
  double roll_ = 0.0;
  double roll_rate_ = 0.0;
  std::array<double, kTrackCount> track_load_{};
  std::array<double, kMostWheels> load_{};
  double whole_load_;
};

}  // namespace graben::plant
