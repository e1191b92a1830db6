#pragma once
/// A message that stops coming and only slows the machine.

#include "tests/faults/trial.hpp"

namespace graben::faults {

/// So much after its last frame a message that comes every 10 or 20 ms is missing.
inline constexpr TimeUs kSilence_us = 50 * kMillisecondUs;

template <class Kind>
void slowed_by_silence(Trial<Kind>& trial, std::uint32_t id, Fault fault) {
  trial.work();
  Slowing slowing;
  slowing.since_us = trial.last_us(id);
  slowing.fault = fault;
  slowing.detect_us = kSilence_us;
  slowing.cure = [&trial, id] { trial.rig->plant.faults().set_silent(id, false); };
  trial.rig->plant.faults().set_silent(id, true);
  trial.expect_slower(slowing);
}

}  // namespace graben::faults
