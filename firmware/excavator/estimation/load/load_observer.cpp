// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/estimation/load/load_observer.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "firmware/excavator/estimation/load/tuning.hpp"
#include "firmware/numeric/cube_root.hpp"

namespace graben {
namespace {

/// Height of a heap over the cube root of its volume. [-; derived: a cone with sides of 38 deg, (3
/// tan^2 / pi)^(1/3)]
constexpr double kHeap = 0.83;

double fill_kg(const ExcavatorGeometry& geometry) {
  const double length_m = geometry.bucket_length_m;
  return kBucketFill_kgpm3 * length_m * length_m * length_m;
}

/// Deviation of one reading's noise, N.
double noise_n(const ExcavatorProfile& profile, int axis) {
  const CylinderGeometry& cylinder = profile.geometry.cylinder[static_cast<unsigned>(axis)];
  return kTransducerNoise * profile.safety.pressure_rail_pa *
         std::hypot(cylinder.cap_area_m2(), cylinder.rod_area_m2());
}

void forget_load(const ExcavatorGeometry& geometry, LoadTerms& terms) {
  const double most_kg = fill_kg(geometry);
  set_term(kLoadTerm, most_kg, 4.0 * most_kg, terms);
  set_term(kOutwardTerm, 0.0, 2.0 * kLoadOutwardSd_m * most_kg, terms);
}

bool is_weighed(const ExcavatorGeometry& geometry, const LoadObserver& observer) {
  const double least_kg = kPayloadToldSd * fill_kg(geometry);
  return observer.weighed >= kPayloadReadings &&
         observer.terms.variance(kLoadTerm) < least_kg * least_kg;
}

void enter(LoadPhase phase, const ExcavatorGeometry& geometry, LoadObserver& observer) {
  const double most_kg = fill_kg(geometry);
  LoadTerms& terms = observer.terms;
  switch (phase) {
    case LoadPhase::kEmpty:
      set_term(kLoadTerm, 0.0, kEmptyPayloadSd_kg, terms);
      set_term(kOutwardTerm, 0.0, kEmptyPayloadSd_kg, terms);
      break;
    case LoadPhase::kCarries:
      forget_load(geometry, terms);
      break;
    case LoadPhase::kHangs:
      set_term(kLoadTerm, 0.0, kHangingFill * most_kg, terms);
      set_term(kOutwardTerm, 0.0, kLoadOutwardSd_m * most_kg, terms);
      break;
    case LoadPhase::kUnsaid:
      if (observer.phase.kind == StepKind::kNone) {
        set_term(kLoadTerm, 0.0, most_kg, terms);
        set_term(kOutwardTerm, 0.0, kLoadOutwardSd_m * most_kg, terms);
      }
      break;
    case LoadPhase::kDigs:  // See expect_fill().
    case LoadPhase::kPours:
      break;
  }
  if (phase == LoadPhase::kPours && is_weighed(geometry, observer)) {
    observer.last_fill_kg = std::max(0.0, terms.value[kLoadTerm]);
    observer.poured_kg += observer.last_fill_kg;
    observer.phase.heap_m =
        std::min(kHeap * cube_root(observer.poured_kg / kLooseSoil_kgpm3), kHeapMost_m);
  }
  observer.weighed = 0;
  observer.refused = 0;
  observer.cycle = 0;
  observer.filling = {};
  observer.full_phase = LoadPhase::kUnsaid;
}

void add(const LoadBalance& balance, BalanceBlock& block) {
  /// Weight of a cycle in its block's mean. [-; derived: kLoadBlock cycles weigh alike]
  constexpr double kShare = 1.0 / kLoadBlock;
  block.force_n += kShare * balance.force_n;
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    for (unsigned place = 0; place < TermRow::kCount; ++place) {
      block.row[axis].share[place] += kShare * balance.row[axis].share[place];
    }
    block.steady[axis] = std::abs(block.row[axis].share[1]) > kSteadySide;
  }
}

/// Soil that begins to slide weighs elsewhere.
bool opens(const LoadObserver& observer) {
  return observer.full_phase == LoadPhase::kCarries && observer.full.row[kBucket].share[1] < -0.5;
}

bool learns(LoadPhase phase) {
  return phase == LoadPhase::kEmpty || phase == LoadPhase::kCarries || phase == LoadPhase::kHangs;
}

/// An axis' share of the last block. One that stood has friction of either sign: it tells no more
/// of an offset than that.
SeenForce seen_of(const ExcavatorProfile& profile, int axis, const LoadObserver& observer) {
  const auto k = static_cast<unsigned>(axis);
  const BalanceBlock& block = observer.full;
  const double coulomb_n = observer.terms.value[static_cast<unsigned>(kCoulombTerm + axis)];
  const double noise = noise_n(profile, axis);
  const double off_n = kLeverOff * block.force_n[axis];
  return {block.row[k], block.force_n[axis],
          kBlocksAlike * (noise * noise / kLoadBlock + off_n * off_n) +
              (block.steady[k] ? 0.0 : kStandingFriction * coulomb_n * coulomb_n)};
}

/// Where one axis says that something touches the bucket, none of the block is learnt.
void judge_axis(const ExcavatorProfile& profile, int axis, LoadObserver& observer) {
  if (!is_likely(axis, seen_of(profile, axis, observer), kTouchDeviations, observer.terms)) {
    observer.full_phase = LoadPhase::kUnsaid;
    ++observer.refused;
  } else if (axis == kBucket) {
    observer.refused = 0;
  }
  if (observer.refused == kPayloadRefusedMost && observer.phase.phase == LoadPhase::kCarries) {
    forget_load(profile.geometry, observer.terms);
    observer.refused = 0;
    observer.weighed = 0;
  }
}

void learn_axis(const ExcavatorProfile& profile, int axis, LoadObserver& observer) {
  const SeenForce seen = seen_of(profile, axis, observer);
  const bool steady = observer.full.steady[static_cast<unsigned>(axis)];
  if (!steady && observer.terms.variance(kOffsetTerm + axis) < seen.variance_n2) {
    return;
  }
  learn(axis, seen, observer.terms);
  observer.weighed += steady ? 1 : 0;
}

/// One axis' row of what is open in the balances.
void find_open(const ExcavatorProfile& profile, int axis, const LoadBalance& balance,
               LoadObserver& observer) {
  Eigen::Matrix3d& open_n2 = observer.gains.open_n2;
  open_n2.row(axis) = force_covariance_n2(axis, balance.row, observer.terms).transpose();
  const double side = balance.row[static_cast<unsigned>(axis)].share[1];
  const double coulomb_n = observer.terms.value[static_cast<unsigned>(kCoulombTerm + axis)];
  const double noise = kPairedNoise * noise_n(profile, axis);
  const double off_n = kLeverOff * balance.force_n[axis];
  open_n2(axis, axis) +=
      (1.0 - side * side) * coulomb_n * coulomb_n + noise * noise + off_n * off_n;
}

/// Least squares of the force over all of it. The rows are of three cycles.
void find_gains(const LoadBalance& balance, LoadGains& gains) {
  const Eigen::Matrix3d open_n2 = 0.5 * (gains.open_n2 + gains.open_n2.transpose());
  const Eigen::Matrix<double, 2, kAxisCount> weighted =
      balance.teeth.transpose() * open_n2.inverse();
  Eigen::Matrix2d told = weighted * balance.teeth;
  told.diagonal().array() += 1.0 / (kGroundForceSd_n * kGroundForceSd_n);
  const Eigen::Matrix2d left_n2 = told.inverse();
  gains.force = -left_n2 * weighted;
  gains.force_sd_n = std::sqrt(0.5 * left_n2.trace());
}

/// While it digs the bucket fills, to what was carried away last time.
void expect_fill(const ExcavatorProfile& profile, double share, LoadObserver& observer) {
  const double guess_kg = fill_kg(profile.geometry);
  const double full_kg = observer.last_fill_kg > 0.0 ? observer.last_fill_kg : guess_kg;
  const double done = observer.phase.kind == StepKind::kDig ? share : 1.0;
  set_term(kLoadTerm, done * full_kg, kFillGuessOff * guess_kg + kFillSoFarOff * done * full_kg,
           observer.terms);
  set_term(kOutwardTerm, 0.0, kFillOutwardSd_m * guess_kg, observer.terms);
}

/// What one axis tells of the last block: first each is judged, then each is learnt.
void work_on_block(const ExcavatorProfile& profile, int piece, LoadObserver& observer) {
  if (!learns(observer.full_phase) || opens(observer)) {
    return;
  }
  if (piece < kAxisCount) {
    judge_axis(profile, piece, observer);
  } else {
    learn_axis(profile, piece - kAxisCount, observer);
  }
}

/// A piece in each cycle of a block: what is learnt, then the gains that follow from it.
void work(const ExcavatorProfile& profile, const LoadBalance& balance, double share,
          LoadObserver& observer) {
  /// First piece of the gains. [-; derived: each axis has one of judging and one of learning]
  constexpr int kOpen = 2 * kAxisCount;
  const int piece = observer.cycle;
  if (piece == kOpen && observer.phase.phase == LoadPhase::kDigs) {
    expect_fill(profile, share, observer);
  }
  if (piece < kOpen) {
    work_on_block(profile, piece, observer);
  } else if (piece < kOpen + kAxisCount) {
    find_open(profile, piece - kOpen, balance, observer);
  } else {
    find_gains(balance, observer.gains);
  }
}

void tell_force(const LoadBalance& balance, LoadObserver& observer) {
  Eigen::Vector3d left_n = balance.force_n;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    left_n[axis] -= force_of(axis, balance.row[static_cast<unsigned>(axis)], observer.terms);
  }
  TipLoad& told = observer.told;
  told.known = observer.gains.force_sd_n > 0.0;
  told.force_n = observer.gains.force * left_n;
  told.force_sd_n = std::hypot(observer.gains.force_sd_n, kTipForceOff * told.force_n.norm());
}

