// SPDX-License-Identifier: Apache-2.0
#include "app/commission/commission_sequence.hpp"

#include <algorithm>
#include <cmath>

namespace graben::commission {
namespace {

constexpr double kPeriod_s = 0.01;
/// Of a ramp. Slow: what a late machine is ahead of itself by then is a tenth of its edge.
constexpr double kRampFrom = 0.04;
constexpr double kRampSteep = 0.20;  ///< 1/s, up to the least edge that is likely.
constexpr double kRampSlow = 0.08;   ///< 1/s
constexpr double kRampTo = 0.80;
/// By which it may be before what was sent: some cycles of it.
constexpr double kAhead = 0.02;
constexpr double kLeastEdge = 0.08;
/// It moves, and has moved: a linkage that rocks comes back.
constexpr double kMoves_mps = 0.010;
constexpr double kMoved_m = 0.006;
constexpr double kMovesFor_s = 0.25;
/// A ramp goes on a little beyond: the curve's foot.
constexpr double kFoot_s = 0.45;
/// Of what is left of the duty beyond the edge.
constexpr std::array<double, kLevelCount> kLevels = {0.08, 0.18, 0.35, 0.62, 1.0};
constexpr double kPairLevel = 0.55;
constexpr double kBurstLevel = 0.30;
constexpr double kFirstLevel = 0.15;  ///< Untried, no more of it than this.
/// From place to place, near to it, and onto an end.
constexpr double kTravel_mps = 0.14;
constexpr double kNear_mps = 0.05;
constexpr double kNear_m = 0.10;
constexpr double kLast_mps = 0.025;
constexpr double kLast_m = 0.03;
constexpr double kLetGo_s = 0.2;
/// A piston that has stood for so long is pushed a little more.
constexpr double kPresses_s = 0.2;
/// A step lasts so long after its drive has begun to move.
constexpr double kHold_s = 0.75;
constexpr double kNoMotion_s = 1.4;
/// A drive that its load pushes back so far is let go.
constexpr double kBack_m = 0.006;
/// What a machine may need to stop: dead time and lags.
constexpr double kStops_s = 0.50;
constexpr double kMargin_m = 0.03;
/// Between two steps: standing, and everything under way has come.
constexpr double kRest_s = 0.45;
constexpr double kRestMost_s = 2.0;
constexpr double kStands_mps = 0.003;
constexpr double kStandsFor_s = 0.25;
/// Speed grows with the level no faster than with this power.
constexpr double kSteepest = 2.0;
constexpr double kOfMost = 0.75;
constexpr double kPress_s = 0.80;
constexpr double kSame_m = 0.00015;
constexpr double kPulse_s = 0.15;
constexpr int kPulses = 4;
constexpr double kThere_m = 0.03;

}  // namespace

CommissionSequence::CommissionSequence(const SequenceOptions& options)
    : options_(options), steps_(planned_steps(options)) {}

void CommissionSequence::resume(const std::vector<StepResult>& results) {
  for (const StepResult& result : results) {
    if (is_done()) {
      return;
    }
    now_ = result;
    keep_result();
    ++at_;
  }
  begin(Phase::kPrepare);
}

void CommissionSequence::remember(int axis, int sign, double duty, double speed_mps) {
  const double open = edge(axis, sign);
  auto& known = driven_[static_cast<unsigned>(axis)][side(sign)];
  known.push_back({(duty - open) / (1.0 - open), speed_mps});
  std::sort(known.begin(), known.end(),
            [](const Driven& a, const Driven& b) { return a.level < b.level; });
}

/// Level at which so fast a motion is to be expected, between what was tried.
double CommissionSequence::level_for(int axis, int sign, double wanted_mps) const {
  Driven below;
  for (const Driven& known : driven(axis, sign)) {
    if (known.speed_mps >= wanted_mps) {
      const double share =
          (wanted_mps - below.speed_mps) / std::max(1e-6, known.speed_mps - below.speed_mps);
      return below.level + std::clamp(share, 0.0, 1.0) * (known.level - below.level);
    }
    below = known;
  }
  const double least_mps = std::max(below.speed_mps, kMoves_mps);
  return std::max(kFirstLevel, below.level) * std::min(2.0, wanted_mps / least_mps);
}

bool CommissionSequence::all_stand() const { return stands_s_ > kStandsFor_s; }

void CommissionSequence::observe(double time_s, const std::array<double, kAxisCount>& strokes_m) {
  time_s_ = time_s;
  stroke_m_ = strokes_m;
  for (unsigned k = 0; k < kAxisCount; ++k) {
    if (seen_ == 0) {
      history_m_[k].fill(strokes_m[k]);
    }
    history_m_[k][seen_ % kHistory] = strokes_m[k];
  }
  ++seen_;
  const bool stand = std::abs(speed_mps(0)) < kStands_mps && std::abs(speed_mps(1)) < kStands_mps &&
                     std::abs(speed_mps(2)) < kStands_mps;
  stands_s_ = stand ? stands_s_ + kPeriod_s : 0.0;
}

double CommissionSequence::speed_mps(int axis) const {
  const auto& history = history_m_[static_cast<unsigned>(axis)];
  const double newest = history[(seen_ - 1) % kHistory];
  const double oldest = history[seen_ % kHistory];
  return (newest - oldest) / (kPeriod_s * static_cast<double>(kHistory - 1));
}

void CommissionSequence::drive(int axis, double duty) {
  duty_[static_cast<unsigned>(axis)] = duty;
  now_.duty = std::max(now_.duty, std::abs(duty));
}

double CommissionSequence::room_m(int axis, int sign) const {
  const auto k = static_cast<unsigned>(axis);
  const Window& window = options_.window[k];
  return sign > 0 ? window.most_m - stroke_m_[k] : stroke_m_[k] - window.least_m;
}

double CommissionSequence::level_duty(int axis, int sign, double level) const {
  const double open = edge(axis, sign);
  return sign * (open + (1.0 - open) * level);
}

/// What was tried before says how fast the next level will be at most.
double CommissionSequence::safe_level(int axis, int sign, double level) const {
  const double most_mps = kOfMost * options_.window[static_cast<unsigned>(axis)].most_mps;
  double most = kFirstLevel;
  for (const Driven& known : driven(axis, sign)) {
    if (known.level > 0.0 && known.speed_mps > kMoves_mps) {
      most = known.level * std::pow(most_mps / known.speed_mps, 1.0 / kSteepest);
    }
  }
  return std::min({level, most, 1.0});
}

void CommissionSequence::begin(Phase phase) {
  phase_ = phase;
  phase_begin_s_ = time_s_;
  mark_s_ = 0.0;
  duty_.fill(0.0);
}

void CommissionSequence::step(double time_s, const SequenceInput& seen) {
  observe(time_s, seen.stroke_m);
  sent_ = seen.sent_ratio;
  duty_.fill(0.0);
  if (is_done() || wrong_) {
    return;
  }
  if (!seen.active) {
    was_active_ = false;
    return;
  }
  if (!was_active_) {
    was_active_ = true;
    now_ = {};
    begin(Phase::kPrepare);
  }
  active_s_ += kPeriod_s;
  now_.took_s += kPeriod_s;
  switch (phase_) {
    case Phase::kPrepare:
      return prepare();
    case Phase::kRun:
      return run();
    case Phase::kRest: {
      if ((elapsed_s() > kRest_s && all_stand()) || elapsed_s() > kRestMost_s) {
        keep_result();
        ++at_;
        now_ = {};
        begin(Phase::kPrepare);
      }
      return;
    }
  }
}

/// Where a step has room for what it is to show.
double CommissionSequence::start_m(const SequenceStep& step) const {
  const auto k = static_cast<unsigned>(step.axis);
  const Window& window = options_.window[k];
  const double length_m = window.most_m - window.least_m;
  const double here = (stroke_m_[k] - window.least_m) / length_m;
  double share = here;
  if (step.kind == StepKind::kStep || step.kind == StepKind::kPair) {
    // Fast steps want room, slow ones are content where they are.
    const double room = std::min(0.20 + 0.08 * step.level, 0.5);
    share = step.sign > 0 ? std::min(here, 1.0 - room) : std::max(here, room);
  } else if (step.kind == StepKind::kRamp || step.kind == StepKind::kBurst) {
    share = std::clamp(here, 0.25, 0.75);
  }
  return window.least_m + share * length_m;
}

/// Towards a stroke; true once it is near and stands. Only where both edges are known.
bool CommissionSequence::approach(int axis, double target_m) {
  const double left_m = target_m - stroke_m_[static_cast<unsigned>(axis)];
  const int sign = left_m > 0.0 ? 1 : -1;
  if (edge(axis, sign) == 0.0 || std::abs(left_m) < kThere_m) {
    return std::abs(speed_mps(axis)) < kStands_mps;
  }
  const double v_mps = sign * speed_mps(axis);
  if (std::abs(left_m) > v_mps * kStops_s + kThere_m) {
    const bool far = std::abs(left_m) > kNear_m + kTravel_mps * kStops_s;
    const double level = level_for(axis, sign, far ? kTravel_mps : kNear_mps);
    drive(axis, level_duty(axis, sign, safe_level(axis, sign, level)));
  }
  return false;
}

void CommissionSequence::prepare() {
  constexpr double kLongest_s = 15.0;
  const SequenceStep& step = steps_[at_];
  bool ready = all_stand();
  if (step.kind != StepKind::kTouch) {
    ready = approach(step.axis, start_m(step)) && ready;
  }
  if (step.kind == StepKind::kPair) {
    SequenceStep second = step;
    second.axis = step.other;
    ready = approach(step.other, start_m(second)) && ready;
  }
  if ((ready && elapsed_s() > 0.1) || elapsed_s() > kLongest_s) {
    begin(Phase::kRun);
    ramp_ = kRampFrom;
    from_m_ = stroke_m_[static_cast<unsigned>(step.axis)];
    begin_m_ = stroke_m_;
    moves_s_ = 0.0;
    presses_ = 0;
    let_go_s_ = 0.0;
  }
}

void CommissionSequence::run() {
  const SequenceStep& step = steps_[at_];
  now_.speed_mps = std::max(now_.speed_mps, step.sign * speed_mps(step.axis));
  switch (step.kind) {
    case StepKind::kRamp:
      return run_ramp();
    case StepKind::kStep:
    case StepKind::kPair:
      return run_step();
    case StepKind::kBurst:
      return run_burst();
    case StepKind::kTouch:
      return run_touch();
  }
}

void CommissionSequence::finish(StepEnd end) {
  now_.end = end;
  begin(Phase::kRest);
}

/// Edges and speeds of a step are what later ones are made of.
void CommissionSequence::keep_result() {
  const SequenceStep& step = steps_[at_];
  const bool moved = now_.end != StepEnd::kNoMotion && now_.speed_mps > kMoves_mps;
  if (moved && step.kind == StepKind::kRamp) {
    // Without the foot, and what was under way when it was seen to move.
    edge(step.axis, step.sign) =
        std::max(kLeastEdge, now_.duty - kRampSlow * (kFoot_s + kMovesFor_s + kStops_s));
  }
  const bool tells = step.kind == StepKind::kRamp || step.kind == StepKind::kStep;
  if (tells && edge(step.axis, step.sign) > 0.0 && now_.speed_mps > kMoves_mps) {
    remember(step.axis, step.sign, now_.duty, now_.speed_mps);
  }
  results_.push_back(now_);
}

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
    return finish(StepEnd::kDone);
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
  constexpr double kLongest_s = 30.0;
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
  // The guard may have held it just before; let go and asked again, it comes to the very end.
  if (stands || let_go_s_ > 0.0) {
    let_go_s_ += kPeriod_s;
    mark_s_ = time_s_;
    if (let_go_s_ > kStops_s + kLetGo_s) {
      let_go_s_ = 0.0;
      ++presses_;
    }
    return;
  }
  const bool presses = time_s_ - mark_s_ > kPresses_s;
  const double speed_mps = left_m > kNear_m + v_mps * kStops_s              ? kTravel_mps
                           : presses || left_m > kLast_m + v_mps * kStops_s ? kNear_mps
                                                                            : kLast_mps;
  const double level = level_for(step.axis, step.sign, speed_mps);
  drive(step.axis, level_duty(step.axis, step.sign, safe_level(step.axis, step.sign, level)));
}

}  // namespace graben::commission
