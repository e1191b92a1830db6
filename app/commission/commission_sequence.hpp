#pragma once
/// What a machine is asked to do so that a log of it says how its valves open, how late they are
/// and where its sensors' zeros lie: one drive, one direction at a time. Pure: strokes in, duties
/// out; who sends them, and who guards them (the ECU does), is not its business.

#include <array>
#include <string>
#include <vector>

#include "firmware/excavator/excavator_profile.hpp"

namespace graben::commission {

/// Where a cylinder may be and how fast, as the operator has confirmed it.
struct Window {
  double least_m = 0.0;
  double most_m = 0.0;
  double most_mps = 0.0;
};

/// What is to be done; each part can be left out.
struct SequenceOptions {
  std::array<Window, kAxisCount> window{};
  std::array<double, kAxisCount> stroke_m{};  ///< Of the cylinders.
  std::array<int, kAxisCount> pump{};         ///< Which feeds each.
  std::array<bool, kAxisCount> drives = {true, true, true};
  std::array<bool, kAxisCount> touch_extended = {true, true,
                                                 true};  ///< Only where its window reaches there.
  std::array<bool, kAxisCount> touch_retracted = {true, true, true};
  bool steps = true;
  bool bursts = true;
  bool pairs = true;  ///< Two drives of one pump at once.
};

/// Everything that there is, over the whole strokes; what is too near to an end for the machine's
/// surroundings is for the operator to take out.
[[nodiscard]] SequenceOptions whole_sequence(const ExcavatorProfile& profile);

enum class StepKind { kRamp, kStep, kBurst, kTouch, kPair };

/// One thing that is tried.
struct SequenceStep {
  StepKind kind = StepKind::kRamp;
  int axis = 0;
  int sign = 0;    ///< +1 extends.
  int level = 0;   ///< Of kStep and kPair: which of the five.
  int other = -1;  ///< Of kPair: the second drive.
};

/// How a step ended.
enum class StepEnd { kDone, kAtWindow, kNoMotion };

/// What became of a step; with the plan's order all that is needed to go on after a break.
struct StepResult {
  StepEnd end = StepEnd::kDone;
  double duty = 0.0;       ///< Largest magnitude that was tried.
  double speed_mps = 0.0;  ///< Largest that came of it.
  double took_s = 0.0;     ///< With the way to where it began, and until all stood again.
};

/// "boom, extending: ramp to its edge".
[[nodiscard]] std::string step_text(const SequenceStep& step);

class CommissionSequence {
 public:
  explicit CommissionSequence(const SequenceOptions& options);

  /// Goes on after steps that an earlier run has done; their results in order.
  void resume(const std::vector<StepResult>& results);

  /// To be called every 10 ms with the measured strokes. While not `active` (the ECU does not move,
  /// the operator has let go) duties are 0 and the step that was interrupted begins again after.
  void step(double time_s, const std::array<double, kAxisCount>& strokes_m, bool active);

  [[nodiscard]] const std::array<double, kAxisCount>& duty() const { return duty_; }
  [[nodiscard]] bool is_done() const { return at_ >= steps_.size(); }
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
  double& edge(int axis, int sign);
  [[nodiscard]] double edge(int axis, int sign) const;
  struct Driven {
    double level = 0.0;
    double speed_mps = 0.0;
  };
  [[nodiscard]] const std::vector<Driven>& driven(int axis, int sign) const;
  void remember(int axis, int sign, double duty, double speed_mps);
  [[nodiscard]] double level_for(int axis, int sign, double speed_mps) const;
  [[nodiscard]] bool all_stand() const;

  SequenceOptions options_;
  std::vector<SequenceStep> steps_;
  std::vector<StepResult> results_;
  std::size_t at_ = 0;
  Phase phase_ = Phase::kPrepare;
  double time_s_ = 0.0;
  double phase_begin_s_ = 0.0;
  double active_s_ = 0.0;
  bool was_active_ = false;
  std::array<double, kAxisCount> duty_{};
  std::array<double, kAxisCount> stroke_m_{};
  std::array<std::array<double, kHistory>, kAxisCount> history_m_{};
  std::size_t seen_ = 0;
  std::array<std::array<double, 2>, kAxisCount> edge_{};  ///< Duty at which it moved; 0: not known.
  /// What was tried, by rising level.
  std::array<std::array<std::vector<Driven>, 2>, kAxisCount> driven_{};
  StepResult now_;
  double mark_s_ = 0.0;  ///< Of a step: when it moved, or stood at its end.
  double ramp_ = 0.0;
  double from_m_ = 0.0;    ///< Stroke at which a ramp began.
  int presses_ = 0;        ///< Of a touch, so far.
  double let_go_s_ = 0.0;  ///< For so long a touch has been let go.
  double moves_s_ = 0.0;   ///< For so long in a row a ramp's drive has moved.
  double stands_s_ = 0.0;  ///< For so long all have stood: where a linkage rocks, it turns.
};

}  // namespace graben::commission