void tell_payload(const ExcavatorProfile& profile, LoadObserver& observer) {
  const LoadPhase phase = observer.phase.phase;
  const bool known = phase == LoadPhase::kEmpty ||
                     (phase == LoadPhase::kCarries && is_weighed(profile.geometry, observer));
  TipLoad& told = observer.told;
  told.payload_known = known && observer.unseen_s < kPayloadUnseen_s;
  told.payload_kg = told.payload_known ? observer.terms.value[kLoadTerm] : 0.0;
  told.payload_sd_kg = told.payload_known ? std::sqrt(observer.terms.variance(kLoadTerm)) : 0.0;
}

/// What the bucket does now, by its pose.
void follow_phase(const ExcavatorProfile& profile, StepKind kind, double share, const TipPose& tip,
                  double elapsed_s, LoadObserver& observer) {
  const LoadPhase before = observer.phase.phase;
  next_phase(kind, share, tip, -profile.geometry.boom_foot_m.y(), elapsed_s, observer.phase);
  if (observer.phase.phase != before) {
    enter(observer.phase.phase, profile.geometry, observer);
  }
}

/// The balances of before are of another time than the next one's.
void drop_balances(LoadObserver& observer) {
  observer.begun = false;
  observer.filter = {};
  observer.cycle = 0;
  observer.filling = {};
  observer.full_phase = LoadPhase::kUnsaid;
  observer.gains = {};
  observer.told = {};
}

}  // namespace

