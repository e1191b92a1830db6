// SPDX-License-Identifier: Apache-2.0
// How each kind of step runs once its drive is where it begins.
#include "app/commission/commission_sequence.hpp"

#include <algorithm>
#include <cmath>

#include "app/commission/sequence_judgements.hpp"

namespace graben::commission {

void CommissionSequence::run_ramp() {
  const SequenceStep& step = steps_[at_];
  wrong_ = look_for_wrong_way(step, begin_m_, stroke_m_,
                              {speed_mps(kBoom), speed_mps(kArm), speed_mps(kBucket)});
  if (wrong_) {
    return;
  }
  if (room_m(step.axis, step.sign) < kMargin_m + now_.speed_mps * kStops_s) {
    return finish(StepEnd::kAtWindow);
  }
  const double moved_m = step.sign * (stroke_m_[static_cast<unsigned>(step.axis)] - from_m_);
  moves_s_ = step.sign * speed_mps(step.axis) > kMoves_mps ? moves_s_ + kPeriod_s : 0.0;
  if (moves_s_ > kMovesFor_s && moved_m > kMoved_m && mark_s_ == 0.0) {
    mark_s_ = time_s_;
  }
  if (mark_s_ > 0.0 && time_s_ - mark_s_ > kFoot_s) {
    const Window& window = options_.window[static_cast<unsigned>(step.axis)];
    const double inside_m = options_.first_inside * (window.most_m - window.least_m);
    const bool inside = inside_m == 0.0 || room_m(step.axis, -step.sign) >= inside_m;
    if (edge(step.axis, -step.sign) > 0.0 || inside) {
      return finish(StepEnd::kDone);
    }
    return drive(step.axis, step.sign * ramp_);
  }
  if (ramp_ > kRampTo) {
    return finish(StepEnd::kNoMotion);
  }
  // The controller holds it back while pressures change and nothing moves.
  const double most = step.sign * sent_[static_cast<unsigned>(step.axis)] + kAhead;
  ramp_ = std::min(ramp_ + kPeriod_s * (ramp_ < kLeastEdge ? kRampSteep : kRampSlow),
                   std::max(ramp_, most));
  drive(step.axis, step.sign * ramp_);
}

void CommissionSequence::run_step() {
  const SequenceStep& step = steps_[at_];
  const double wanted =
      step.kind == StepKind::kPair ? kPairLevel : kLevels[static_cast<unsigned>(step.level)];
  if (edge(step.axis, step.sign) == 0.0) {
    return finish(StepEnd::kNoMotion);
  }
  const double v_mps = step.sign * speed_mps(step.axis);
  if (room_m(step.axis, step.sign) < kMargin_m + std::max(0.0, v_mps) * kStops_s) {
    return finish(StepEnd::kAtWindow);
  }
  // A line of less pressure lets the load in.
  const double back_m = step.sign * (from_m_ - stroke_m_[static_cast<unsigned>(step.axis)]);
  if (back_m > kBack_m) {
    return finish(StepEnd::kNoMotion);
  }
  if (v_mps > 0.5 * kMoves_mps && mark_s_ == 0.0) {
    mark_s_ = time_s_;
  }
  if (mark_s_ > 0.0 ? time_s_ - mark_s_ > kHold_s : elapsed_s() > kNoMotion_s) {
    return finish(mark_s_ > 0.0 ? StepEnd::kDone : StepEnd::kNoMotion);
  }
  drive(step.axis, level_duty(step.axis, step.sign, safe_level(step.axis, step.sign, wanted)));
  if (step.kind == StepKind::kPair && edge(step.other, step.sign) > 0.0) {
    const double other_mps = std::max(0.0, step.sign * speed_mps(step.other));
    if (room_m(step.other, step.sign) < kMargin_m + other_mps * kStops_s) {
      return finish(StepEnd::kAtWindow);
    }
    drive(step.other, level_duty(step.other, step.sign, safe_level(step.other, step.sign, wanted)));
  }
}

/// The links where the turning platform needs least room, arm and boom at once; the bucket stays as
/// it is.
void CommissionSequence::run_fold() {
  constexpr double kLongest_s = 25.0;
  bool there = true;
  for (const int axis : {static_cast<int>(kArm), static_cast<int>(kBoom)}) {
    there = approach(axis, folded_m(axis)) && there;
  }
  if (there || elapsed_s() > kLongest_s) {
    // Without its edges a drive stays where it is.
    const bool arm_in = std::abs(stroke_m_[kArm] - folded_m(kArm)) < 4.0 * kThere_m;
    finish(arm_in ? StepEnd::kDone : StepEnd::kNoMotion);
  }
}

/// As the options say, away from the ends of the window.
double CommissionSequence::folded_m(int axis) const {
  constexpr double kInside = 0.1;
  const auto k = static_cast<unsigned>(axis);
  const Window& window = options_.window[k];
  const double inside_m = kInside * (window.most_m - window.least_m);
  return std::clamp(options_.folded_m[k], window.least_m + inside_m, window.most_m - inside_m);
}

/// Short pulses to either side: what rings after each is the linkage on its oil.
void CommissionSequence::run_burst() {
  const SequenceStep& step = steps_[at_];
  if (edge(step.axis, 1) == 0.0 || edge(step.axis, -1) == 0.0) {
    return finish(StepEnd::kNoMotion);
  }
  constexpr double kEach_s = 0.7;
  const int pulse = static_cast<int>(elapsed_s() / kEach_s);
  const int sign = pulse % 2 == 0 ? 1 : -1;
  if (pulse >= kPulses || room_m(step.axis, sign) < 2.0 * kMargin_m) {
    return finish(pulse >= kPulses ? StepEnd::kDone : StepEnd::kAtWindow);
  }
  if (elapsed_s() - kEach_s * pulse < kPulse_s) {
    drive(step.axis, level_duty(step.axis, sign, safe_level(step.axis, sign, kBurstLevel)));
  }
}

void CommissionSequence::run_touch() {
  constexpr double kLongest_s = 25.0;
  const SequenceStep& step = steps_[at_];
  const auto k = static_cast<unsigned>(step.axis);
  if (edge(step.axis, step.sign) == 0.0 || elapsed_s() > kLongest_s) {
    return finish(StepEnd::kNoMotion);
  }
  const double left_m = step.sign > 0 ? options_.stroke_m[k] - stroke_m_[k] : stroke_m_[k];
  const double v_mps = std::max(0.0, step.sign * speed_mps(step.axis));
  // A cushion lets a piston creep: it is at its end where its stroke does not change at all.
  if (std::abs(stroke_m_[k] - from_m_) > kSame_m) {
    from_m_ = stroke_m_[k];
    mark_s_ = time_s_;
  }
  const bool stands = left_m < kEnd_m && time_s_ - mark_s_ > kPress_s;
  if (stands && presses_ > 0) {
    return finish(StepEnd::kDone);
  }
  // The guard may have held it just before, or on its way; let go and asked again, it comes to the
  // very end.
  const bool held = sent_[k] == 0.0 && time_s_ - mark_s_ > kPress_s;
  if (stands || held || let_go_s_ > 0.0) {
    let_go_s_ += kPeriod_s;
    mark_s_ = time_s_;
    if (let_go_s_ > kStops_s + kLetGo_s) {
      let_go_s_ = 0.0;
      presses_ += left_m < kEnd_m ? 1 : 0;
    }
    return;
  }
  const bool presses = time_s_ - mark_s_ > kPresses_s;
  const double speed_mps = left_m > kNear_m + v_mps * kStops_s              ? travel_mps()
                           : presses || left_m > kLast_m + v_mps * kStops_s ? kNear_mps
                                                                            : kLast_mps;
  // A load that has become heavier stands where the line's pressure grows with the opening.
  const bool waits = left_m >= kEnd_m && sent_[k] != 0.0 && time_s_ - mark_s_ > kPresses_s;
  const bool creeps = left_m < kEnd_m && v_mps < kCreeps * speed_mps;
  const bool hurries = v_mps > kTooFast * speed_mps;
  const double more_ps = waits ? kPushes_ps : creeps ? kPushesLast_ps : hurries ? -kPushes_ps : 0.0;
  pushes_ = std::max(0.0, pushes_ + kPeriod_s * more_ps);
  const double level = level_for(step.axis, step.sign, speed_mps) + pushes_;
  drive(step.axis, level_duty(step.axis, step.sign, safe_level(step.axis, step.sign, level)));
}

}  // namespace graben::commission
