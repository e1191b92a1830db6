// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Profile of a dozer, as its controller knows it: body, blade, flows, transmission, grade.
/// Constant after start; read and range-checked by the application. SI units; frames as in
/// signals/dozer_signals.hpp.

#include <Eigen/Core>
#include <array>

#include "firmware/dozer/dozer_signals.hpp"
#include "firmware/machine/mark.hpp"
#include "firmware/machine/spool_answer.hpp"
#include "firmware/machine/unknown_drives.hpp"
#include "firmware/machine/valve.hpp"
#include "firmware/signals/bus_capabilities.hpp"

namespace graben {

/// The half-vehicle of (15), (16): wheels on push-only springs, evenly spaced over the contact.
struct DozerBody {
  double mass_kg = 0.0;
  double mass_centre_height_m = 0.0;  ///< Above the body frame's origin.
  double pitch_inertia_kgm2 = 0.0;    ///< J_c of (15), blade included.
  int wheels = 0;                     ///< 2 .. kMostWheels.
  double track_contact_m = 0.0;       ///< First to last wheel, centred below the mass centre.
  double half_gauge_m = 0.0;          ///< d of (8).
  double suspension_npm = 0.0;        ///< Of each wheel of the half-vehicle.
  double suspension_nspm = 0.0;       ///< Damping; acts on the way in and out while pushed.
};
/// Wheels of a half-vehicle, at most. [-; size: bound of every loop over the wheels]
inline constexpr int kMostWheels = 16;

/// Joint 1. Home is where the cutting edge is at the tracks' ground line; the rod eye lies on the
/// line from the pivot to the blade's foot, at L12, which follows from the home length.
struct BladeGeometry {
  Eigen::Vector2d pivot_m = Eigen::Vector2d::Zero();  ///< Body frame.
  Eigen::Vector2d arm_m = Eigen::Vector2d::Zero();    ///< Pivot to the blade's foot, at home.
  double cutting_edge_m = 0.0;                        ///< Pivot to cutting edge.
  Eigen::Vector2d base_m = Eigen::Vector2d::Zero();   ///< Cylinder base, body frame.
  double length_home_m = 0.0;                         ///< Of the cylinder.
  double edge_min_m = 0.0;  ///< Reach of the cutting edge against the ground line, body level.
  double edge_max_m = 0.0;
  int cylinder_count = 0;
  double bore_m = 0.0;
  double rod_m = 0.0;

  /// A_A and A_B of (7), m^2.
  [[nodiscard]] double cap_area_m2() const { return graben::cap_area_m2(cylinder_count, bore_m); }
  [[nodiscard]] double rod_area_m2() const {
    return graben::rod_area_m2(cylinder_count, bore_m, rod_m);
  }
};

/// The blade's second drive: one cylinder side turns it about its own longitudinal axis, taken
/// through the middle of the cutting edge. Left end up is positive. Pins as seen from behind with
/// the blade level: y to the left, z up, from that axis.
struct TiltProfile {
  bool present = false;                              ///< Without, all below is 0.
  double edge_width_m = 0.0;                         ///< Of the cutting edge, end to end.
  double angle_most_rad = 0.0;                       ///< Either way against the body.
  Eigen::Vector2d base_m = Eigen::Vector2d::Zero();  ///< Cylinder's pin on the push frame.
  Eigen::Vector2d eye_m = Eigen::Vector2d::Zero();   ///< On the blade, level.
  int cylinder_count = 0;
  double bore_m = 0.0;
  double rod_m = 0.0;
  double valve_flow_max_m3ps = 0.0;  ///< Of its spool fully open.
  DutyTable spool_to_duty;           ///< As ImplementProfile's.
  double gain_ps = 0.0;              ///< Error of the cross slope to its rate.
  double integral_ps2 = 0.0;
  double integral_most_radps = 0.0;

  [[nodiscard]] double half_width_m() const { return 0.5 * edge_width_m; }
  [[nodiscard]] double cap_area_m2() const { return graben::cap_area_m2(cylinder_count, bore_m); }
  [[nodiscard]] double rod_area_m2() const {
    return graben::rod_area_m2(cylinder_count, bore_m, rod_m);
  }
};

struct ImplementProfile {
  double displacement_m3prev = 0.0;  ///< V_p,imp of (12).
  double efficiency = 0.0;           ///< eta_p,imp,vol of (12).
  double valve_flow_max_m3ps =
      0.0;  ///< Q_max,valve of (11); what the spool lets through fully open.
  /// Opening (0 .. 1 of valve_flow_max) to duty (0 .. 1), as ValveProfile::spool_to_duty.
  DutyTable spool_to_duty;
};

/// Dual-path transmission (9); both paths alike.
struct HstProfile {
  double engine_radps = 0.0;  ///< At work.
  double engine_least_radps = 0.0;
  double engine_most_radps = 0.0;
  double pump_m3prev = 0.0;   ///< V_p
  double motor_m3prev = 0.0;  ///< V_m
  double motor_ratio_min = 0.0;
  double gear_ratio = 0.0;        ///< u_G
  double pump_efficiency = 0.0;   ///< eta_vol,p
  double motor_efficiency = 0.0;  ///< eta_vol,m
  double sprocket_radius_m = 0.0;
  double pump_rate_ps = 0.0;   ///< Largest change of the pump's ratio per second.
  double motor_rate_ps = 0.0;  ///< The same of the motor.
  double response_s = 0.0;     ///< Lag of a displacement behind its command.
};

/// Choice (14) and control of the travel speed.
struct TravelProfile {
  SpeedPolicy policy = SpeedPolicy::kBounded;
  double speed_desired_mps = 0.0;      ///< v_d
  double speed_min_mps = 0.0;          ///< v_min
  double acceleration_max_mps2 = 0.0;  ///< Algorithm 1.
  double threshold_rad = 0.0;          ///< theta_threshold of Algorithm 1.
  double deceleration_max_mps2 = 0.0;  ///< What the speed ahead is planned with.
  double flow_share = 0.0;             ///< Of the available flow, that is planned with.
  double push_max_n = 0.0;             ///< Of both tracks, against the load on the blade.
  double preview_m = 0.0;              ///< How far ahead the ground is looked at.
  double track_gain = 0.0;             ///< PI of a track's speed: m/s to m/s.
  double track_integral_ps = 0.0;
};

/// One corner of the design profile.
struct GradePoint {
  double x_m = 0.0;
  double z_m = 0.0;
};

/// Heights of a design along the track on an even grid, for what has more corners than a list of
/// points: a surface of triangles, cut by the track. They stay the application's, which keeps them
/// as long as anything has this design; nothing of them is copied.
struct GradeHeights {
  /// Distance between two heights. [m; standard: layout of the heights, which application, plant
  /// and controller share; six to the rounding of a corner of 0.3 m; other steps not tried]
  static constexpr double kStep_m = 0.05;
  /// Heights of a design, at most. [-; size: a track of 1000 m at kStep_m, both ends counted]
  static constexpr int kMost = 20'001;

