// SPDX-License-Identifier: Apache-2.0
#include "app/runs/excavator_calm.hpp"

namespace graben::runs {

RealSpoolEdges spool_edges(const plant::ExcavatorPlantProfile& plant) {
  RealSpoolEdges edges;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    edges[i] = {plant.spool[i].extend.deadband_ratio, plant.spool[i].retract.deadband_ratio};
  }
  return edges;
}

void ExcavatorCalmCount::pause() {
  lambda_.pause();
  for (std::size_t i = 0; i < spool_.size(); ++i) {
    spool_[i].pause();
    duty_[i].pause();
  }
  jerk_.pause();
  last_.reset();
}

ExcavatorCalm ExcavatorCalmCount::figures() {
  ExcavatorCalm calm;
  calm.lambda_variation_ps = lambda_.per_s();
  for (std::size_t i = 0; i < spool_.size(); ++i) {
    calm.spool_travel_ps[i] = spool_[i].travel_ps();
    calm.spool_reversals_ps[i] = spool_[i].reversals_ps();
    calm.duty_travel_ps[i] = duty_[i].travel_ps();
    calm.duty_sign_changes_ps[i] = duty_[i].reversals_ps();
  }
  pause();
  calm.jerk_rms_mps3 = jerk_.rms_mps3();
  calm.energy = energy_;
  calm.swash_mean = count_ > 0 ? swash_sum_ / static_cast<double>(count_) : 0.0;
  return calm;
}

}  // namespace graben::runs
