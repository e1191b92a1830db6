// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How calmly a machine runs: measures of signals that have one value a control cycle. What a run
/// does not judge is left out with pause(); no measure spans such a gap.

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace graben::runs {

/// From one value of a signal to the next.
inline constexpr double kSampled_s = 0.01;

/// Total variation: the sum of what a signal changes by from cycle to cycle, up and down alike.
class Variation {
 public:
  void add(double value) {
    if (follows_) {
      sum_ += std::abs(value - last_);
      ++steps_;
    }
    last_ = value;
    follows_ = true;
  }
  void pause() { follows_ = false; }
  [[nodiscard]] double time_s() const { return kSampled_s * static_cast<double>(steps_); }
  /// 0 of nothing.
  [[nodiscard]] double per_s() const { return steps_ > 0 ? sum_ / time_s() : 0.0; }

 private:
  bool follows_ = false;  ///< On a value without a pause between.
  double last_ = 0.0;
  double sum_ = 0.0;
  long steps_ = 0;
};

/// From the middle to where a spool begins to open, of its travel, on each side.
struct SpoolEdges {
  double extend_ratio = 0.0;
  double retract_ratio = 0.0;
};

/// What a spool does: how far it travels, and how often it goes from open on one side to open on
/// the other. Within the dead band it is open on none, so to stand there or to come back out on the
/// same side is no reversal. One that is over within a cycle is not seen.
class SpoolCalm {
 public:
  explicit SpoolCalm(const SpoolEdges& edges) : edges_(edges) {}

  void add(double travel_ratio) {
    travel_.add(travel_ratio);
    const int side = (travel_ratio > edges_.extend_ratio ? 1 : 0) -
                     (travel_ratio < -edges_.retract_ratio ? 1 : 0);
    reversals_ += side * open_side_ < 0 ? 1 : 0;
    open_side_ = side != 0 ? side : open_side_;
  }
  void pause() {
    travel_.pause();
    open_side_ = 0;
  }
  /// In full travels from the middle to one side.
  [[nodiscard]] double travel_ps() const { return travel_.per_s(); }
  [[nodiscard]] double reversals_ps() const {
    return travel_.time_s() > 0.0 ? static_cast<double>(reversals_) / travel_.time_s() : 0.0;
  }

 private:
  SpoolEdges edges_;
  Variation travel_;
  int open_side_ = 0;  ///< Where it was open last: -1, 1, or 0 for not yet.
  long reversals_ = 0;
};

/// A signal's part below `cutoff_hz` without a shift in time: a Butterworth low-pass of second
/// order forwards, then backwards, so that a sine of the cutoff is halved. Beyond each of its ends
/// the signal goes on mirrored, along the slope that it has over the nearest period of the cutoff:
/// so neither a level nor a slope there makes the filter ring, and what is fast stays fast.
[[nodiscard]] std::vector<double> slow_part(const std::vector<double>& signal, double cutoff_hz);

/// Root mean square of what is left of a signal without its slow part.
[[nodiscard]] double ringing_rms(const std::vector<double>& signal, double cutoff_hz);

/// The third derivative of a point's place: the third difference over four cycles, which is exact
/// for a cubic, without what is faster than kJerkBelow_hz. Third differences weigh a frequency by
/// its third power, and a shock that is shorter than a cycle, as the bucket's on the ground, by
/// where the cycles happen to meet it: in a run in soil two thirds of their
/// power lie above 30 Hz. The
/// linkage on its oil moves below 10.
class Jerk {
 public:
  void add(const Eigen::Vector3d& at_m);
  void pause();
  /// Of all that was added; 0 of less than four cycles. Pauses.
  [[nodiscard]] double rms_mps3();

 private:
  std::array<Eigen::Vector3d, 3> last_m_;  ///< The newest first.
  std::size_t known_ = 0;
  std::array<std::vector<double>, 3> jerk_mps3_;  ///< Since the last pause, each coordinate's.
  double squares_m2ps6_ = 0.0;
  std::size_t count_ = 0;
};
inline constexpr double kJerkBelow_hz = 10.0;

}  // namespace graben::runs
