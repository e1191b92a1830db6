// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a machine is asked to do so that a log of it says how its valves open, how late they are
/// and where its sensors' zeros lie: one drive, one direction at a time. Pure: strokes in, duties
/// out; who sends them, and who guards them (the ECU does), is not its business.

#include <array>
#include <optional>
#include <vector>

#include "app/commission/commission_plan.hpp"
#include "app/commission/swing_lead.hpp"
#include "app/commission/wrong_way.hpp"

namespace graben::commission {

/// What the bus says in this cycle.
struct SequenceInput {
  std::array<double, kAxisCount> stroke_m{};    ///< Measured.
  std::array<double, kAxisCount> sent_ratio{};  ///< Duties as the controller sent them last.
  bool active = false;     ///< The controller moves the machine, and the operator has not let go.
  double swing_rad = 0.0;  ///< Measured.
  double swing_sent_ratio = 0.0;  ///< Its duty, as the others.
};

class CommissionSequence {
 public:
  explicit CommissionSequence(const SequenceOptions& options);

  /// Goes on after steps that an earlier run has done; their results in order.
  void resume(const std::vector<StepResult>& results);

  /// To be called every 10 ms. While not `active` duties are 0 and the step that was interrupted
  /// begins again after.
  void step(double time_s, const SequenceInput& seen);

  [[nodiscard]] const std::array<double, kAxisCount>& duty() const { return duty_; }
  /// The swing's, which its lever has to say.
  [[nodiscard]] double swing_duty() const { return swing_duty_; }
  [[nodiscard]] bool is_done() const { return at_ >= steps_.size(); }
  /// Set once a ramp has moved something the wrong way: duties are 0 from then on.
  [[nodiscard]] const std::optional<WrongWay>& wrong() const { return wrong_; }
  [[nodiscard]] std::size_t at() const { return at_; }
  [[nodiscard]] const std::vector<SequenceStep>& steps() const { return steps_; }
  [[nodiscard]] const std::vector<StepResult>& results() const { return results_; }
  /// Time in which the machine was active, s.
  [[nodiscard]] double active_s() const { return active_s_; }

 private:
  enum class Phase { kPrepare, kRun, kRest };
  static constexpr std::size_t kHistory = 8;

  void observe(double time_s, const std::array<double, kAxisCount>& strokes_m);
  void begin(Phase phase);
  void prepare();
  void run();
  void run_ramp();
  void run_step();
  void run_burst();
  void run_touch();
  void run_fold();
  void lead_swing(const SequenceInput& seen);
  /// The step is one of the swing itself.
  [[nodiscard]] bool is_swings() const {
    return !is_done() && steps_[at_].axis == kSwing && steps_[at_].kind != StepKind::kFold;
  }
  void finish(StepEnd end);
  void keep_result();
  bool approach(int axis, double target_m);
  [[nodiscard]] double room_m(int axis, int sign) const;
  [[nodiscard]] double start_m(const SequenceStep& step) const;
  [[nodiscard]] double level_duty(int axis, int sign, double level) const;
  [[nodiscard]] double safe_level(int axis, int sign, double level) const;
  void drive(int axis, double duty);
  [[nodiscard]] double elapsed_s() const { return time_s_ - phase_begin_s_; }
  [[nodiscard]] double speed_mps(int axis) const;
  static unsigned side(int sign) { return sign > 0 ? 0U : 1U; }
  double& edge(int axis, int sign) { return edge_[static_cast<unsigned>(axis)][side(sign)]; }
  [[nodiscard]] double edge(int axis, int sign) const {
    return edge_[static_cast<unsigned>(axis)][side(sign)];
  }
  struct Driven {
    double level = 0.0;
    double speed_mps = 0.0;
  };
  [[nodiscard]] const std::vector<Driven>& driven(int axis, int sign) const {
    return driven_[static_cast<unsigned>(axis)][side(sign)];
  }
  void remember(int axis, int sign, double duty, double speed_mps);
  [[nodiscard]] double level_for(int axis, int sign, double speed_mps) const;
  [[nodiscard]] bool all_stand() const;
  [[nodiscard]] double travel_mps() const;
  [[nodiscard]] double folded_m(int axis) const;

  SequenceOptions options_;
  SwingLead swing_;
  double swing_duty_ = 0.0;
  std::vector<SequenceStep> steps_;
  std::vector<StepResult> results_;
  std::size_t at_ = 0;
  Phase phase_ = Phase::kPrepare;
  double time_s_ = 0.0;
  double phase_begin_s_ = 0.0;
  double active_s_ = 0.0;
  double spent_s_ = 0.0;  ///< By the steps that are done, of earlier runs too.
  bool was_active_ = false;
  std::array<double, kAxisCount> duty_{};
  std::array<double, kAxisCount> stroke_m_{};
  std::array<std::array<double, kHistory>, kAxisCount> history_m_{};
  std::size_t seen_ = 0;
  std::array<std::array<double, 2>, kAxisCount> edge_{};  ///< Duty at which it moved; 0: not known.
  /// What was tried, by rising level.
  std::array<std::array<std::vector<Driven>, 2>, kAxisCount> driven_{};
  StepResult now_;
  double mark_s_ = 0.0;                    ///< Of a step: when it moved, or stood at its end.
  std::array<double, kAxisCount> sent_{};  ///< By the controller.
  double ramp_ = 0.0;
  double from_m_ = 0.0;                       ///< Stroke at which a ramp began.
  std::array<double, kAxisCount> begin_m_{};  ///< All strokes then.
  std::optional<WrongWay> wrong_;
  int presses_ = 0;        ///< Of a touch, so far.
  double pushes_ = 0.0;    ///< Of a touch: level beyond what moved its drive elsewhere.
  double let_go_s_ = 0.0;  ///< For so long a touch has been let go.
  double moves_s_ = 0.0;   ///< For so long in a row a ramp's drive has moved.
  double stands_s_ = 0.0;  ///< For so long all have stood: where a linkage rocks, it turns.
};

}  // namespace graben::commission
