#pragma once
/// What can be tried on a simulated excavator beside its plain run.

#include <Eigen/Core>

#include "app/plant/obstacle.hpp"
#include "app/plant/soil.hpp"
#include "firmware/excavator/excavator_profile.hpp"
#include "firmware/excavator/kinematics/swing_kinematics.hpp"

namespace graben::machines {

/// How far a controller's parameters may be off, each way, as a share (Kim 5).
struct Uncertainty {
  double regeneration = 0.0;   ///< c_r, c_d, and the fixed orifices of the bypass (Tk1, Tk2).
  double spool_opening = 0.0;  ///< Each metering area.
  double bypass = 0.0;         ///< c_v,by, open and closed.
  double leak = 0.0;           ///< Both coefficients of each pump.
  double dead_time = 0.0;      ///< Each spool's, against what the controller takes it for.
};

/// A second way round, in the air, with something in the bucket.
struct AirManoeuvre {
  DigPath path;
  TipPose start;
  double loops = 0.0;  ///< Of the way round.
  double speed_mps = 0.0;
  double payload_kg = 0.0;
  Eigen::Vector2d payload_centre_m = Eigen::Vector2d::Zero();  ///< Bucket frame; a point mass.
};

/// A straight line of the teeth over the ground (Zhang et al., 4).
struct LineTask {
  TeethPose from;
  TeethPose to;
  double duration_s = 0.0;
};

struct Experiment {
  Uncertainty uncertainty;
  plant::SoilProfile soil;
  plant::ObstacleProfile obstacle;
  AirManoeuvre air;
  LineTask line;
  double stiff_bulk_modulus_pa = 0.0;  ///< Oil as stiff as the paper's modes need it.
};

}  // namespace graben::machines
