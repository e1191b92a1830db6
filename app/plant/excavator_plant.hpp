// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The simulated excavator: pumps, main control valve, cylinders, links, and on a machine with a
/// swing drive its motor and platform; else the swing is held.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "app/plant/cylinder.hpp"
#include "app/plant/energy_account.hpp"
#include "app/plant/engine.hpp"
#include "app/plant/excavator_plant_profile.hpp"
#include "app/plant/linkage_dynamics.hpp"
#include "app/plant/pump_line.hpp"
#include "app/plant/rocking_base.hpp"
#include "app/plant/soil/bucket_soil.hpp"
#include "app/plant/spool.hpp"
#include "app/plant/swing_drive.hpp"
#include "app/plant/valve_section.hpp"
#include "firmware/core/time.hpp"

namespace graben::plant {

/// Where the bucket's teeth are over the ground: x and y level, z up, origin where the swing axis
/// meets the ground; swing 0 looks along x and turns towards y to the left.
struct TeethTruth {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  double attitude_rad = 0.0;  ///< See TipPose.
};

/// The circuit of Kim 3 with what his detailed model adds (Kim 5): compressible chambers and lines,
/// spool dynamics, deadband, leakage, link inertia, friction; in addition port reliefs, make-up
/// checks, hoses, cushions and end stops. Deterministic: the same calls give the same numbers.
///
/// Every volume is a transmission-line element, so that within a step each orifice sees two ports
/// only and is solved in closed form: stable at any step length and bulk modulus. The step decides
/// accuracy, which is of second order but for the elements' small filter.
///
/// One step, from the state at t to that at t + h: valve sections between the ports' waves, then
/// the pumps with their bypasses, then the links against the chambers' impedance, then the platform
/// with the links where they are now, then all waves.
class ExcavatorPlant {
 public:
  using AxisArray = std::array<double, kAxisCount>;
  using DriveArray = std::array<double, kDriveCount>;
  using PumpArray = std::array<double, kPumpCount>;

  /// Starts in static equilibrium: spools closed, chamber pressures carry the links' weight, pumps
  /// in standby, the platform at rest. Each stroke must be within its cylinder's.
  ExcavatorPlant(const ExcavatorPlantProfile& profile, const AxisArray& start_strokes_m,
                 double start_swing_rad = 0.0);

  /// Duty -1 .. 1 is the wanted spool travel in units of full travel; without `enable` neutral.
  /// A value that is not finite counts as 0. The swing's is left aside without a swing drive.
  void set_duty(const DriveArray& duty_ratio, bool enable);
  /// Wanted swash of each pump, followed with a first-order lag; at the start the profile's.
  void set_swash(const PumpArray& swash_ratio) { wanted_swash_ = swash_ratio; }
  /// Share of its speed that the engine runs at before the pumps pull it down; 0: it stands.
  void set_engine_ratio(double ratio);
  /// Without pilot pressure every spool centres by its springs, with no dead time, whatever its
  /// pilot valve does.
  void set_pilot_cut(bool cut) { pilot_cut_ = cut; }
  /// A pilot valve that sends its spool to `held_ratio` whatever the duty, or `offset_ratio` beyond
  /// what the duty asks for. Of a drive that the machine has.
  void set_pilot_fault(std::size_t drive, std::optional<double> held_ratio, double offset_ratio) {
    pilot_[drive].set_fault(held_ratio, offset_ratio);
  }
  /// The drive's hoses are reversed.
  void set_reversed(std::size_t drive, bool reversed) { way_[drive] = reversed ? -1.0 : 1.0; }
  /// Force on the bucket tip beside soil and obstacle, N, x forward and y up, until changed.
  void set_tip_force(const Eigen::Vector2d& force_n) { outer_force_n_ = force_n; }

  /// Another ground from now on, as it is at its first step; none without a profile.
  void set_soil(const std::optional<SoilProfile>& soil);
  /// Another rock, not touched yet; none without a profile. The tip should be in front of it.
  void set_obstacle(const std::optional<ObstacleProfile>& obstacle);

  /// From now on each step adds to this account, which belongs to the caller; null ends it.
  void keep_account(EnergyAccount* account) { account_ = account; }
  /// Kinetic, potential and of compressed oil, J.
  [[nodiscard]] double stored_energy_j() const;

  /// Runs on. What is shorter than a step is kept for the next call.
  void advance(TimeUs duration_us);

  [[nodiscard]] AxisArray strokes_m() const;
  [[nodiscard]] AxisArray stroke_velocities_mps() const;
  /// At the valve's end of the hoses, where the transducers sit. Above ambient; slightly below 0
  /// while a make-up check is open, and no lower than boiling.
  [[nodiscard]] AxisArray cap_pressures_pa() const;
  [[nodiscard]] AxisArray rod_pressures_pa() const;
  /// Position x / x_m of each spool: of its whole travel, the deadband included.
  [[nodiscard]] AxisArray spool_travels_ratio() const;

