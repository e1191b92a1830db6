// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Commissioning at the station, without a bus: from what is heard and from the operator's hand to
/// what is asked for, and when it ends.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/operate/commission_lead.hpp"
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

template <class Lead>
struct CommissionSetupOf {
  typename Lead::Options sequence;
  std::vector<commission::StepResult> done;  ///< By an earlier run.
  std::uint32_t profile_hash = 0;
  TimeUs silent_after_us = 20 * kSecondUs;  ///< As StationOptions; a still hand holds for minutes.
};

/// Enable is given while the deadman counts; then, once the controller is armed, task Commission.
/// Duties are tried only while the controller is active, every stroke is heard,
/// and no window that has not reached the controller keeps it from trying them: what was
/// interrupted begins again. Ends when all is done, when the controller stops by a fault after it
/// was armed, or when a stroke goes the wrong way; from then on nothing is asked for.
template <class Lead>
class CommissionStationOf {
 public:
  static constexpr TimeUs kPeriod_us = 10 * kMillisecondUs;

  explicit CommissionStationOf(const CommissionSetupOf<Lead>& setup);

  /// Every frame of the bus.
  void hear(const CanFrame& frame, TimeUs now) { lead_.hear(frame, now); }
  /// Every kPeriod_us, after `ecu` has heard what has come.
  void step(const Hands& hands, Trouble around, const EcuListener& ecu, TimeUs now);

  [[nodiscard]] const Request& request() const { return request_; }
  [[nodiscard]] const typename Lead::Tried& tried() const { return tried_; }
  [[nodiscard]] const Deadman& deadman() const { return deadman_; }
  [[nodiscard]] const typename Lead::Sequence& sequence() const { return lead_.sequence(); }
  [[nodiscard]] const Lead& lead() const { return lead_; }
  [[nodiscard]] CommissionEnd end() const { return end_; }
  [[nodiscard]] bool is_moving() const { return moving_; }
  /// What was wrong and what to do about it; empty unless it has ended before all was done.
  [[nodiscard]] std::string end_words() const;

 private:
  [[nodiscard]] bool is_held(const EcuListener& ecu);
  void look_for_end(const EcuListener& ecu, TimeUs now);

  CommissionSetupOf<Lead> setup_;
  Lead lead_;
  Deadman deadman_;
  Request request_;
  typename Lead::Tried tried_;
  bool moving_ = false;
  double held_s_ = 0.0;     ///< For so long in a row the controller has held the drive back.
  bool was_armed_ = false;  ///< Since the deadman was pressed last.
  CommissionEnd end_ = CommissionEnd::kNone;
  Fault fault_ = Fault::kNone;
};

extern template class CommissionStationOf<ExcavatorLead>;
extern template class CommissionStationOf<DozerLead>;

using CommissionSetup = CommissionSetupOf<ExcavatorLead>;
using CommissionStation = CommissionStationOf<ExcavatorLead>;
using DozerStation = CommissionStationOf<DozerLead>;

/// What the operator should know at a time, in a line; it changes seldom.
template <class Lead>
[[nodiscard]] std::string commission_line(const CommissionStationOf<Lead>& station,
                                          const EcuListener& ecu, TimeUs now);
/// What became of the step with this number: "boom, extending: ramp to its edge: done, duty 41.2 %,
/// 63 mm/s".
template <class Lead>
[[nodiscard]] std::string result_line(const Lead& lead, std::size_t at);

}  // namespace graben::operate
