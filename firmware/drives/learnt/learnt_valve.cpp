// SPDX-License-Identifier: Apache-2.0
#include "firmware/drives/learnt/learnt_valve.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/drives/learnt/tuning.hpp"
#include "firmware/drives/spool_opening.hpp"
#include "firmware/numeric/power.hpp"

namespace graben {
namespace {

/// Steps until an opening and what is learnt at it agree. [-; size: loop of opening_by_profile()]
constexpr int kSteps = 4;

/// About -o ln(o), which is the change of the opening by the exponent.
double curve(double opening) { return 1.48 * opening * (1.0 - opening) / (opening + 0.48); }

/// In the dead band of the other sign than the spool.
double signed_opening(const DriveRow& drive, double spool_ratio) {
  return std::copysign(1.0, spool_ratio) *
         opening_at(drive.answer.towards(spool_ratio), std::abs(spool_ratio));
}

double share_of_newest(double lag_s, double period_s) { return period_s / (period_s + lag_s); }

void lag(const LearntAsk& newest, double share, LearntAsk& state) {
  state.speed_mps += share * (newest.speed_mps - state.speed_mps);
  state.opening += share * (newest.opening - state.opening);
}

void lag(const LearntSeen& newest, double share, LearntSeen& state) {
  lag(newest.asked, share, state.asked);
  state.opening += share * (newest.opening - state.opening);
  state.speed_mps += share * (newest.speed_mps - state.speed_mps);
}

/// Kalman's correction by an opening `beyond` the profile's; so much of it is taken.
void learn(double beyond, double opening, double variance, double taken, LearntSide& side) {
  const double by_bend = curve(opening);
  const double by_edge = 1.0 - opening;
  const double of_edge = side.edge_variance * by_edge + side.covariance * by_bend;
  const double of_bend = side.covariance * by_edge + side.bend_variance * by_bend;
  const double total = by_edge * of_edge + by_bend * of_bend + variance;
  const double missed = taken * (beyond - opening_beyond(side, opening));
  side.edge = std::clamp(side.edge + of_edge / total * missed, -kLearntEdgeMost, kLearntEdgeMost);
  side.bend = std::clamp(side.bend + of_bend / total * missed, -kLearntBendMost, kLearntBendMost);
  side.edge_variance -= of_edge * of_edge / total;
  side.covariance -= of_edge * of_bend / total;
  side.bend_variance -= of_bend * of_bend / total;
}

void forget(double period_s, LearntSide& side) {
  side.edge_variance = std::min(side.edge_variance + period_s * kLearntEdgeDrift_ps,
                                kLearntEdgeSpread * kLearntEdgeSpread);
  side.bend_variance = std::min(side.bend_variance + period_s * kLearntBendDrift_ps,
                                kLearntBendSpread * kLearntBendSpread);
}

/// The low-passes to the side that is asked for, positive.
LearntSeen along(const LearntSeen& seen, double way) {
  return {{way * seen.asked.speed_mps, way * seen.asked.opening},
          way * seen.opening,
          way * seen.speed_mps};
}

/// Motion that may be the valve's doing, whatever presses on the drive.
bool is_plain(const LearntSeen& seen) {
  const double asked_mps = seen.asked.speed_mps;
  return asked_mps >= kLearntLeastSpeed_mps && seen.asked.opening >= kLearntLeastOpening &&
         seen.opening >= 0.0 && seen.speed_mps * kLearntMostRatio >= asked_mps &&
         seen.speed_mps <= kLearntMostRatio * asked_mps;
}

/// Motion that is the valve's doing where nothing presses.
bool is_motion(const LearntSeen& seen) {
  return std::max(seen.asked.speed_mps, seen.speed_mps) >= kLearntLeastSpeed_mps &&
         std::min(seen.asked.speed_mps, seen.speed_mps) >= kLearntCreeps_mps &&
         seen.opening >= -kLearntEdgeMost;
}

bool may_be_compared(const LearntSeen& seen, LearntFrom from) {
  return is_plain(seen) || (from == LearntFrom::kAnyMotion && is_motion(seen));
}

/// A motor that stands under a spool that should be open: its dead band ends farther out. One that
/// sets off much faster than it is asked to: it ends farther in. Later its load may drive it.
void feel_edge(const DriveRow& drive, const LearntSeen& now, double period_s, LearntValve& valve) {
  const double way = now.asked.speed_mps > 0.0 ? 1.0 : -1.0;
  LearntSide& side = way > 0.0 ? valve.extend : valve.retract;
  const double asked_mps = way * now.asked.speed_mps;
  const double speed_mps = way * valve.seen.speed_mps;
  const double still_mps = drive.watch.still_mps;
  const bool is_open = way * now.opening > opening_beyond(side, 0.0);
  const bool stands =
      is_open && asked_mps > kMotorAskedLeast * still_mps && std::abs(speed_mps) < still_mps;
  valve.unmoved_s = stands ? valve.unmoved_s + period_s : 0.0;
  valve.turning_s = std::abs(speed_mps) < still_mps ? 0.0 : valve.turning_s + period_s;
  const double step = kMotorEdgeRate_ps * period_s;
  if (valve.unmoved_s > kMotorUnmoved_s) {
    side.edge = std::min(side.edge + step, kLearntEdgeMost);
  } else if (valve.turning_s < kMotorSetsOff_s && asked_mps > 0.0 &&
             speed_mps > kLearntMostRatio * asked_mps + still_mps) {
    side.edge = std::max(side.edge - step, -kLearntEdgeMost);
  }
}

/// A cylinder that stands though its spool should be open beyond what makes its line press as hard
/// as its load: its dead band ends farther out. At that opening the profile's valve would have set
/// off; the real one has not at the one where its spool is. That is looked at as it is now: a mean
/// still has what was before the spool came round. The edge goes on no faster than the line needs
/// to show by its pressure what the spool has reached, so little is overshot.
void feel_standing(const LearntSeen& mean, const LearntSeen& now, double period_s,
                   LearntValve& valve, LearntSide& side) {
  const double asked = now.asked.opening;
  const bool is_open = std::min(now.opening, asked) > kStandingFeltOpening;
  const double asked_mps = std::min(mean.asked.speed_mps, now.asked.speed_mps);
  const bool stands = is_open && mean.asked.opening < kStandingMostClosing &&
                      asked_mps > kStandingLeastAsked_mps &&
                      std::abs(mean.speed_mps) < kStandingStill_mps;
  valve.unmoved_s = stands ? valve.unmoved_s + period_s : 0.0;
  if (stands_open(valve)) {
    const double edge =
        (now.opening - kStandingSetsOffShare * asked - side.bend * curve(asked)) / (1.0 - asked);
    const double farther =
        std::min(kStandingShare * (edge - side.edge), kStandingRate_ps * period_s);
    side.edge = std::min(side.edge + std::max(0.0, farther), kLearntEdgeMost);
  }
}

/// A cylinder that stands in the air though its spool is where its dead band should have ended:
/// it ends farther out. What moves at 1 mm/s or more is compared; this has nothing to compare.
void feel_still(const LearntSeen& mean, const LearntSeen& now, double period_s, LearntValve& valve,
                LearntSide& side) {
  const double opening = std::min(mean.opening, now.opening);
  const bool stands = opening > side.edge && mean.asked.speed_mps > kStillLeastAsked_mps &&
                      now.asked.speed_mps > kStillLeastAsked_mps &&
                      std::abs(mean.speed_mps) < kStill_mps;
  valve.still_s = stands ? valve.still_s + period_s : 0.0;
  if (valve.still_s > kStillStood_s) {
    const double most = std::min(opening, kLearntEdgeMost);
    side.edge = std::max(side.edge, std::min(side.edge + kStillRate_ps * period_s, most));
  }
}

}  // namespace

const LearntSide& LearntValve::side(bool extends) const { return extends ? extend : retract; }

bool is_learnt(const DriveRow& drive) { return has_edges(drive) && drive.control.learns; }

LearntSide::LearntSide()
    : edge_variance(kLearntEdgeSpread * kLearntEdgeSpread),
      bend_variance(kLearntBendSpread * kLearntBendSpread) {}

void next_learnt(const DriveRow& drive, const ValidDrive& seen, const LearntAsk& ask,
                 LearntFrom from, double period_s, LearntValve& valve) {
  const double way_m = seen.stroke_m - valve.stroke_m;
  valve.stroke_m = seen.stroke_m;
  if (from == LearntFrom::kNothing || !is_learnt(drive) || !(period_s > 0.0)) {
    valve.late = {};
    valve.seen = {};
    valve.unmoved_s = 0.0;
    valve.still_s = 0.0;
    valve.turning_s = kMotorSetsOff_s;
    return;
  }
  const double late = share_of_newest(0.5 * drive.answer.towards(ask.speed_mps).lag_s, period_s);
  lag(ask, late, valve.late[0]);
  lag(valve.late[0], late, valve.late[1]);
  const LearntSeen now{valve.late[1], signed_opening(drive, seen.spool_ratio), way_m / period_s};
  lag(now, share_of_newest(kLearntFilter_s, period_s), valve.seen);
  if (!drive.control.has_end_stops) {
    feel_edge(drive, now, period_s, valve);
    return;
  }
  const bool extends = valve.seen.asked.speed_mps > 0.0;
  LearntSide& side = extends ? valve.extend : valve.retract;
  forget(period_s, side);
  const bool steady = std::abs(now.asked.opening - valve.seen.asked.opening) < kLearntSteady &&
                      std::abs(now.opening - valve.seen.opening) < kLearntSteady;
  const double way = extends ? 1.0 : -1.0;
  const LearntSeen mean = along(valve.seen, way);
  if (drive.spool.bypass_closes_at.is_gradual()) {
    feel_standing(mean, along(now, way), period_s, valve, side);
  } else if (from == LearntFrom::kAnyMotion) {
    feel_still(mean, along(now, way), period_s, valve, side);
  }
  if (!steady || !may_be_compared(mean, from)) {
    return;
  }
  const double steepness = drive.spool.bypass_closes_at.is_gradual() ? kLearntSteeper : 1.0;
  const double ratio = std::clamp(mean.speed_mps / mean.asked.speed_mps, 1.0 / kLearntCountedRatio,
                                  kLearntCountedRatio);
  const double share = power(ratio, 1.0 / (steepness * drive.metering.opening_exponent));
  const double by_profile = std::min(share * mean.asked.opening, 1.0);
  const double by_speed = by_profile * kLearntSpeedNoise_mps / mean.speed_mps;
  learn(mean.opening - by_profile, by_profile,
        kLearntOpeningNoise * kLearntOpeningNoise + by_speed * by_speed, drive.control.learn_share,
        side);
}

bool stands_open(const LearntValve& valve) { return valve.unmoved_s > kStandingStood_s; }

double learnt_edge_ratio(const DriveRow& drive, const LearntValve& valve, bool extends) {
  const SpoolAnswer& answer = drive.answer.side(extends);
  return duty_at(answer, valve.side(extends).edge) - answer.edge();
}

bool is_edge_known(const LearntSide& side) {
  return side.edge_variance <= 0.5 * kLearntEdgeSpread * kLearntEdgeSpread;
}

double opening_beyond(const LearntSide& side, double opening) {
  return side.edge * (1.0 - opening) + side.bend * curve(opening);
}

double opening_spread(const LearntSide& side, double opening) {
  const double by_edge = 1.0 - opening;
  const double by_bend = curve(opening);
  return std::sqrt(std::max(0.0, by_edge * by_edge * side.edge_variance +
                                     2.0 * by_edge * by_bend * side.covariance +
                                     by_bend * by_bend * side.bend_variance));
}

double learnt_duty(const DriveRow& drive, const LearntValve& valve, double opening) {
  const double wanted = std::abs(opening);
  const double real = wanted + opening_beyond(valve.side(opening > 0.0), wanted);
  const double duty = duty_at(drive.answer.towards(opening), real);
  return std::copysign(std::clamp(duty, 0.0, 1.0), opening);
}

double opening_by_profile(const LearntSide& side, double opening) {
  double by_profile = opening;
  for (int n = 0; n < kSteps; ++n) {
    by_profile = opening - opening_beyond(side, std::clamp(by_profile, 0.0, 1.0));
  }
  return by_profile;
}

}  // namespace graben