void next_load(const ExcavatorProfile& profile, const LoadSeen& seen, StepKind kind, double share,
               const TipPose& tip, double elapsed_s, bool active, LoadObserver& observer) {
  if (observer.terms.variance(kOffsetTerm) == 0.0) {
    observer.terms = terms_unseen(profile);
    enter(LoadPhase::kUnsaid, profile.geometry, observer);
  }
  if (seen.posed) {
    follow_phase(profile, active ? kind : StepKind::kNone, share, tip, elapsed_s, observer);
  }
  if (!seen.known || !seen.force_n.allFinite()) {
    observer.unseen_s = std::min(observer.unseen_s + elapsed_s, kPayloadUnseen_s);
    drop_balances(observer);
    tell_payload(profile, observer);
    return;
  }
  observer.unseen_s = 0.0;
  LoadBalance balance;
  next_balance(profile, seen, elapsed_s, !observer.begun, observer.filter, balance);
  observer.begun = true;
  work(profile, balance, share, observer);
  add(balance, observer.filling);
  if (++observer.cycle == kLoadBlock) {
    observer.full = observer.filling;
    observer.full_phase = active ? observer.phase.phase : LoadPhase::kUnsaid;
    observer.filling = {};
    observer.cycle = 0;
  }
  tell_force(balance, observer);
  tell_payload(profile, observer);
}

}  // namespace graben
