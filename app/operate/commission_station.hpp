// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Commissioning at the station, without a bus: from what is heard and from the operator's hand to
/// what is asked for, and when it ends.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/commission/commission_sequence.hpp"
#include "app/operate/commission_frames.hpp"
#include "app/operate/ecu_listener.hpp"
#include "app/operate/station.hpp"

namespace graben::operate {

/// Why a commissioning is over.
enum class CommissionEnd : std::uint8_t {
  kNone = 0,
  kDone,
  kFault,         ///< The controller has stopped.
  kWrongWay,      ///< A stroke has moved as it must not.
  kOtherProfile,  ///< The controller has another profile than the one that was begun with.
};

struct CommissionSetup {
  commission::SequenceOptions sequence;
  std::vector<commission::StepResult> done;  ///< By an earlier run.
  std::uint32_t profile_hash = 0;
  TimeUs silent_after_us = 20 * kSecondUs;  ///< As StationOptions; a still hand holds for minutes.
};

/// Enable is given while the deadman counts; then, once the controller is armed, task Commission.
/// Duties are tried only while the controller is active, every stroke is heard,
/// and no window that has not reached the controller keeps it from trying them: what was
/// interrupted begins again. Ends when all is done, when the controller stops by a fault after it
/// was armed, or when a stroke goes the wrong way; from then on nothing is asked for.
class CommissionStation {
 public:
  static constexpr TimeUs kPeriod_us = 10 * kMillisecondUs;

  explicit CommissionStation(const CommissionSetup& setup);

  /// Every kPeriod_us, after `ecu` has heard what has come.
  void step(const Hands& hands, Trouble around, const EcuListener& ecu, TimeUs now);

  [[nodiscard]] const Request& request() const { return request_; }
  [[nodiscard]] const TriedDuties& tried() const { return tried_; }
  [[nodiscard]] const Deadman& deadman() const { return deadman_; }
  [[nodiscard]] const commission::CommissionSequence& sequence() const { return sequence_; }
  [[nodiscard]] CommissionEnd end() const { return end_; }
  [[nodiscard]] bool is_moving() const { return moving_; }
  /// What was wrong and what to do about it; empty unless it has ended before all was done.
  [[nodiscard]] std::string end_words() const;

 private:
  [[nodiscard]] bool is_held(const EcuListener& ecu);
  void look_for_end(const EcuListener& ecu, TimeUs now);
  [[nodiscard]] bool hears_strokes(const EcuListener& ecu, TimeUs now);

  CommissionSetup setup_;
  commission::CommissionSequence sequence_;
  Deadman deadman_;
  Request request_;
  TriedDuties tried_;
  std::array<double, kAxisCount> stroke_m_{};
  double swing_rad_ = 0.0;
  bool moving_ = false;
  double held_s_ = 0.0;     ///< For so long in a row the controller has held the drive back.
  bool was_armed_ = false;  ///< Since the deadman was pressed last.
  CommissionEnd end_ = CommissionEnd::kNone;
  Fault fault_ = Fault::kNone;
};

/// What the operator should know at a time, in a line; it changes seldom.
[[nodiscard]] std::string commission_line(const CommissionStation& station, const EcuListener& ecu,
                                          TimeUs now);
/// What became of the step with this number: "boom, extending: ramp to its edge: done, duty 41.2 %,
/// 63 mm/s".
[[nodiscard]] std::string result_line(const commission::CommissionSequence& sequence,
                                      std::size_t at);

}  // namespace graben::operate
