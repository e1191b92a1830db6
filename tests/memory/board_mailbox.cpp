// SPDX-License-Identifier: Apache-2.0
/// A board as small as one can be: a timer and a CAN controller's mailboxes, as registers. What is
/// counted of an image must not be a board's.

#include "tests/memory/bare_ecu.hpp"

namespace graben::memory {
namespace {

struct Mailbox {
  std::uint32_t full;
  std::uint32_t id;
  std::uint32_t length;
  std::uint8_t data[8];
};

/// Where no board has them: the image is looked at and not run.
struct Registers {
  std::uint32_t time_us;
  std::uint32_t bus_off;
  Mailbox inbox;
  Mailbox outbox;
};

volatile Registers& registers() {
  // NOLINTNEXTLINE(performance-no-int-to-ptr): that is what a register is.
  return *reinterpret_cast<volatile Registers*>(std::uintptr_t{0x40000000});
}

constexpr std::uint32_t kPeriod_us = 10'000;

}  // namespace

bool Board::next_cycle(TimeUs& now_us) {
  const auto last_us = static_cast<std::uint32_t>(now_us);
  std::uint32_t elapsed_us = 0;
  do {
    elapsed_us = registers().time_us - last_us;
  } while (elapsed_us < kPeriod_us);
  now_us += elapsed_us;
  return true;
}

bool Board::take(CanFrame& frame) {
  volatile Mailbox& inbox = registers().inbox;
  if (inbox.full == 0U) {
    return false;
  }
  frame.id = inbox.id;
  frame.length = static_cast<std::uint8_t>(inbox.length);
  for (unsigned i = 0; i < frame.data.size(); ++i) {
    frame.data[i] = inbox.data[i];
  }
  inbox.full = 0U;
  return true;
}

void Board::send(const CanFrame& frame) {
  volatile Mailbox& outbox = registers().outbox;
  outbox.id = frame.id;
  outbox.length = frame.length;
  for (unsigned i = 0; i < frame.data.size(); ++i) {
    outbox.data[i] = frame.data[i];
  }
  outbox.full = 1U;
}

BusState Board::bus() { return registers().bus_off == 0U ? BusState::kActive : BusState::kOff; }

}  // namespace graben::memory

int main() {
  graben::memory::run_image();
  return 0;
}
