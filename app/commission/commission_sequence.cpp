// SPDX-License-Identifier: Apache-2.0
#include "app/commission/commission_sequence.hpp"

#include <algorithm>
#include <cmath>

#include "app/commission/sequence_judgements.hpp"

namespace graben::commission {

CommissionSequence::CommissionSequence(const SequenceOptions& options)
    : options_(options),
      swing_(options.sector, options.brakes_radps2),
      steps_(planned_steps(options)) {}

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

double CommissionSequence::travel_mps() const {
  return options_.swing ? kTravelWithSwing_mps : kTravel_mps;
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
  if (is_swings()) {
    swing_.begin(steps_[at_]);
  }
}

void CommissionSequence::step(double time_s, const SequenceInput& seen) {
  observe(time_s, seen.stroke_m);
  sent_ = seen.sent_ratio;
  duty_.fill(0.0);
  swing_duty_ = 0.0;
  if (is_done() || wrong_) {
    return;
  }
  if (!seen.active) {
    // Between two tasks the controller stands still by itself; what was under way begins again.
    was_active_ = false;
    return;
  }
  if (!was_active_) {
    was_active_ = true;
    now_ = {};
    begin(Phase::kPrepare);
  }
  active_s_ += kPeriod_s;
  if (is_swings()) {
    return lead_swing(seen);
  }
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
    const double room =
        std::min(options_.room + options_.room_per_level * step.level, options_.room_most);
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
  if (edge(axis, sign) == 0.0 || std::abs(left_m) < options_.there_m) {
    return std::abs(speed_mps(axis)) < kStands_mps;
  }
  const double v_mps = sign * speed_mps(axis);
  if (std::abs(left_m) > v_mps * kStops_s + options_.there_m) {
    const bool far = std::abs(left_m) > kNear_m + travel_mps() * kStops_s;
    const double level = level_for(axis, sign, far ? travel_mps() : kNear_mps);
    drive(axis, level_duty(axis, sign, safe_level(axis, sign, level)));
  }
  return false;
}

void CommissionSequence::lead_swing(const SequenceInput& seen) {
  const bool over = swing_.step({seen.swing_rad, seen.swing_sent_ratio});
  swing_duty_ = swing_.duty();
  if (over) {
    results_.push_back(swing_.result());
    ++at_;
    now_ = {};
    begin(Phase::kPrepare);
  }
}

void CommissionSequence::prepare() {
  constexpr double kLongest_s = 15.0;
  const SequenceStep& step = steps_[at_];
  if (step.kind == StepKind::kFold) {
    return begin(Phase::kRun);
  }
  if (step.kind == StepKind::kPair && options_.swing && spent_s_ > kPairsUntil_s) {
    return finish(StepEnd::kNoTime);
  }
  bool ready = all_stand();
  if (step.kind != StepKind::kTouch) {
    ready = approach(step.axis, start_m(step)) && ready;
  }
  if (options_.parked_m && step.axis != 0) {
    const double tried = now_.duty;
    ready = approach(0, *options_.parked_m) && ready;
    now_.duty = tried;  // Of another drive.
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
    pushes_ = 0.0;
    let_go_s_ = 0.0;
  }
}

void CommissionSequence::run() {
  const SequenceStep& step = steps_[at_];
  if (step.kind == StepKind::kFold) {
    return run_fold();
  }
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
    case StepKind::kFold:
      return;
  }
}

void CommissionSequence::finish(StepEnd end) {
  now_.end = end;
  begin(Phase::kRest);
}

/// Edges and speeds of a step are what later ones are made of.
void CommissionSequence::keep_result() {
  const SequenceStep& step = steps_[at_];
  spent_s_ += now_.took_s;
  if (step.axis == kSwing) {
    swing_.know(step, now_);
    results_.push_back(now_);
    return;
  }
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

}  // namespace graben::commission
