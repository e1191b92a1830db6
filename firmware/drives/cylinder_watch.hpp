#pragma once
/// Whether one cylinder moves as its spool lets it.

namespace graben {

/// A cylinder's oil has rung down by then after its spool has closed.
inline constexpr double kCylinderSettle_s = 0.5;

/// What the watch may think of a cylinder and its spool.
struct CylinderLimits {
  double spool_edge = 0.0;     ///< Duty, 0 .. 1, up to which the spool is closed.
  double uncommanded_m = 0.0;  ///< It may go so far where its spool does not lead.
  double stuck_m = 0.0;        ///< Asked of it while its stroke stands still.
  /// Until its oil has rung down, or its mass come to rest, after its spool has closed.
  double settle_s = kCylinderSettle_s;
};

/// What the watch needs of the last cycle.
struct CylinderState {
  int direction = 0;       ///< Where the spool lets the oil go; 0 while it is closed.
  double since_s = 0.0;    ///< Since it has been so.
  double anchor_m = 0.0;   ///< Furthest that the cylinder was allowed to come.
  double still_m = 0.0;    ///< Stroke at its last change.
  double unmoved_m = 0.0;  ///< What it was asked to move since then, and of late.
};

/// What has come in of it, and what it was asked for in the last cycle.
struct CylinderSeen {
  double stroke_m = 0.0;
  double spool_ratio = 0.0;  ///< Measured, deadband and all, -1 .. 1.
  double asked_mps = 0.0;    ///< What the spool was opened for.
};

struct CylinderWatchResult {
  bool uncommanded = false;
  bool stuck = false;
  CylinderState state;
};

/// Uncommanded: with its spool closed a cylinder leaves the place where it came to rest, or it runs
/// back against its open spool, by more than `uncommanded_m`. What oil gives way under a load is
/// less; leakage, which creeps, is forgotten within seconds.
///
/// Stuck: with its spool open in the direction asked for, a stroke stands still to within its
/// resolution while `stuck_m` were asked of it. What was asked is forgotten within seconds too:
/// held against leakage for minutes, a cylinder is not stuck.
[[nodiscard]] CylinderWatchResult watch_cylinder(const CylinderLimits& limits,
                                                 const CylinderState& last,
                                                 const CylinderSeen& seen, double period_s);

}  // namespace graben
