#pragma once
/// What the frames that reached the controller allow, judged apart from the controller: nothing
/// here knows its states, and where it cannot be sure it allows.

#include <array>
#include <vector>

#include "hal/can_frame.hpp"
#include "tests/fuzz/bus_partner.hpp"

namespace graben::test {

template <class Kind>
class BusEvidence {
 public:
  BusEvidence(const typename Kind::Profile& profile, std::uint32_t profile_hash);

  /// All that the controller read in one cycle; `stale`: it may have thrown it away.
  void note(const std::vector<CanFrame>& received, bool stale, TimeUs now);

  /// Empty, or why nothing may move: something was not said, with a right CRC and every value
  /// valid, for longer than the timeout; or it was taken back beyond doubt.
  [[nodiscard]] const char* against_motion(TimeUs now) const;

  /// When the operator was last heard to have let go.
  [[nodiscard]] TimeUs released_us() const { return released_us_; }

 private:
  /// Consecutive frames of the operator, one a cycle, right in CRC, counter and values.
  struct Run {
    int frames = 0;
    int counter = 0;
    TimeUs last_us = 0;
    bool wants_motion = false;  ///< The last of them.
  };

  void note_operator(const CanFrame& frame, bool alone, TimeUs now);

  TimeUs timeout_us_;
  std::uint32_t profile_hash_;
  std::array<TimeUs, kInputMessages> said_us_{};  ///< Whole and valid; the operator: for motion.
  bool other_machine_ = false;                    ///< By its last frame.
  TimeUs released_us_;
  Run run_;
};

}  // namespace graben::test