  // Aligned so that it lies alike where pointers are of 4 bytes: a setup is written as bytes.
  alignas(8) const double* height_m = nullptr;  ///< Over the design's plane, `count` of them.
  /// Slope across the track there, dz/dy with y to the left; none: level across.
  alignas(8) const double* cross = nullptr;
  alignas(8) int count = 0;  ///< 0, or 2 .. kMost.
  double from_m = 0.0;       ///< Place of the first one.
  /// Curvature of the track in plan there, 1/m, to the left positive; none: it is straight.
  alignas(8) const double* curvature = nullptr;
};

/// The design: heights over a plane through points with rounded corners. Before the first point and
/// after the last one it goes on level with them. Where it has `heights`, they stand in the place
/// of points and rounding.
struct GradeDesign {
  /// Corners of a design that is a list of points, at most. [-; size: room of `point`]
  static constexpr int kMostPoints = 32;

  std::array<GradePoint, kMostPoints> point{};
  int count = 0;  ///< 2 .. kMostPoints, x rising; 0 with heights.
  GradeHeights heights;
  double rounding_m = 0.0;      ///< From each corner to where its curve begins, either side.
  double plane_height_m = 0.0;  ///< Of the plane at x = 0.
  double plane_slope = 0.0;     ///< dz/dx of the plane.
  double ground_m = 0.0;        ///< Of the ground that is there, over the plane.
  double pass_depth_m = 10.0;   ///< So deep goes the first pass.
  int passes_most = 1;          ///< So often the machine may go over it.
  double tolerance_m = 0.02;    ///< How far off the design the ground may come out.

  /// Then x is the station along the track, and the machine steers.
  [[nodiscard]] bool curves() const { return heights.count > 1 && heights.curvature != nullptr; }

  /// Where it begins and ends; 0 and 0 without either.
  [[nodiscard]] double begin_m() const {
    return heights.count > 0 ? heights.from_m : (count > 0 ? point[0].x_m : 0.0);
  }
  [[nodiscard]] double end_m() const {
    if (heights.count > 0) {
      return heights.from_m + (heights.count - 1) * GradeHeights::kStep_m;
    }
    return count > 0 ? point[static_cast<unsigned>(count - 1)].x_m : 0.0;
  }
};

struct DozerControl {
  double sensor_timeout_s = 0.0;
  double spool_rate_ps = 0.0;          ///< Largest opening per second.
  double duty_rate_ps = kDutyRate_ps;  ///< Largest rise of a duty on the wire per second.
  double spool_threshold = 0.0;        ///< Opening under which the spool is kept at neutral.
  double dead_time_s = 0.0;            ///< From a duty to the spool's first movement.
  double response_s = 0.0;             ///< Lag of the blade cylinders' speed behind their command.
  double pose_latency_s = 0.0;         ///< Age of a measured pose when it comes in.
  double blade_gain_ps = 0.0;          ///< Height error to velocity.
  double blade_integral_ps2 = 0.0;
  double blade_integral_most_mps = 0.0;
  bool learns = true;  ///< The pump's share and the tracks' slip; else both are as told.
};

/// Bounds that the watches hold the machine to.
struct DozerSafety {
  double degraded_speed_ratio = 0.0;
  double idle_radps = 0.0;
  double settle_s = 0.0;
  double spool_tolerance = 0.0;
  double uncommanded_m = 0.0;
  double sink_mps = 0.0;  ///< No faster does the blade sink whose spool is in its middle.
  double stuck_m = 0.0;
  double tube_m = 0.0;   ///< See leaves_tube(); of the cutting edge about the design.
  double stall_s = 0.0;  ///< So long it may hardly get on, see stall_watch.hpp.
  double displacement_tolerance = 0.0;  ///< Of full displacement.
  double displacement_settle_s = 0.0;   ///< Within which a displacement reaches its command.
  double track_speed_tolerance_mps = 0.0;
  UnknownDrives unknown;  ///< See tell_unknown().
};

struct DozerProfile {
  BusCapabilities bus;
  DozerBody body;
  BladeGeometry blade;
  TiltProfile tilt;
  ImplementProfile implement;
  /// What is known of each side of lift and tilt; the rest is `implement`'s, `tilt`'s and
  /// `control`'s.
  std::array<SaidAnswers, 2> answer;
  HstProfile hst;
  TravelProfile travel;
  GradeDesign grade;
  DozerControl control;
  DozerSafety safety;
  MarkProfile mark;
};

}  // namespace graben
