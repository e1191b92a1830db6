// SPDX-License-Identifier: Apache-2.0
#include "hal/link/e2e_window.hpp"

namespace graben {
namespace {

bool too_many(std::uint16_t frames) {
  int count = 0;
  for (unsigned left = frames; left != 0; left &= left - 1) {  // clears the lowest bit
    ++count;
  }
  return count >= kE2eWindowLimit;
}

void push(std::uint16_t& frames, bool wrong) {
  frames = static_cast<std::uint16_t>((static_cast<unsigned>(frames) << 1U) | (wrong ? 1U : 0U));
}

bool is_old(const E2eWindow& window, TimeUs now) {
  return now - window.last_us > kE2eWindowForget_us;
}

}  // namespace

static_assert(8 * sizeof(E2eWindow::sequence) == kE2eWindowFrames);

void e2e_note(E2eWindow& window, E2eMark mark, TimeUs now) {
  if (is_old(window, now)) {
    window = {};
  }
  push(window.sequence, mark == E2eMark::kSequence);
  push(window.corrupt, mark == E2eMark::kCorrupt || mark == E2eMark::kMasquerade);
  push(window.masquerade, mark == E2eMark::kMasquerade);
  window.last_us = now;
}

FaultSet e2e_faults(const E2eWindow& window, TimeUs now) {
  FaultSet faults;
  if (is_old(window, now)) {
    return faults;
  }
  if (too_many(window.sequence)) {
    faults.add(Fault::kMessageSequence);
  }
  if (too_many(window.masquerade)) {
    faults.add(Fault::kMessageMasquerade);
  } else if (too_many(window.corrupt)) {
    faults.add(Fault::kMessageCorrupt);
  }
  return faults;
}

}  // namespace graben
