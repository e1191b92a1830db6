// SPDX-License-Identifier: Apache-2.0
#include "app/scope/sim/sim_operator.hpp"

namespace graben::scope {
namespace {

/// A mode that was told so long ago counts no more.
constexpr TimeUs kStale_us = 100 * kMillisecondUs;
/// What has not armed by then does not arm.
constexpr TimeUs kArmsWithin_us = 500 * kMillisecondUs;

}  // namespace

void SimOperator::work(TimeUs now_us) {
  phase_ = Phase::kWaiting;
  since_us_ = now_us;
}

void SimOperator::hear(EcuMode mode, TimeUs now_us) {
  heard_ = mode;
  heard_us_ = now_us;
}

bool SimOperator::hears(EcuMode mode, TimeUs now_us) const {
  return heard_ == mode && now_us - heard_us_ < kStale_us;
}

void SimOperator::go_on(TimeUs now_us) {
  const TimeUs for_us = now_us - since_us_;
  if (phase_ == Phase::kWaiting && for_us >= kLetsGoFor_us && hears(EcuMode::kReady, now_us)) {
    phase_ = Phase::kEnabling;
    since_us_ = now_us;
  } else if (phase_ == Phase::kEnabling && for_us >= kTaskAfter_us &&
             hears(EcuMode::kArmed, now_us)) {
    phase_ = Phase::kWorking;
    since_us_ = now_us;
  } else if (phase_ == Phase::kEnabling && for_us >= kArmsWithin_us) {
    work(now_us);
  }
}

plant::OperatorRequest SimOperator::request(TimeUs now_us) {
  go_on(now_us);
  const bool enables = phase_ == Phase::kEnabling || phase_ == Phase::kWorking;
  const bool works = phase_ == Phase::kWorking;
  return {enables, OperatorMode::kAutomatic, works ? task_ : Task::kNone,
          works ? speed_ratio_ : 0.0};
}

}  // namespace graben::scope
