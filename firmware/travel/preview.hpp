#pragma once
/// What the ground ahead will ask of the blade, and how fast the machine may therefore be now.

#include <array>

#include "firmware/kinematics/mobile_jacobian.hpp"
#include "firmware/travel/support.hpp"

namespace graben {

/// What a cycle gets to know of the way ahead.
struct AheadLimit {
  double speed_mps = 0.0;   ///< Largest from which braking in time is possible.
  double lowest_mps = 0.0;  ///< Least limit within kHold_m.
};

/// Stations on a grid along x. At each: how the machine will stand with its origin there, and the
/// stroke of the blade cylinders with the edge on the design. How stroke changes from station to
/// station is a flow per metre of travel, (10) of what is still to come. The body's share of it
/// counts more than once: it swings into each new stand, most of all when it tips.
///
/// A cycle works out a fixed number of stations: first those that are new, then all in turns, as
/// the blade goes on cutting what they stand on. One that is not known yet counts as v_min.
class Preview {
 public:
  static constexpr double kStep_m = 0.05;
  static constexpr int kMostStations = 80;
  static constexpr int kStationsPerCycle = 3;
  static constexpr double kHold_m = 1.5;

  /// Both have to outlive it.
  Preview(const DozerProfile& profile, const BladeKinematics& blade);

  /// The origin is at x with this measured stand.
  void look(const GroundMap& ground, const GradeProfile& design, double x_m, const Stand& measured);

  /// What is less than 0.1 m behind counts too. Largest speed at `x_m` with this flow to plan with,
  /// from which every limit up to `preview_m` is met at `deceleration_max_mps2`, the way of
  /// `lead_s` at `speed_mps` left off for what the transmission takes to answer.
  [[nodiscard]] AheadLimit limit(double x_m, double speed_mps, double flow_m3ps,
                                 double lead_s) const;

 private:
  struct Station {
    bool known = false;
    Stand stand;
    double stroke_m = 0.0;
    /// How the stroke would change to the next station on this stand: by the design alone.
    double by_design_m = 0.0;
  };

  [[nodiscard]] static int station_of(double x_m);
  [[nodiscard]] const Station& station(int index) const;
  [[nodiscard]] Station& station(int index);
  void work_out(const GroundMap& ground, const GradeProfile& design, int index, const Stand& guess);
  [[nodiscard]] double stroke_on(const GradeProfile& design, double x_m, const Stand& stand) const;
  [[nodiscard]] double speed_between(int index, double flow_m3ps) const;

  const DozerProfile& profile_;
  const BladeKinematics& blade_;
  int count_;  ///< Of stations ahead.
  std::array<Station, kMostStations> station_{};
  int first_ = 0;  ///< The one at or before the origin.
  int next_ = 0;   ///< Whose turn it is.
  bool started_ = false;
};

}  // namespace graben
