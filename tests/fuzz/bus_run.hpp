// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The controller's whole cycle on a scripted bus, watched from outside: what the bus has given it,
/// what it then may send.

#include <array>
#include <map>
#include <string>
#include <vector>

#include "firmware/core/codes.hpp"
#include "hal/can_frame.hpp"
#include "tests/fuzz/bus_partner.hpp"
#include "tests/fuzz/bus_port.hpp"
#include "tests/fuzz/led_spool.hpp"

namespace graben::test {

/// What the frames that reached the controller allow, judged apart from the controller: nothing
/// here knows its states, and where it cannot be sure it allows.
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

/// One cycle as seen from outside.
template <class Kind>
struct BusCycle {
  TimeUs now = 0;
  TimeUs elapsed_us = 0;  ///< Since the cycle before; 0 in the first.
  bool bus_active = false;
  const char* against_motion = "";  ///< Why nothing may move; empty if nothing is known.
  TimeUs released_us = 0;           ///< When the operator was last heard to have let go.
  const std::vector<SentFrame>* sent = nullptr;
  const typename Kind::Outputs* outputs = nullptr;  ///< For what is not on the bus in every cycle.
};

/// What must hold of all that the controller sends, cycle by cycle, whatever it has received.
template <class Kind>
class BusRules {
 public:
  explicit BusRules(const typename Kind::Profile& profile) : profile_(profile), others_(profile) {}

  /// Empty, or what was wrong.
  [[nodiscard]] std::string check(const BusCycle<Kind>& cycle);

 private:
  [[nodiscard]] std::string check_frame(const CanFrame& frame);
  [[nodiscard]] std::string check_command(const BusCycle<Kind>& cycle, const CanFrame& frame);
  [[nodiscard]] std::string check_opening(const typename Kind::Dbc::SpoolCommand& command,
                                          TimeUs now);
  [[nodiscard]] std::string check_status(const BusCycle<Kind>& cycle, const CanFrame& frame);
  [[nodiscard]] std::string check_arming(const BusCycle<Kind>& cycle);
  [[nodiscard]] std::string may_not_move(const BusCycle<Kind>& cycle) const;

  const typename Kind::Profile& profile_;
  typename Kind::OtherCommands others_;
  std::map<std::uint32_t, int> counter_;  ///< Last, of each protected message.
  std::array<double, Kind::kSpools> opening_{};
  std::array<double, Kind::kSpools> duty_{};
  std::array<LedSpool, Kind::kSpools> led_{};
  TimeUs command_us_ = 0;
  bool any_command_ = false;
  int refused_ = 0;  ///< Commands in a row that the bus did not take.
  int late_ = 0;     ///< Cycles in a row.
  EcuMode mode_ = EcuMode::kSilent;
  TimeUs motion_us_ = 0;  ///< When it was last Armed or Active.
};

template <class Kind>
class BusRun {
 public:
  static constexpr TimeUs kPeriod_us = 10 * kMillisecondUs;
  static constexpr TimeUs kStart_us = kSecondUs;

  explicit BusRun(const typename Kind::Machine& machine);

  /// One cycle `elapsed_us` after the last one; empty, or what was wrong with it.
  [[nodiscard]] std::string cycle(TimeUs elapsed_us);

  /// Everything is well again and the operator starts again: Active within 4 s, and it stays so.
  [[nodiscard]] std::string recover();

  [[nodiscard]] bool is_active() const { return ecu_.outputs().status.mode == EcuMode::kActive; }

  ScriptedPort port;
  BusPartner<Kind> partner;

 private:
  TimeUs now_ = kStart_us;
  typename Kind::Ecu ecu_;
  BusEvidence<Kind> evidence_;
  BusRules<Kind> rules_;
  bool has_run_ = false;
};

}  // namespace graben::test
