// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The simulated dozer on its way: body, ground, blade, implement circuit, transmission.

#include <Eigen/Core>
#include <array>
#include <optional>

#include "app/plant/cylinder.hpp"
#include "app/plant/dozer_blade_joint.hpp"
#include "app/plant/dozer_blade_soil.hpp"
#include "app/plant/dozer_cross_ground.hpp"
#include "app/plant/dozer_edge_load.hpp"
#include "app/plant/dozer_ground.hpp"
#include "app/plant/dozer_half_vehicle.hpp"
#include "app/plant/dozer_hst_path.hpp"
#include "app/plant/dozer_implement.hpp"
#include "app/plant/dozer_plan.hpp"
#include "app/plant/dozer_plant_profile.hpp"
#include "app/plant/dozer_tilt.hpp"
#include "app/plant/spool.hpp"
#include "firmware/core/time.hpp"
#include "firmware/dozer/dozer_signals.hpp"

namespace graben::plant {

/// Mononen and Mattila's dozer (15) - (17) with what their detailed model adds: soil shear under
/// the tracks, compressible lines and chambers, displacement and spool dynamics, deadband, leakage,
/// friction. The ground's resistance to the blade is left out as in the paper (a finishing cut)
/// and the engine holds its speed, unless the profile has a soil. Deterministic: the same calls
/// give the same numbers.
///
/// A machine whose blade tilts rolls on ground that differs below its tracks, and each part of its
/// edge cuts its own line of it, with its own part of the soil's force: that rolls the body, turns
/// the blade against its tilt cylinder, and turns the machine. Lift and tilt share the pump's flow
/// as their spools ask for it. On a design whose track curves it turns as its tracks push and its
/// blade is held, see PlanMotion, and x is the station along the track, y the offset to the left of
/// it; else it drives straight, whatever turns it. Its wheels, and the soil, see the ground as if
/// that lay unrolled.
///
/// One step, from the state at t to that at t + h: tracks against the ground, transmission, body;
/// implement valve between the chambers' waves, blade against their impedance, their waves; then
/// the cut along the edge's way.
class DozerPlant {
 public:
  using TrackArray = std::array<double, kTrackCount>;

  /// At rest at the profile's start on flat ground at z = 0, blade at home, spool closed, the
  /// chambers carrying the blade, the transmission's lines at charge pressure, brake on.
  explicit DozerPlant(const DozerPlantProfile& profile);

  /// Duty -1 .. 1 is the wanted spool travel of full travel; + extends, which lowers the blade.
  /// Without `enable` neutral; a value that is not finite counts as 0.
  void set_blade_duty(double duty_ratio, bool enable);
  /// The same of the tilt; nothing without one.
  void set_tilt_duty(double duty_ratio, bool enable);
  /// Wanted displacements, left and right, limited to -1 .. 1 and motor_ratio_min .. 1. What is not
  /// finite counts as 0 of a pump and 1 of a motor.
  void set_displacements(const TrackArray& pump_ratio, const TrackArray& motor_ratio);
  /// The parking brake holds the sprockets.
  void set_brake(bool on) { brake_ = on; }
  /// Without pilot pressure the spool centres by its springs, whatever its pilot valve does.
  void set_pilot_cut(bool cut) { pilot_cut_ = cut; }
  /// Not finite or negative counts as standing still.
  void set_engine_radps(double engine_radps);
  /// Share of that speed that it runs at; 0: it stands.
  void set_engine_ratio(double ratio) { engine_.set_ratio(ratio); }

  /// A pilot valve that sends the spool to `held_ratio` whatever the duty, or `offset_ratio` beyond
  /// what the duty asks for.
  void set_pilot_fault(std::optional<double> held_ratio, double offset_ratio) {
    pilot_.set_fault(held_ratio, offset_ratio);
  }
  void set_tilt_pilot_fault(std::optional<double> held_ratio);
  /// The blade's hoses are reversed.
  void set_reversed(bool reversed) { way_ = reversed ? -1.0 : 1.0; }
  void set_pump_fault(std::size_t track, const DisplacementFault& fault) {
    path_[track].pump().set_fault(fault);
  }
  void set_motor_fault(std::size_t track, const DisplacementFault& fault) {
    path_[track].motor().set_fault(fault);
  }

  /// Runs on. What is shorter than a step is kept for the next call.
  void advance(TimeUs duration_us);

  /// From the blade fully raised on; extension lowers.
  [[nodiscard]] double blade_stroke_m() const { return blade_.stroke_m(); }
  [[nodiscard]] double blade_velocity_mps() const { return blade_.velocity_mps(); }
  /// Of its whole travel, the deadband included.
  [[nodiscard]] double spool_travel_ratio() const { return implement_.spool().travel_ratio(); }

