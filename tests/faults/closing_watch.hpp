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

#include <array>
#include <optional>
#include <vector>

#include "app/plant/excavator_plant.hpp"

namespace graben::faults {

class ClosingWatch {
 public:
  /// `disobeying`: a spool is open against its command, so that the copy has to wait for it.
  explicit ClosingWatch(bool disobeying) : disobeying_(disobeying) {}

  /// Around each cycle of the machine. `closed`: the valve side has gone neutral.
  void before(const plant::ExcavatorPlant& plant);
  void after(const plant::ExcavatorPlant& plant, bool closed);

  [[nodiscard]] bool has_begun() const { return reference_.has_value(); }
  [[nodiscard]] double beyond_share() const { return beyond_share_; }
  /// 0 before two periods have been seen.
  [[nodiscard]] double creep_share() const;

 private:
  void begin(const plant::ExcavatorPlant& from);

  bool disobeying_;
  std::optional<plant::ExcavatorPlant> last_;       ///< Before the cycle.
  std::optional<plant::ExcavatorPlant> reference_;  ///< The sound machine.
  double beyond_share_ = 0.0;
  std::vector<plant::ExcavatorPlant::AxisArray> strokes_;  ///< As shares, spools closed.
};

}  // namespace graben::faults
