// SPDX-License-Identifier: Apache-2.0
// Check values of the CRC, and every row of the table in hal/link/e2e.hpp.

#include "hal/link/e2e.hpp"

#include "tests/unit/hal/e2e_link.hpp"

using namespace graben::test;

TEST(crc_check_values) {
  const std::uint8_t digits[] = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};
  assert_int_equal(crc8(0xFF, digits, sizeof digits) ^ 0xFF, 0x4B);  // CRC-8 SAE J1850
  assert_int_equal(frame(0)[0], 0xCC);                               // AUTOSAR profile 11, BOTH
  assert_int_equal(frame(1)[0], 0x91);
}

TEST(protect_keeps_data) {
  E2ePayload payload{0xFF, 0xCF, 1, 2, 3, 4, 5, 6};
  e2e_protect(payload, kDataId, 14);
  const E2ePayload expected{payload[0], 0xCE, 1, 2, 3, 4, 5, 6};
  assert_memory_equal(payload.data(), expected.data(), payload.size());
}

// Hamming distance: no error of one or two bits passes.
TEST(every_bit_is_covered) {
  const E2ePayload good = frame(7);
  for (unsigned first = 0; first < 64; ++first) {
    for (unsigned second = first; second < 64; ++second) {
      E2ePayload bad = good;
      bad[first / 8] = static_cast<std::uint8_t>(bad[first / 8] ^ (1U << (first % 8)));
      if (second != first) {
        bad[second / 8] = static_cast<std::uint8_t>(bad[second / 8] ^ (1U << (second % 8)));
      }
      Link link = synchronised_at(6);
      assert_int_equal(link.take(bad), E2eCheck::kWrongCrc);
    }
  }
}

TEST(data_id_is_covered) {
  for (unsigned bit = 0; bit < 16; ++bit) {
    E2ePayload masquerading{};
    e2e_protect(masquerading, static_cast<std::uint16_t>(kDataId ^ (1U << bit)), 7);
    Link link = synchronised_at(6);
    assert_int_equal(link.take(masquerading), E2eCheck::kWrongCrc);
  }
}

TEST(two_results_of_nine_are_accepted) {
  for (int result = 0; result <= static_cast<int>(E2eCheck::kTooMany); ++result) {
    const auto check = static_cast<E2eCheck>(result);
    assert_int_equal(e2e_accepted(check), check == E2eCheck::kOk || check == E2eCheck::kSomeLost);
  }
}

TEST(third_good_frame_is_the_first_accepted) {
  for (std::uint8_t start = 0; start < 15; ++start) {
    Link link;
    assert_false(link.state.synchronised);
    assert_int_equal(e2e_status(kConfig, link.state, link.now), E2eCheck::kNoNewData);
    link.expect_synchronising(start);
    auto counter = static_cast<std::uint8_t>((start + 2) % 15);
    repeat(40, [&] {
      counter = e2e_next_counter(counter);
      assert_int_equal(link.take(counter), E2eCheck::kOk);
    });
  }
}

TEST(wrong_crc_breaks_the_run_of_synchronisation) {
  E2ePayload bad = frame(2);
  bad[5] = 1;
  Link link;
  (void)link.take(0);
  (void)link.take(1);
  assert_int_equal(link.take(bad), E2eCheck::kWrongCrc);
  link.expect_synchronising(3);
}

TEST(synchronising_restarts, Link repeated) {
  (void)repeated.take(0);
  (void)repeated.take(1);
  assert_int_equal(repeated.take(1), E2eCheck::kRepeated);
  repeated.expect(2, {E2eCheck::kSynchronising, E2eCheck::kOk});

  for (unsigned delta = 2; delta < 15; ++delta) {
    Link skipped;
    (void)skipped.take(0);
    (void)skipped.take(1);
    const auto counter = static_cast<std::uint8_t>((1 + delta) % 15);
    assert_int_equal(skipped.take(counter), E2eCheck::kWrongSequence);
    skipped.expect(e2e_next_counter(counter), {E2eCheck::kSynchronising, E2eCheck::kOk});
  }

  Link invalid;
  (void)invalid.take(0);
  (void)invalid.take(1);
  assert_int_equal(invalid.take(15), E2eCheck::kWrongSequence);
  invalid.expect_synchronising(2);
}

TEST(synchronised_by_delta) {
  for (unsigned delta = 0; delta < 15; ++delta) {
    for (std::uint8_t last = 0; last < 15; ++last) {
      Link link = synchronised_at(last);
      const E2eCheck check = link.take(static_cast<std::uint8_t>((last + delta) % 15));
      const E2eCheck expected = delta == 0   ? E2eCheck::kRepeated
                                : delta == 1 ? E2eCheck::kOk
                                : delta <= 3 ? E2eCheck::kSomeLost
                                             : E2eCheck::kWrongSequence;
      assert_int_equal(check, expected);
      assert_int_equal(e2e_accepted(check), delta >= 1 && delta <= 3);
      assert_int_equal(link.state.synchronised, delta <= 3 || delta >= 13);
    }
  }
}

