// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Demand of the ground ahead on the blade, and the speed that it leaves now.

#include <array>
#include <cmath>

#include "firmware/dozer/blade_control.hpp"
#include "firmware/dozer/tilt.hpp"
#include "firmware/dozer/travel/body_motion.hpp"
#include "firmware/dozer/travel/tuning.hpp"

namespace graben {

/// Limits of the way ahead, as a cycle takes them.
struct AheadLimit {
  double speed_mps = 0.0;   ///< Largest from which braking in time is possible.
  double lowest_mps = 0.0;  ///< Least limit within the way of kPreviewHold_s.
};

/// Probes drive ahead over ground and design, each at its own constant speed, with the machine's
/// springs, dampers, mass and inertia: they tip, swing and fall as it will. On a grid along x each
/// leaves the stroke that would keep the edge on the design there at that speed.
///
/// From it follows where the blade's flow does not suffice at that speed. There the blade has to
/// rise before the body tips, and comes down late where the body rises: both leave ground standing,
/// which can be mended, and cut nothing too deep. The highest that it leaves over such a stretch
/// is what the stretch costs at that speed; the speed at which it costs what is allowed is the
/// stretch's limit.
///
/// Where the blade tilts, its flow for that is worked out at each station and taken off what the
/// lift is planned with; no speed is allowed at which the tilt alone would take more than
/// kPreviewTiltShare of it.
///
/// Where the track curves, no speed is allowed with which the outer track would have to run faster
/// than it can.
///
/// A cycle takes a fixed number of steps, of the probe that is least far, and works out the cost of
/// one probe. What no probe has come to yet counts as v_min.
class Preview {
 public:
  /// Stations that are remembered. [-; size: 4 m at kPreviewStep_m, for the longest preview of a
  /// profile, 3.5 m, and kBehind]
  static constexpr int kMostStations = 80;
  /// Probes that drive ahead. [-; derived: one for each kProbeShare]
  static constexpr int kProbes = static_cast<int>(kProbeShare.size());
  /// Steps of probes in a cycle. [-; size: loop of look(), all probes together]
  static constexpr int kStepsPerCycle = 8;

  /// Both have to outlive it.
  Preview(const DozerProfile& profile, const BladeKinematics& blade);

  /// The origin is at x with this measured stand. The cost is of a flow to plan with; no track gets
  /// faster than `track_max_mps`.
  void look(const GroundMap& ground, const GradeProfile& design, double x_m, const Stand& measured,
            double flow_m3ps, double track_max_mps = kAnySpeed_mps);

  /// Largest speed at `x_m` from which every limit up to `preview_m` is met at
  /// `deceleration_max_mps2` and costs no more than `allowed_m`, the way of `lead_s` at `speed_mps`
  /// left off for what the transmission takes to answer.
  [[nodiscard]] AheadLimit limit(double x_m, double speed_mps, double allowed_m,
                                 double lead_s) const;
  /// Least that the station before `x_m` costs, at whatever speed; 0 where no probe has been.
  [[nodiscard]] double least_cost_m(double x_m) const;
  /// What the blade is to leave standing with the origin at `x_m`, driving so fast.
  [[nodiscard]] BladeLift lift(double x_m, double speed_mps, double allowed_m) const;

 private:
  /// On its way over the ground.
  struct Probe {
    BodyMotion motion;
    double x_m = 0.0;
    double angle_rad = 0.0;  ///< Of the blade, with the edge on the design.
    int begin = 0;           ///< First station that it has come to.
    int end = 0;             ///< The one after the last.
    bool started = false;
  };
  /// At one station, of one probe.
  struct Need {
    double stroke_m = 0.0;  ///< With the edge on the design.
    double lift_m = 0.0;    ///< Of the edge over it, as far as the flow makes it.
    double cost_m = 0.0;    ///< The highest lift of the stretch.
  };
  using Needs = std::array<Need, kMostStations>;