  /// Of the body frame's origin: at the tracks' ground line below the mass centre. On level ground
  /// at rest its height is the ground's.
  [[nodiscard]] double position_m() const { return body_.position_m(); }
  [[nodiscard]] double height_m() const { return body_.height_m(); }
  [[nodiscard]] double pitch_rad() const { return body_.pitch_rad(); }
  [[nodiscard]] double velocity_mps() const { return body_.velocity_mps(); }
  [[nodiscard]] double climb_mps() const { return body_.climb_mps(); }
  [[nodiscard]] double pitch_rate_radps() const { return body_.pitch_rate_radps(); }

  [[nodiscard]] TrackArray pump_ratios() const;
  [[nodiscard]] TrackArray motor_ratios() const;
  [[nodiscard]] TrackArray track_speeds_mps() const;
  [[nodiscard]] TrackArray slips() const;
  [[nodiscard]] double engine_radps() const { return engine_.speed_ratio() * engine_radps_; }

  [[nodiscard]] double roll_rad() const { return body_.roll_rad(); }
  [[nodiscard]] double roll_rate_radps() const { return body_.roll_rate_radps(); }
  /// Without one the machine's blade does not tilt.
  [[nodiscard]] const std::optional<TiltDrive>& tilt() const { return tilt_; }

  /// On a design whose track curves.
  [[nodiscard]] const std::optional<PlanMotion>& plan() const { return plan_; }
  /// Velocity along the track.
  [[nodiscard]] double station_mps() const {
    return plan_ ? plan_->station_share(position_m()) * velocity_mps() : velocity_mps();
  }

  /// Its middle, in the world, x and z.
  [[nodiscard]] Eigen::Vector2d cutting_edge_m() const;
  /// So far to the left along the edge; x, y, z.
  [[nodiscard]] Eigen::Vector3d edge_point_m(double along_edge_m) const;
  [[nodiscard]] const Terrain& terrain() const { return terrain_; }
  /// Beside the middle; of a machine whose blade tilts.
  [[nodiscard]] const std::optional<CrossGround>& cross_ground() const { return cross_; }
  /// What the soil does to the blade, in the world, N; nothing without a soil.
  [[nodiscard]] const Eigen::Vector2d& soil_force_n() const { return soil_load_.force_n; }
  [[nodiscard]] const EdgeLoad& soil_load() const { return soil_load_; }
  /// Of what is before the blade, loose, m^3.
  [[nodiscard]] double carried_m3() const { return soil_ ? soil_->carried_m3() : 0.0; }

  [[nodiscard]] const HalfVehicle& body() const { return body_; }
  [[nodiscard]] const HstPath& path(std::size_t track) const { return path_[track]; }
  [[nodiscard]] const BladeJoint& blade() const { return blade_; }
  [[nodiscard]] const Cylinder& cylinder() const { return cylinder_; }
  /// Demand of the spool's opening, what the pump gives, what flowed.
  [[nodiscard]] const ImplementFlows& implement_flows() const { return implement_.flows(); }
  [[nodiscard]] const DozerPlantProfile& profile() const { return profile_; }

 private:
  void step();
  /// What the soil does to the edge there.
  void resist(const EdgePlaces& edge);
  [[nodiscard]] BodyLoad body_load() const;
  /// About the blade's pivot; raising it is positive.
  [[nodiscard]] double soil_moment_nm() const;
  [[nodiscard]] EdgeStand edge_stand() const;
  void drive();
  void load_engine();
  void move_blade();
  /// What the lift has of the pump's flow, m^3/s, the tilt's share moved.
  double share_flow();
  void cut(const EdgePlaces& from, const EdgePlaces& to);
  [[nodiscard]] Terrain& ground_below(std::size_t strip);
  /// Where the edge lies over each line of the ground; over the middle one alone without a tilt.
  [[nodiscard]] EdgePlaces edge_places() const;
  /// Over one so far left of the track.
  [[nodiscard]] EdgePlace edge_over(double line_m) const;
  [[nodiscard]] Eigen::Vector3d edge_in_body_m(double along_edge_m) const;
  /// By pitch and roll.
  [[nodiscard]] Eigen::Matrix3d body_rotation() const;

  DozerPlantProfile profile_;
  double step_s_;
  TimeUs pending_us_ = 0;
  double engine_radps_;
  Engine engine_;
  double way_ = 1.0;  ///< -1: the blade is reversed.
  double duty_ = 0.0;
  bool brake_ = true;
  bool pilot_cut_ = false;

  Terrain terrain_;
  HalfVehicle body_;
  std::array<HstPath, kTrackCount> path_;
  std::array<Traction, kTrackCount> traction_;
  PilotValve pilot_;
  ImplementCircuit implement_;
  BladeJoint blade_;
  Cylinder cylinder_;
  std::optional<TiltDrive> tilt_;
  std::optional<CrossGround> cross_;
  std::optional<PlanMotion> plan_;
  std::optional<BladeSoil> soil_;
  EdgeLoad soil_load_;
  std::array<Eigen::Vector2d, kEdgeStrips> edge_mps_;
};

}  // namespace graben::plant