void assert_same(const E2eState& state, const E2eState& before) {
  assert_int_equal(state.last_counter, before.last_counter);
  assert_int_equal(state.last_crc, before.last_crc);
  assert_int_equal(state.last_good_us, before.last_good_us);
}

TEST(a_late_frame_changes_nothing) {
  for (const unsigned delta : {13U, 14U}) {
    for (std::uint8_t last = 0; last < 15; ++last) {
      Link link = synchronised_at(last);
      const E2eState before = link.state;
      assert_int_equal(link.take(static_cast<std::uint8_t>((last + delta) % 15)),
                       E2eCheck::kWrongSequence);
      assert_same(link.state, before);
      assert_int_equal(link.take(e2e_next_counter(last)), E2eCheck::kOk);
    }
  }
  // Where so many may be lost, 13 is no lateness.
  for (const std::uint8_t max_delta : {std::uint8_t{13}, std::uint8_t{14}}) {
    const E2eConfig lenient{kDataId, max_delta, 14 * kCycleUs, kCycleUs};
    Link link = synchronised_at(5);
    assert_int_equal(e2e_check(lenient, link.state, frame(3), link.now + kCycleUs),
                     E2eCheck::kSomeLost);
  }
  // While synchronising there is no lateness either.
  Link starting;
  (void)starting.take(5);
  assert_int_equal(starting.take(4), E2eCheck::kWrongSequence);
  assert_int_equal(starting.take(5), E2eCheck::kSynchronising);
}

TEST(a_pair_out_of_order_costs_one_frame) {
  Link link = synchronised_at(5);
  assert_int_equal(link.take(7), E2eCheck::kSomeLost);
  assert_int_equal(link.take(6), E2eCheck::kWrongSequence);
  assert_int_equal(link.take(8), E2eCheck::kOk);
}

TEST(the_same_counter_with_other_data_is_a_conflict) {
  Link link = synchronised_at(5);
  const E2eState before = link.state;
  assert_int_equal(link.take(other_frame(5)), E2eCheck::kConflict);
  assert_false(e2e_accepted(E2eCheck::kConflict));
  assert_true(link.state.synchronised);
  assert_int_equal(link.state.last_counter, 5);
  assert_same(link.state, before);
  assert_int_equal(link.take(5), E2eCheck::kRepeated);  // still the accepted one
  assert_int_equal(link.take(6), E2eCheck::kOk);
  assert_int_equal(link.take(6), E2eCheck::kRepeated);
  assert_int_equal(link.take(frame(5)), E2eCheck::kWrongSequence);  // late, no conflict

  Link starting;
  assert_int_equal(starting.take(other_frame(0)), E2eCheck::kSynchronising);
  assert_int_equal(starting.take(other_frame(1)), E2eCheck::kSynchronising);
  assert_int_equal(starting.take(1), E2eCheck::kConflict);
  assert_int_equal(starting.take(other_frame(1)), E2eCheck::kRepeated);
  starting.expect(2, {E2eCheck::kSynchronising, E2eCheck::kOk});

  Link again;
  (void)again.take(other_frame(0));
  (void)again.take(other_frame(1));
  assert_int_equal(again.take(1), E2eCheck::kConflict);
  again.expect(2, {E2eCheck::kSynchronising, E2eCheck::kOk});

  // After the run was broken the counter starts anywhere, there too.
  Link broken;
  (void)broken.take(1);
  (void)broken.take(E2ePayload{1});
  broken.expect_synchronising(1);
}

// Changes of one byte take the CRC through all its values, above and below the last one's.
TEST(every_other_crc_is_a_conflict) {
  for (unsigned data = 1; data < 256; ++data) {
    Link link = synchronised_at(5);
    E2ePayload other{0, 0, static_cast<std::uint8_t>(data)};
    e2e_protect(other, kDataId, 5);
    assert_int_equal(link.take(other), E2eCheck::kConflict);
  }
}

// Frames cannot come faster than they are sent, but together after a pause.
TEST(more_frames_than_cycles_are_too_many) {
  const int allowed[] = {1, 2, 3, 4, 6};  // after 0 .. 4 cycles; a frame counts 4/5 of a cycle
  for (int cycles = 0; cycles < 5; ++cycles) {
    Link link = synchronised_at(5);
    link.now += cycles * kCycleUs;
    assert_int_equal(frames_at_once(link, 6), allowed[cycles]);
    assert_int_equal(e2e_check(kConfig, link.state, other_frame(9), link.now), E2eCheck::kTooMany);
  }
  // What was too early did not count, and what repeats never does.
  Link link = synchronised_at(5);
  link.now += kCycleUs;
  (void)frames_at_once(link, 6);
  assert_int_equal(link.state.last_counter, 7);
  for (int i = 0; i < 9; ++i) {
    assert_int_equal(e2e_check(kConfig, link.state, frame(7), link.now), E2eCheck::kRepeated);
  }
  assert_int_equal(link.take(8), E2eCheck::kOk);
  // A long silence is no licence.
  Link silent = synchronised_at(5);
  silent.now += kSecondUs;
  std::uint8_t counter = 6;
  int taken = 0;
  while (taken < kFarTooMany &&
         e2e_check(kConfig, silent.state, frame(counter), silent.now) != E2eCheck::kTooMany) {
    counter = e2e_next_counter(counter);
    ++taken;
  }
  assert_int_equal(taken, 6);
  // Without a cycle time everything is in time.
  const E2eConfig timeless{kDataId, 3, 4 * kCycleUs, 0};
  Link unlimited = synchronised_at(5);
  for (std::uint8_t next = 6; next < 15; ++next) {
    assert_int_equal(e2e_check(timeless, unlimited.state, frame(next), unlimited.now),
                     E2eCheck::kOk);
  }
}