  /// Left is positive; beyond whole turns it goes on. Without a swing drive where it started.
  [[nodiscard]] double swing_rad() const;
  // The others are 0 without a swing drive.
  [[nodiscard]] double swing_rate_radps() const;
  /// Of the platform with the links as they are, about the swing axis.
  [[nodiscard]] double swing_inertia_kgm2() const;
  /// Left and right port at the valve's end of the hoses, as those of the cylinders.
  [[nodiscard]] std::array<double, 2> swing_pressures_pa() const;
  [[nodiscard]] double swing_spool_ratio() const;
  [[nodiscard]] TeethTruth teeth() const;

  [[nodiscard]] PumpArray swash_ratios() const;
  /// One engine drives both pumps at the same speed.
  [[nodiscard]] double engine_radps() const {
    return engine_.speed_ratio() * profile_.machine.pump[0].rated_speed_radps;
  }
  [[nodiscard]] PumpArray pump_pressures_pa() const;
  /// Delivery after leakage, before the relief valve.
  [[nodiscard]] PumpArray pump_flows_m3ps() const;
  /// Flow that each section takes from its pump's line and gives back by regeneration, m^3/s.
  [[nodiscard]] const std::array<SectionFlows, kDriveCount>& section_flows() const {
    return flows_;
  }
  [[nodiscard]] const Cylinder& cylinder(std::size_t axis) const { return cylinder_[axis]; }
  [[nodiscard]] const PumpLine& pump(std::size_t index) const { return pump_[index]; }
  [[nodiscard]] const JointArray& joint_angles_rad() const { return links_.angles(); }
  /// In the ground's axes, from where the boom foot is on firm ground.
  [[nodiscard]] TipPose tip() const;
  /// Ground that gives way under the tracks; null where it is firm.
  [[nodiscard]] const RockingBase* rocking() const { return rocking_ ? &*rocking_ : nullptr; }
  /// Highest pressure that any chamber has had, between the readings too.
  [[nodiscard]] double peak_chamber_pressure_pa() const { return peak_chamber_pressure_pa_; }
  /// Whole force on the bucket tip over the last step, N.
  [[nodiscard]] const Eigen::Vector2d& tip_force_n() const { return tip_force_n_; }
  /// The same without the fill's weight.
  [[nodiscard]] Eigen::Vector2d ground_force_n() const { return tip_force_n_; }
  /// Ground and bucket; null where the ground is not one that is cut.
  [[nodiscard]] const BucketSoil* digging() const { return digging_ ? &*digging_ : nullptr; }
  /// Null without one.
  [[nodiscard]] const Obstacle* obstacle() const { return obstacle_ ? &*obstacle_ : nullptr; }
  [[nodiscard]] const ExcavatorPlantProfile& profile() const { return profile_; }

 private:
  struct Swing {
    SwingMotor motor;
    Platform platform;
  };

  void step();
  void meter();
  void move_links();
  void turn_platform();
  void add_pistons_to_account(const JointArray& velocity_mps);
  [[nodiscard]] SectionPorts ports_of(std::size_t drive) const;
  [[nodiscard]] double valve_pressure_pa(std::size_t drive, const WaveVolume& chamber,
                                         double hose_m3ps, double cushion_pas2pm6) const;
  void set_bypasses();
  void push_tip();
  void rock();
  void move_swash();
  [[nodiscard]] double felt_load_pa(std::size_t pump) const;
  void load_engine();
  void drive_pumps();
  [[nodiscard]] double pump_power_share() const;

  ExcavatorPlantProfile profile_;
  double step_s_;
  std::size_t pump_count_;  ///< Lines beyond it are neither filled nor stepped.
  TimeUs pending_us_ = 0;
  /// Of each drive: its pump, and its place among the sections on that pump.
  std::array<std::size_t, kDriveCount> pump_of_{};
  std::array<std::size_t, kDriveCount> place_of_{};

  std::array<PumpLine, kPumpCount> pump_;
  Engine engine_;
  std::array<double, kDriveCount> way_{1.0, 1.0, 1.0, 1.0};  ///< -1 of a drive that is reversed.
  std::vector<ValveSection> section_;                        ///< One a drive.
  std::array<Cylinder, kAxisCount> cylinder_;
  LinkageDynamics links_;
  std::optional<RockingBase> rocking_;
  double tip_moment_nm_ = 0.0;
  double settled_nm_ = 0.0;  ///< Moment of the links' weight that the ground has settled under.
  std::optional<Swing> swing_;
  double start_swing_;
  DriveArray duty_{};
  std::vector<PilotValve> pilot_;  ///< One a drive.
  bool pilot_cut_ = false;
  PumpArray wanted_swash_;
  double swash_share_;  ///< Of the way to the wanted swash, in a step.
  std::optional<Soil> soil_;
  std::optional<Obstacle> obstacle_;
  std::optional<BucketSoil> digging_;
  Eigen::Vector2d outer_force_n_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d tip_force_n_ = Eigen::Vector2d::Zero();
  std::array<SectionFlows, kDriveCount> flows_{};
  double peak_chamber_pressure_pa_ = 0.0;
  EnergyAccount* account_ = nullptr;
};

}  // namespace graben::plant
