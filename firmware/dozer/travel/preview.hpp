#pragma once
/// Demand of the ground ahead on the blade, and the speed that it leaves now.

#include <array>
#include <cmath>
#include <limits>

#include "firmware/dozer/mobile_jacobian.hpp"
#include "firmware/dozer/travel/support.hpp"

namespace graben {

/// Limits of the way ahead, as a cycle takes them.
struct AheadLimit {
  double speed_mps = 0.0;   ///< Largest from which braking in time is possible.
  double lowest_mps = 0.0;  ///< Least limit within kHold_m.
};

/// Stations on a grid along x. At each: how the machine will stand with its origin there, and the
/// stroke of the blade cylinders with the edge on the design. How stroke changes from station to
/// station is a flow per metre of travel, (10) of what is still to come. The body's share of it
/// counts more than once: it swings into each new stand, most of all when it tips.
///
/// A cycle takes a fixed number of steps towards stands and finishes a fixed number of stations:
/// first those that are new, then all in turns, as the blade goes on cutting what they stand on.
/// Where the steps do not suffice the next cycle goes on with them. A station that is not known yet
/// counts as v_min; one whose turn it is keeps what it was until it is finished.
class Preview {
 public:
  static constexpr double kStep_m = 0.05;
  static constexpr int kMostStations = 80;
  static constexpr int kStationsPerCycle = 3;
  static constexpr int kStandStepsPerCycle = 8;
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
    double angle_rad = 0.0;  ///< Of the blade with the edge on the design.
    double stroke_m = 0.0;
    /// How the stroke would change to the next station on this stand: by the design alone.
    double by_design_m = 0.0;
    double flow_m3pm = kNotKnown;  ///< Of the way from the station before to the one after.
  };
  /// Whose flow nobody can feed.
  static constexpr double kNotKnown = std::numeric_limits<double>::infinity();

  /// The station that is being worked out.
  struct Work {
    bool begun = false;
    int index = 0;
    int steps = 0;
    Stand stand;
  };

  [[nodiscard]] static int station_of(double x_m) { return grid_index(x_m, kStep_m, 0.0); }
  /// Whole turns of the ring, more than kFurthest_m has.
  static constexpr int kTurns = 400'000 * kMostStations;
  static_assert(kTurns * kStep_m > kFurthest_m + kMostStations * kStep_m);
  [[nodiscard]] const Station& station(int index) const {
    return station_[static_cast<unsigned>(index + kTurns) % kMostStations];
  }
  [[nodiscard]] Station& station(int index) {
    return station_[static_cast<unsigned>(index + kTurns) % kMostStations];
  }
  [[nodiscard]] int total() const;

  void follow(int first);
  void forget(int index);
  void begin(const Stand& measured);
  void finish(const GradeProfile& design);
  [[nodiscard]] double angle_on(const GradeProfile& design, double x_m, const Stand& stand,
                                double guess_rad) const;
  [[nodiscard]] double flow_between(int index) const;
  [[nodiscard]] double limit_of(int index, double flow_m3ps) const;

  const DozerProfile& profile_;
  const BladeKinematics& blade_;
  int count_;  ///< Of stations ahead.
  std::array<Station, kMostStations> station_{};
  int first_ = 0;         ///< The one at or before the origin.
  int known_before_ = 0;  ///< From the first one to there all are known.
  int next_ = 0;          ///< Whose turn it is.
  Work work_;
  bool started_ = false;
};

struct PositionState {
  double position_m = 0.0;
  bool started = false;
};

/// Position from the measured velocity, drawn to the measured position within some tenths of a
/// second; at once where they are further apart than noise and slip make them.
[[nodiscard]] inline PositionState next_position(const PositionState& last, double measured_m,
                                                 double velocity_mps, double period_s) {
  constexpr double kDrawn_s = 0.2;
  constexpr double kApart_m = 0.1;
  const double predicted_m = last.position_m + velocity_mps * period_s;
  const double off_m = measured_m - predicted_m;
  if (!last.started || !(std::abs(off_m) <= kApart_m)) {
    return {measured_m, true};
  }
  return {predicted_m + off_m * period_s / (kDrawn_s + period_s), true};
}

}  // namespace graben