  [[nodiscard]] static int station_of(double x_m) { return grid_index(x_m, kPreviewStep_m, 0.0); }
  /// Offset that makes an index of a station positive. [-; size: whole turns of the ring, further
  /// than kFurthest_m, as the assertion below says]
  static constexpr int kTurns = 400'000 * kMostStations;
  static_assert(kTurns * kPreviewStep_m > kFurthest_m + kMostStations * kPreviewStep_m);
  [[nodiscard]] static unsigned slot(int index) {
    return static_cast<unsigned>(index + kTurns) % kMostStations;
  }
  [[nodiscard]] Need& need(int probe, int index) {
    return need_[static_cast<unsigned>(probe)][slot(index)];
  }
  [[nodiscard]] const Need& need(int probe, int index) const {
    return need_[static_cast<unsigned>(probe)][slot(index)];
  }
  [[nodiscard]] int last() const { return first_ + kBehind + count_; }
  [[nodiscard]] double probe_mps(int probe) const;

  void follow(double x_m, const Stand& measured);
  void start(Probe& probe, double x_m, const Stand& measured);
  void step(const GroundMap& ground, const GradeProfile& design, int number);
  /// `reach_of(index)` is how far the lift's flow takes its cylinders within a station.
  template <class ReachOf>
  void cost(int number, const ReachOf& reach_of);
  void cost(int number, double flow_m3ps);
  /// What the tilt leaves of it at this speed.
  [[nodiscard]] double lift_flow_m3ps(int index, double speed_mps, double flow_m3ps) const;
  /// At which the tilt takes all that it may.
  [[nodiscard]] double tilt_speed_mps(int index) const;
  /// At which the outer track is at its fastest.
  [[nodiscard]] double curve_speed_mps(int index) const;
  [[nodiscard]] double angle_on(const GradeProfile& design, double x_m, const Stand& stand,
                                double guess_rad) const;
  [[nodiscard]] double stroke_on(const GradeProfile& design, double x_m, const Stand& stand,
                                 double angle_rad) const;
  [[nodiscard]] double lift_limit_of(int index, double allowed_m) const;
  [[nodiscard]] double limit_of(int index, double allowed_m) const;
  [[nodiscard]] double lift_of(int index, double speed_mps, double allowed_m) const;

  /// Stations passed that still count. [-; size: room behind the machine]
  static constexpr int kBehind = 2;

  const DozerProfile& profile_;
  const BladeKinematics& blade_;
  TiltKinematics tilt_;
  double edge_per_stroke_;              ///< At home, both without their sign.
  int count_;                           ///< Of stations ahead.
  std::array<Probe, kProbes> probe_{};  ///< The fastest first.
  std::array<Needs, kProbes> need_{};
  int first_ = 0;                                ///< The first station that counts.
  int turn_ = 0;                                 ///< Whose cost is worked out.
  std::array<double, kMostStations> tilt_m2_{};  ///< See tilt_oil_m2(), at each station.
  /// Of the outer track's speed over the body's, what it is more than 1, at each station.
  std::array<float, kMostStations> outer_{};
  bool curves_ = false;
  double track_max_mps_ = kAnySpeed_mps;
  double flow_m3ps_ = 0.0;  ///< That was last planned with.
};

/// Where the ground would come out more than the tolerance off the design at whatever speed.
struct GradeKept {
  bool kept = true;
  double position_m = 0.0;  ///< Of the body.
  double off_m = 0.0;       ///< What it costs there, m.
};

/// Walks the probes over the design as already cut, with the flow of the profile's engine speed. No
/// part of a cycle: it takes the time that the way does.
[[nodiscard]] GradeKept grade_kept(const DozerProfile& profile, double from_m, double to_m);

struct PositionState {
  double position_m = 0.0;
  bool started = false;
};

/// Position from the measured velocity, drawn to the measured position within some tenths of a
/// second; at once where they are further apart than noise and slip make them.
[[nodiscard]] inline PositionState next_position(const PositionState& last, double measured_m,
                                                 double velocity_mps, double period_s) {
  const double predicted_m = last.position_m + velocity_mps * period_s;
  const double off_m = measured_m - predicted_m;
  if (!last.started || !(std::abs(off_m) <= kPositionApart_m)) {
    return {measured_m, true};
  }
  return {predicted_m + off_m * period_s / (kPositionDrawn_s + period_s), true};
}

}  // namespace graben
