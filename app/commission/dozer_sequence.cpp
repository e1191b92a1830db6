// SPDX-License-Identifier: Apache-2.0
#include "app/commission/dozer_sequence.hpp"

namespace graben::commission {
namespace {

constexpr double kCycle_s = 0.01;

DozerTry blade_try(const std::array<double, kAxisCount>& duty) {
  if (duty[0] != 0.0) {
    return {TriedDrive::kLift, duty[0]};
  }
  return duty[1] != 0.0 ? DozerTry{TriedDrive::kTilt, duty[1]} : DozerTry{};
}

}  // namespace

DozerSequence::DozerSequence(const DozerOptions& options)
    : blade_(options.blade),
      lead_(options.way),
      travel_(planned_travel(options)),
      texts_(dozer_step_texts(options)) {}

void DozerSequence::resume(const std::vector<StepResult>& results) {
  blade_.resume(results);
  for (std::size_t at = blade_.at(); at < results.size() && !is_done(); ++at) {
    lead_.remember(travel_[travel_at_], results[at]);
    travel_results_.push_back(results[at]);
    ++travel_at_;
  }
}

void DozerSequence::step(double time_s, const DozerSeen& seen) {
  tried_ = {};
  if (is_done()) {
    return;
  }
  if (!blade_.is_done()) {
    blade_.step(time_s, {{seen.stroke_m[0], seen.stroke_m[1], 0.0},
                         {seen.sent_ratio[0], seen.sent_ratio[1], 0.0},
                         seen.active,
                         0.0,
                         0.0});
    tried_ = blade_try(blade_.duty());
  } else {
    lead_tracks(seen);
  }
}

void DozerSequence::lead_tracks(const DozerSeen& seen) {
  if (!seen.active) {
    was_active_ = false;
    return;
  }
  if (!was_active_) {
    was_active_ = true;
    lead_.begin(travel_[travel_at_]);
  }
  travel_s_ += kCycle_s;
  if (lead_.step(seen.position_m, seen.velocity_mps)) {
    travel_results_.push_back(lead_.result());
    was_active_ = false;
    ++travel_at_;
  }
  if (lead_.pump_ratio() != 0.0) {
    tried_ = {TriedDrive::kTracks, lead_.pump_ratio(), lead_.motor_ratio()};
  }
}

std::vector<StepResult> DozerSequence::results() const {
  std::vector<StepResult> all = blade_.results();
  all.insert(all.end(), travel_results_.begin(), travel_results_.end());
  return all;
}

}  // namespace graben::commission
