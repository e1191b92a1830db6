// SPDX-License-Identifier: Apache-2.0
// A block of old, valid frames beside the live ones: the table in hal/link/e2e.hpp.

#include <algorithm>

#include "hal/link/e2e_window.hpp"
#include "tests/unit/hal/e2e_link.hpp"

using namespace graben::test;

// A block of old frames, the first of them `offset` ahead of the last live one.
struct Replay {
  unsigned offset;
  int length;
  int per_cycle;
  bool before_live;
};

struct Outcome {
  int used = 0;          // cycles that brought an old value as their newest
  int held = 0;          // cycles at whose end an old value was the newest accepted
  bool tripped = false;  // the window did, then nothing is used any more
};

Outcome play(const Replay& replay) {
  constexpr std::uint8_t kLast = 3;
  Link link = synchronised_at(kLast);
  E2eWindow window;
  Outcome outcome;
  int live = 0;
  int old = 0;
  bool brought_old = false;
  bool holds_old = false;
  const auto give = [&](bool is_old, unsigned counter) {
    E2ePayload payload{0, 0, static_cast<std::uint8_t>(is_old ? 1 : 0)};
    e2e_protect(payload, kDataId, static_cast<std::uint8_t>(counter % 15U));
    const E2eCheck check = e2e_check(kConfig, link.state, payload, link.now);
    if (check != E2eCheck::kRepeated) {
      const bool good = e2e_accepted(check) || check == E2eCheck::kSynchronising;
      e2e_note(window, good ? E2eMark::kGood : E2eMark::kSequence, link.now);
    }
    holds_old = e2e_accepted(check) ? is_old : holds_old;
    brought_old = e2e_accepted(check) ? is_old : brought_old;
  };
  const auto give_old = [&] {
    for (int i = 0; i < replay.per_cycle && old < replay.length; ++i, ++old) {
      give(true, kLast + replay.offset + static_cast<unsigned>(old));
    }
  };
  const auto give_live = [&] { give(false, kLast + 1U + static_cast<unsigned>(live++)); };
  for (int cycle = 0; cycle < 60 && !outcome.tripped; ++cycle) {
    link.now += kCycleUs;
    brought_old = false;
    if (replay.before_live) {
      give_old();
      give_live();
    } else {
      give_live();
      give_old();
    }
    outcome.tripped = !e2e_faults(window, link.now).empty();
    outcome.used += brought_old && !outcome.tripped ? 1 : 0;
    outcome.held += holds_old && !outcome.tripped ? 1 : 0;
  }
  assert_true(outcome.tripped || !holds_old);
  return outcome;
}

// Every offset, every length, all at once and interleaved, before and after the live frame.
TEST(a_replayed_block_is_used_twice_at_most) {
  for (unsigned offset = 0; offset < 15; ++offset) {
    Outcome burst;
    Outcome interleaved;
    for (int length = 1; length <= 40; ++length) {
      for (int per_cycle = 1; per_cycle <= length; ++per_cycle) {
        for (const bool before_live : {false, true}) {
          const Outcome outcome = play({offset, length, per_cycle, before_live});
          Outcome& most = per_cycle == length ? burst : interleaved;
          most.used = std::max(most.used, outcome.used);
          most.held = std::max(most.held, outcome.held);
          assert_true(outcome.tripped || length < 6);
        }
      }
    }
    print_message("offset %2u: at once used %d, held %d; interleaved used %d, held %d\n", offset,
                  burst.used, burst.held, interleaved.used, interleaved.held);
    assert_in_range(burst.used, 0, 2);
    assert_in_range(interleaved.used, 0, 2);
    assert_in_range(burst.held, 0, 3);
    assert_in_range(interleaved.held, 0, 3);
  }
}
