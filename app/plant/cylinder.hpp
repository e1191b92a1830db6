// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The parallel cylinders of one axis: two chambers, piston leakage, cushions, end stops.

#include <algorithm>

#include "app/plant/chamber_pair.hpp"
#include "app/plant/hydraulics.hpp"

namespace graben::plant {

/// Of one cylinder axis, parallel cylinders together.
struct PistonFriction {
  double coulomb_n = 0.0;
  double viscous_nspm = 0.0;
};

/// Of parallel cylinders together, m^2.
struct PistonAreas {
  double cap_m2 = 0.0;
  double rod_m2 = 0.0;
};
[[nodiscard]] PistonAreas piston_areas(int count, double bore_m, double rod_m);

/// Over the last `length_m` of the stroke; at half of it a piston of `speed_mps` meets
/// `pressure_pa`. Without length none.
struct CushionData {
  double length_m = 0.0;
  double end_m = 0.0;  ///< What stays of the length to compute with at the very end.
  double speed_mps = 1.0;
  double pressure_pa = 0.0;
};

struct CylinderData {
  PistonAreas area;
  double stroke_m = 0.0;
  double dead_volume_m3 = 0.0;  ///< Each chamber, with hose.
  double bulk_modulus_pa = 0.0;
  PistonFriction friction;
  CushionData cushion = {};
  HydraulicDetails details = {};
};

/// What the piston gives to the mechanism over one step; extension is positive. The force is
/// `force_n - damping_nspm * mean velocity of the step`, and Coulomb friction up to `coulomb_n`
/// comes on top.
struct PistonLoad {
  double force_n = 0.0;
  double damping_nspm = 0.0;
  double coulomb_n = 0.0;
};

/// What the piston loses in a step, for the energy account; chamber a is the cap side.
struct PistonPower : ChamberPower {
  double end_stop_w = 0.0;
};

/// Chamber volume is the dead volume plus area times travel; travel is the sum of the steps' mean
/// velocities, so that oil neither appears nor vanishes (against the links' geometry it lags by
/// half a step). The end stops are springs, damped on the way in.
class Cylinder {
 public:
  Cylinder(const CylinderData& data, double step_s);

  /// Starts at rest with chamber pressures that carry the force (N, extension positive); the
  /// chamber that need not carry has the start back pressure.
  void start(double stroke_m, double force_n);

  /// Before the step: where the piston is and how fast it last moved.
  void set_motion(double stroke_m, double velocity_mps);
  [[nodiscard]] WavePort cap_port() const { return chambers_.a_port(); }
  [[nodiscard]] WavePort rod_port() const { return chambers_.b_port(); }
  /// Resistance of each cushion to what leaves its chamber, 1 / K^2; 0 where the piston is not in
  /// it. It grows as length over what is left of it, less 1: a piston that slows evenly meets even
  /// pressure.
  [[nodiscard]] double cap_cushion_pas2pm6() const {
    return cushion_pas2pm6(stroke_, cap_cushion_);
  }
  [[nodiscard]] double rod_cushion_pas2pm6() const {
    return cushion_pas2pm6(full_stroke_ - stroke_, rod_cushion_);
  }
  [[nodiscard]] PistonLoad load() const;
  /// With the step's mean velocity, before `step`.
  [[nodiscard]] PistonPower power(double velocity_mps) const;
  /// Ends the step with its chamber flows (into the chambers) and mean velocity.
  void step(double cap_in_m3ps, double rod_in_m3ps, double velocity_mps);

  [[nodiscard]] const WaveVolume& cap() const { return chambers_.a(); }
  [[nodiscard]] const WaveVolume& rod() const { return chambers_.b(); }

 private:
  [[nodiscard]] double cushion_pas2pm6(double left_m, double at_half_length) const {
    return left_m < cushion_length_
               ? at_half_length * (cushion_length_ / std::max(left_m, cushion_end_) - 1.0)
               : 0.0;
  }
  void add_end_stop(PistonLoad& load) const;

  ChamberPair chambers_;
  double cap_area_;
  double rod_area_;
  double step_;
  double full_stroke_;
  double dead_volume_;
  double back_pressure_;
  PistonFriction friction_;
  double cushion_length_;
  double cushion_end_;
  double cap_cushion_;  ///< 1 / K^2 at half the cushion's length.
  double rod_cushion_;
  double stop_stiffness_;
  double stop_damping_;
  double stroke_ = 0.0;
  double velocity_ = 0.0;
};

}  // namespace graben::plant
