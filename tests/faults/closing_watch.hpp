// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How far the machine moves after it was stopped, beyond what its spools' closing allows.
///
/// A spool takes some 50 ms to close, and then the load hangs on soft oil that rings at some 3 Hz
/// for a second or two: a plain distance says nothing. Two figures, each a share of the stroke and
/// the largest of all axes:
///
/// - *Beyond closing.* What closing allows is what the same machine does when it is sound and told
///   to be neutral at this instant: a copy of the plant, taken before the cycle in which the valve
///   side went neutral, its pilot valves repaired, its duties 0. Oil, soil and load go on in it as
///   in the original. The figure is the largest distance between the two from then on, so it sees
///   any flow that was let through later, and nothing else. Where a spool did not obey, the copy is
///   taken when the pilot cut has brought every real spool into its deadband.
/// - *Creep.* A check that needs no copy: from when every real spool is inside its deadband, the
///   mean stroke over a period of the oil's lowest mode, which takes the ringing out, against the
///   same mean at the end; the largest difference.
///
/// A machine that drives comes to rest meanwhile, see rolling_watch.hpp.

#include <array>
#include <optional>
#include <vector>

#include "tests/faults/rolling_watch.hpp"

namespace graben::faults {

template <class Kind>
class ClosingWatch {
 public:
  using Plant = typename Kind::Plant;

  /// `disobeying`: a spool is open against its command, so that the copy has to wait for it.
  explicit ClosingWatch(bool disobeying) : disobeying_(disobeying) {}

  /// Around each cycle of the machine. `closed`: the valve side has gone neutral.
  void before(const Plant& plant);
  void after(const Plant& plant, bool closed);

  [[nodiscard]] bool has_begun() const { return reference_.has_value(); }
  [[nodiscard]] double beyond_share() const { return beyond_share_; }
  /// 0 before two periods have been seen.
  [[nodiscard]] double creep_share() const;
  [[nodiscard]] const RollingWatch& rolling() const { return rolling_; }

 private:
  void begin(const Plant& from);

  bool disobeying_;
  std::optional<Plant> last_;       ///< Before the cycle.
  std::optional<Plant> reference_;  ///< The sound machine.
  double beyond_share_ = 0.0;
  bool closed_ = false;
  bool strayed_ = false;  ///< Some spool has been out of its deadband.
  RollingWatch rolling_;
  std::vector<typename Kind::AxisArray> strokes_;  ///< As shares, spools closed.
};

}  // namespace graben::faults
