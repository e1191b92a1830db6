// SPDX-License-Identifier: Apache-2.0
/// A board that lets the controller hear what traces say (tests/timing/counts/trace.hpp), each from
/// its start: board_trace TRACES. Prints "stack BYTES" and "cycles COUNT".

#include <algorithm>
#include <cstdio>

#include "tests/memory/bare_ecu.hpp"
#include "tests/memory/painted_stack.hpp"
#include "tests/timing/counts/trace.hpp"

namespace graben::memory {
namespace {

/// Not on the stack: a cycle is large.
timing::TraceCycle cycle;
std::FILE* file = nullptr;
std::uint32_t left = 0;
int taken = 0;
unsigned cycles = 0;
volatile std::uint32_t* painted = nullptr;  ///< From here down, since its trace began.
int stack = 0;

}  // namespace

/// What a controller takes as it is made is not of its steps: it is painted after that.
bool Board::next_cycle(TimeUs& now_us) {
  if (painted == nullptr) {
    painted = paint_stack();
  }
  if (left == 0 || !read(file, cycle)) {
    stack = std::max(stack, taken_below(painted));
    painted = nullptr;
    return false;
  }
  --left;
  taken = 0;
  now_us = cycle.now_us;
  ++cycles;
  return true;
}

bool Board::take(CanFrame& frame) {
  if (taken == cycle.frames) {
    return false;
  }
  frame = cycle.frame[static_cast<unsigned>(taken++)];
  return true;
}

void Board::send(const CanFrame& /*frame*/) {}

BusState Board::bus() {
  if (cycle.states == 0) {
    return BusState::kDown;
  }
  switch (cycle.state[0]) {
    case CanPortState::kActive:
      return BusState::kActive;
    case CanPortState::kErrorPassive:
      return BusState::kPassive;
    case CanPortState::kBusOff:
      return BusState::kOff;
    default:
      return BusState::kDown;
  }
}

}  // namespace graben::memory

int main(int count, char** words) {
  using namespace graben::memory;
  file = count == 2 ? std::fopen(words[1], "rb") : nullptr;
  if (file == nullptr) {
    std::puts("board_trace TRACES");
    return 1;
  }
  graben::timing::TraceStart start;
  while (left == 0 && read(file, start)) {
    left = start.cycles;
    run_image();
  }
  std::printf("stack %d\ncycles %u\n", stack, cycles);
  return left == 0 && std::feof(file) != 0 ? 0 : 1;
}