// What came before its cycle was over does not bring the next one's time forward.
TEST(a_frame_has_its_time) {
  Link link = synchronised_at(5);
  const TimeUs next_us = link.now + kCycleUs * 4 / 5;
  assert_int_equal(e2e_check(kConfig, link.state, frame(6), link.now + kMillisecondUs),
                   E2eCheck::kOk);
  assert_int_equal(e2e_check(kConfig, link.state, frame(7), next_us - 1), E2eCheck::kTooMany);
  assert_int_equal(e2e_check(kConfig, link.state, frame(7), next_us), E2eCheck::kOk);
}

// A sender whose clock is 10 % fast, frames taken every 10 ms, never comes too early for long.
TEST(a_fast_sender_is_followed) {
  Link link = synchronised_at(14);
  std::uint8_t counter = 0;
  TimeUs sent_us = link.now + 9 * kMillisecondUs;
  for (int cycle = 0; cycle < 1000; ++cycle) {
    link.now += kCycleUs;
    for (; sent_us <= link.now; sent_us += 9 * kMillisecondUs) {
      assert_int_equal(e2e_check(kConfig, link.state, frame(counter), link.now), E2eCheck::kOk);
      counter = e2e_next_counter(counter);
    }
  }
}

TEST(after_a_wrong_sequence_three_are_needed) {
  Link link = synchronised_at(2);
  assert_int_equal(link.take(9), E2eCheck::kWrongSequence);  // the first of three
  link.expect(10, {E2eCheck::kSynchronising, E2eCheck::kOk});

  Link invalid = synchronised_at(2);
  assert_int_equal(invalid.take(15), E2eCheck::kWrongSequence);
  invalid.expect_synchronising(3);
}

TEST(wrong_crc_keeps_synchronisation) {
  Link link = synchronised_at(2);
  E2ePayload bad = frame(3);
  bad[0] ^= 1;
  assert_int_equal(link.take(bad), E2eCheck::kWrongCrc);
  assert_int_equal(link.take(2), E2eCheck::kRepeated);
  assert_int_equal(link.take(4), E2eCheck::kSomeLost);
}

TEST(silence_needs_three) {
  Link just_in_time = synchronised_at(2);
  just_in_time.wait(3 * kCycleUs);  // and one more until the frame: the limit itself
  assert_int_equal(e2e_status(kConfig, just_in_time.state, just_in_time.now), E2eCheck::kOk);
  assert_int_equal(just_in_time.take(3), E2eCheck::kOk);

  Link silent = synchronised_at(2);
  silent.wait(3 * kCycleUs + 1);
  silent.expect_synchronising(3);
  silent.wait(4 * kCycleUs + 1);
  assert_int_equal(e2e_status(kConfig, silent.state, silent.now), E2eCheck::kNoNewData);

  // In the middle of synchronising the run starts afresh.
  Link halting;
  (void)halting.take(0);
  (void)halting.take(1);
  halting.wait(4 * kCycleUs);
  halting.expect_synchronising(2);
}

TEST(bad_frames_alone_are_no_data, Link link) {
  link.now = -kCycleUs;  // time 0 must not count as a good frame's
  assert_int_equal(link.take(E2ePayload{1}), E2eCheck::kWrongCrc);
  assert_int_equal(e2e_status(kConfig, link.state, link.now), E2eCheck::kNoNewData);
}

TEST(frozen_counter_is_silence) {
  Link link = synchronised_at(2);
  repeat(4, [&] { assert_int_equal(link.take(2), E2eCheck::kRepeated); });
  assert_int_equal(link.take(2), E2eCheck::kSynchronising);
  repeat(100, [&] { assert_false(e2e_accepted(link.take(2))); });
}

TEST(clock_that_runs_back_is_no_silence) {
  Link link = synchronised_at(2);
  link.wait(-1'000'000);
  assert_int_equal(link.take(3), E2eCheck::kOk);
  // Nor does it make the next frame too early.
  assert_int_equal(link.take(4), E2eCheck::kOk);
}

TEST(crc_fits_its_own_data_id) {
  assert_true(e2e_crc_fits(frame(3), kDataId));
  assert_false(e2e_crc_fits(frame(3), kDataId + 1));
  assert_int_equal(frame(0)[0], 0xCC);
  assert_int_equal(e2e_fitting_signature(frame(3)), e2e_signature(kDataId));
  assert_int_not_equal(e2e_signature(kDataId), e2e_signature(kDataId + 1));
}
