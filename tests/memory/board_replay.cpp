// SPDX-License-Identifier: Apache-2.0
/// A board that lets the controller hear what it heard in the simulation, and looks at how much of
/// the stack it has taken. Prints "stack BYTES" and "frames SENT differing COUNT".

#include <cstdint>
#include <cstdio>

#include "tests/memory/bare_ecu.hpp"
#include "tests/memory/painted_stack.hpp"
#include "tests/memory/setup.hpp"

namespace graben::memory {
namespace {

constexpr TimeUs kPeriod_us = 10'000;

struct Place {
  int cycle = -1;
  std::size_t heard = 0;
  std::size_t said = 0;
  int sent = 0;
  int differing = 0;
} at;

/// The next frame of this cycle that was sent, or was heard; null if there is none.
const ReplayFrame* next(std::size_t& place, bool sent) {
  const Replay all = replay();
  for (; place < all.count && all.frame[place].cycle <= at.cycle; ++place) {
    if (all.frame[place].sent == sent && all.frame[place].cycle == at.cycle) {
      return &all.frame[place++];
    }
  }
  return nullptr;
}

}  // namespace

bool Board::next_cycle(TimeUs& now_us) {
  ++at.cycle;
  now_us = at.cycle * kPeriod_us;
  return at.cycle < replay().cycles;
}

bool Board::take(CanFrame& frame) {
  const ReplayFrame* heard = next(at.heard, false);
  if (heard == nullptr) {
    return false;
  }
  frame.id = heard->id;
  frame.length = heard->length;
  frame.data = heard->data;
  return true;
}

void Board::send(const CanFrame& frame) {
  const ReplayFrame* said = next(at.said, true);
  ++at.sent;
  if (said == nullptr || said->id != frame.id || said->data != frame.data) {
    ++at.differing;
  }
}

BusState Board::bus() { return BusState::kActive; }

}  // namespace graben::memory

int main() {
  using namespace graben::memory;
  volatile std::uint32_t* const top = paint_stack();
  run_image();
  std::printf("stack %d\nframes %d differing %d\n", taken_below(top), at.sent, at.differing);
  return 0;
}
