// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a dozer is asked to do so that a log of it says how it answers: blade, tilt, then tracks,
/// one drive and direction at a time. Pure, as CommissionSequence.

#include <array>
#include <optional>
#include <vector>

#include "app/commission/commission_sequence.hpp"
#include "app/commission/travel_lead.hpp"

namespace graben::commission {

/// What the bus says in this cycle.
struct DozerSeen {
  std::array<double, 2> stroke_m{};    ///< Lift and tilt, measured.
  std::array<double, 2> sent_ratio{};  ///< Their duties as the controller sent them last.
  double position_m = 0.0;             ///< Of the body, along the grade.
  double velocity_mps = 0.0;
  bool active = false;  ///< The controller moves the machine, and the operator has not let go.
};

class DozerSequence {
 public:
  explicit DozerSequence(const DozerOptions& options);

  /// Goes on after steps that an earlier run has done; their results in order.
  void resume(const std::vector<StepResult>& results);

  /// To be called every 10 ms. While not `active` nothing is tried, and the step that was
  /// interrupted begins again after.
  void step(double time_s, const DozerSeen& seen);

  [[nodiscard]] const DozerTry& tried() const { return tried_; }
  [[nodiscard]] bool is_done() const { return at() >= texts_.size(); }
  /// Set once a ramp has moved something the wrong way: nothing is tried from then on.
  [[nodiscard]] const std::optional<WrongWay>& wrong() const { return blade_.wrong(); }
  [[nodiscard]] std::size_t at() const { return blade_.at() + travel_at_; }
  [[nodiscard]] const std::vector<std::string>& texts() const { return texts_; }
  [[nodiscard]] std::vector<StepResult> results() const;
  /// Time in which the machine was active, s.
  [[nodiscard]] double active_s() const { return blade_.active_s() + travel_s_; }

 private:
  void lead_tracks(const DozerSeen& seen);

  CommissionSequence blade_;
  TravelLead lead_;
  std::vector<TravelStep> travel_;
  std::vector<std::string> texts_;
  std::size_t travel_at_ = 0;
  std::vector<StepResult> travel_results_;
  double travel_s_ = 0.0;
  bool was_active_ = false;
  DozerTry tried_;
};

}  // namespace graben::commission
