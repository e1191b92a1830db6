// SPDX-License-Identifier: Apache-2.0
#include "app/commission/swing_lead.hpp"

#include <algorithm>
#include <cmath>

namespace graben::commission {
namespace {

constexpr double kSwingPeriod_s = 0.01;
/// Before the sector's ends.
constexpr double kSwingMargin_rad = 0.05;
/// Until a closed spool has stopped what it lets through: dead time and lags.
constexpr double kSwingCloses_s = 0.40;
/// For so long it goes on being accelerated as it is now.
constexpr double kSwingPushedOn_s = 0.25;
/// Farther outside nothing is tried.
constexpr double kSwingOutside_rad = 0.10;
constexpr double kSwingStands_radps = 0.008;
constexpr double kSwingStandsFor_s = 0.3;
/// Of a ramp, as of a cylinder's.
constexpr double kSwingRampFrom = 0.08;
constexpr double kSwingRampSlow_ps = 0.08;
constexpr double kSwingRampTo = 0.80;
constexpr double kSwingAhead = 0.02;
constexpr double kSwingMoves_radps = 0.025;
constexpr double kSwingMoved_rad = 0.012;
constexpr double kSwingMovesFor_s = 0.20;
constexpr double kSwingFoot_s = 0.4;
/// By which what is seen in a ramp is late.
constexpr double kSwingLate_s = 0.5;
/// From place to place.
constexpr double kSwingGo_radps = 0.30;
constexpr double kSwingGo_ps = 0.8;
constexpr double kSwingThere_rad = 0.06;
constexpr double kSwingGoMost_s = 12.0;
/// A step lasts so long after it has begun to move.
constexpr double kSwingHold_s = 1.5;
constexpr double kSwingNoMotion_s = 1.6;
constexpr double kSwingRestMost_s = 3.0;
constexpr double kSwingOfMost = 0.85;
/// Of what is left of the duty beyond the edge.
constexpr std::array<double, kSwingLevelCount> kSwingLevels = {0.10, 0.22, 0.40, 0.65};
/// Untried, no more beyond the edge than this; each next duty at most so much more than the last.
constexpr double kSwingFirst = 0.04;
constexpr double kSwingMostMore = 1.6;

}  // namespace

SwingLead::SwingLead(const Sector& sector, double brakes_radps2)
    : sector_(sector), brakes_radps2_(std::max(brakes_radps2, 0.05)) {}

void SwingLead::begin(const SequenceStep& step) {
  step_ = step;
  result_ = {};
  to_phase(Phase::kWait);
}

void SwingLead::to_phase(Phase phase) {
  phase_ = phase;
  phase_s_ = 0.0;
  duty_ = 0.0;
}

void SwingLead::observe(double angle_rad) {
  if (seen_ == 0) {
    history_rad_.fill(angle_rad);
  }
  angle_rad_ = angle_rad;
  history_rad_[seen_++ % kHistory] = angle_rad;
  stands_s_ = std::abs(speed_radps()) < kSwingStands_radps ? stands_s_ + kSwingPeriod_s : 0.0;
}

/// Over the newest half of what was seen, or the half before it.
double SwingLead::speed_radps(std::size_t from) const {
  constexpr std::size_t kHalf = kHistory / 2;
  const double newer = history_rad_[(seen_ - 1 - from) % kHistory];
  const double older = history_rad_[(seen_ + kHistory - kHalf - from) % kHistory];
  return (newer - older) / (kSwingPeriod_s * static_cast<double>(kHalf - 1));
}

double SwingLead::room_rad(int sign) const {
  return sign > 0 ? sector_.left_rad - angle_rad_ : angle_rad_ - sector_.right_rad;
}

/// What the platform still turns to that side once it is told to stop now.
double SwingLead::stops_in_rad(int sign) const {
  constexpr std::size_t kBefore = kHistory / 2;
  const double now = sign * speed_radps();
  const double before = seen_ > kHistory ? sign * speed_radps(kBefore) : now;
  const double rises =
      std::max(0.0, now - before) / (kSwingPeriod_s * static_cast<double>(kBefore));
  const double most = std::max(0.0, now + kSwingPushedOn_s * rises);
  return kSwingMargin_rad + most * kSwingCloses_s + most * most / (2.0 * brakes_radps2_);
}

/// Duty at which so fast a turn is to be expected, between and a little beyond what was tried.
double SwingLead::duty_for(int sign, double wanted) const {
  const Side& of = side(sign);
  Driven below{of.edge, 0.0};
  for (const Driven& known : of.driven) {
    if (known.speed_radps >= wanted) {
      const double share =
          (wanted - below.speed_radps) / std::max(1e-6, known.speed_radps - below.speed_radps);
      return below.duty + std::clamp(share, 0.0, 1.0) * (known.duty - below.duty);
    }
    below = known.duty > below.duty ? known : below;
  }
  return std::max(of.edge + kSwingFirst, of.edge + kSwingMostMore * (below.duty - of.edge));
}

/// Fast steps want the whole sector, ramps and slow ones are content where they are.
double SwingLead::start_rad() const {
  const double length = sector_.left_rad - sector_.right_rad;
  const double share = step_.kind == StepKind::kRamp ? 0.35 : 0.5 + 0.1 * step_.level;
  const double needs = share * length;
  const double start = step_.sign > 0 ? std::min(angle_rad_, sector_.left_rad - needs)
                                      : std::max(angle_rad_, sector_.right_rad + needs);
  return std::clamp(start, sector_.right_rad + kSwingThere_rad, sector_.left_rad - kSwingThere_rad);
}

void SwingLead::know(const SequenceStep& step, const StepResult& result) {
  const bool moved = result.end != StepEnd::kNoMotion && result.speed_mps > kSwingMoves_radps;
  if (!moved || (step.kind != StepKind::kRamp && step.kind != StepKind::kStep)) {
    return;
  }
  Side& of = side(step.sign);
  if (step.kind == StepKind::kRamp) {
    of.edge = std::max(
        kSwingRampFrom,
        result.duty - kSwingRampSlow_ps * (kSwingFoot_s + kSwingMovesFor_s + kSwingLate_s));
  }
  of.driven.push_back({result.duty, result.speed_mps});
  std::sort(of.driven.begin(), of.driven.end(),
            [](const Driven& a, const Driven& b) { return a.duty < b.duty; });
}

bool SwingLead::step(const SwingSeen& seen) {
  observe(seen.angle_rad);
  sent_ = seen.sent_ratio;
  phase_s_ += kSwingPeriod_s;
  result_.took_s += kSwingPeriod_s;
  duty_ = 0.0;
  switch (phase_) {
    case Phase::kWait:
      wait();
      return false;
    case Phase::kGo:
      go();
      return false;
    case Phase::kRun:
      run();
      return false;
    case Phase::kRest:
      result_.speed_mps = std::max(result_.speed_mps, step_.sign * speed_radps());
      if (stands_s_ > kSwingStandsFor_s || phase_s_ > kSwingRestMost_s) {
        know(step_, result_);
        return true;
      }
      return false;
  }
  return false;
}

void SwingLead::wait() {
  if (room_rad(1) < -kSwingOutside_rad || room_rad(-1) < -kSwingOutside_rad) {
    finish(StepEnd::kOutside);
  } else if (stands_s_ > kSwingStandsFor_s) {
    target_rad_ = start_rad();
    to_phase(Phase::kGo);
  }
}

void SwingLead::go() {
  const double left_rad = target_rad_ - angle_rad_;
  const int sign = left_rad > 0.0 ? 1 : -1;
  const double along = sign * speed_radps();
  const bool near = std::abs(left_rad) < kSwingThere_rad + std::max(0.0, along) * kSwingCloses_s;
  if (side(sign).edge > 0.0 && !near && phase_s_ < kSwingGoMost_s &&
      room_rad(sign) > stops_in_rad(sign)) {
    duty_ = sign * duty_for(sign, std::min(kSwingGo_radps, kSwingGo_ps * std::abs(left_rad)));
    return;
  }
  if (stands_s_ > kSwingStandsFor_s || phase_s_ > kSwingGoMost_s + kSwingRestMost_s) {
    to_phase(Phase::kRun);
    from_rad_ = angle_rad_;
    ramp_ = kSwingRampFrom;
    moves_s_ = 0.0;
    moving_s_ = 0.0;
  }
}

void SwingLead::run() {
  const double along = step_.sign * speed_radps();
  result_.duty = std::max(result_.duty, step_.sign * sent_);
  result_.speed_mps = std::max(result_.speed_mps, along);
  const bool fast = along > kSwingOfMost * sector_.most_radps;
  if (fast || room_rad(step_.sign) < stops_in_rad(step_.sign)) {
    return finish(StepEnd::kAtWindow);
  }
  step_.kind == StepKind::kRamp ? run_ramp(along) : run_step(along);
}

void SwingLead::run_ramp(double along) {
  const bool moved = step_.sign * (angle_rad_ - from_rad_) > kSwingMoved_rad;
  moves_s_ = along > kSwingMoves_radps ? moves_s_ + kSwingPeriod_s : 0.0;
  if (moving_s_ > 0.0 || (moves_s_ > kSwingMovesFor_s && moved)) {
    moving_s_ += kSwingPeriod_s;
  }
  if (moving_s_ > kSwingFoot_s || ramp_ > kSwingRampTo) {
    return finish(moving_s_ > 0.0 ? StepEnd::kDone : StepEnd::kNoMotion);
  }
  // The controller holds it back while pressures change and nothing moves.
  ramp_ = std::min(ramp_ + kSwingRampSlow_ps * kSwingPeriod_s,
                   std::max(ramp_, step_.sign * sent_ + kSwingAhead));
  duty_ = step_.sign * ramp_;
}

void SwingLead::run_step(double along) {
  const Side& of = side(step_.sign);
  if (of.edge == 0.0) {
    return finish(StepEnd::kNoMotion);
  }
  if (moving_s_ > 0.0 || along > kSwingMoves_radps) {
    moving_s_ += kSwingPeriod_s;
  }
  if (moving_s_ > kSwingHold_s) {
    return finish(StepEnd::kDone);
  }
  if (moving_s_ == 0.0 && phase_s_ > kSwingNoMotion_s) {
    return finish(StepEnd::kNoMotion);
  }
  duty_ =
      step_.sign * (of.edge + (1.0 - of.edge) * kSwingLevels[static_cast<unsigned>(step_.level)]);
}

void SwingLead::finish(StepEnd end) {
  result_.end = end;
  to_phase(Phase::kRest);
}

}  // namespace graben::commission
