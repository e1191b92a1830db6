// Check values of the CRC, and every row of the table in hal/e2e.hpp.

#include "hal/e2e.hpp"
#include "tests/unit/cmocka_cpp.hpp"

namespace {

using namespace graben;

constexpr std::uint16_t kDataId = 0x123;
constexpr TimeUs kCycleUs = 10'000;
constexpr E2eConfig kConfig{kDataId, 3, 4 * kCycleUs};

E2ePayload frame(std::uint8_t counter) {
  E2ePayload payload{};
  e2e_protect(payload, kDataId, counter);
  return payload;
}

// A receiver and its clock: each frame comes one cycle after the last.
struct Link {
  E2eState state;
  TimeUs now = 1'000'000;

  E2eCheck take(std::uint8_t counter) { return take(frame(counter)); }
  E2eCheck take(const E2ePayload& payload) {
    now += kCycleUs;
    return e2e_check(kConfig, state, payload, now);
  }
  void wait(TimeUs time_us) { now += time_us; }
};

Link synchronised_at(std::uint8_t counter) {
  Link link;
  for (unsigned back = 3; back-- > 0;) {
    (void)link.take(static_cast<std::uint8_t>((counter + kE2eCounterCount - back) % 15U));
  }
  assert_true(link.state.synchronised);
  return link;
}

void crc_check_values(void**) {
  const std::uint8_t digits[] = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};
  assert_int_equal(crc8(0xFF, digits, sizeof digits) ^ 0xFF, 0x4B);  // CRC-8 SAE J1850
  assert_int_equal(frame(0)[0], 0xCC);                               // AUTOSAR profile 11, BOTH
  assert_int_equal(frame(1)[0], 0x91);
}

void protect_keeps_data(void**) {
  E2ePayload payload{0xFF, 0xCF, 1, 2, 3, 4, 5, 6};
  e2e_protect(payload, kDataId, 14);
  const E2ePayload expected{payload[0], 0xCE, 1, 2, 3, 4, 5, 6};
  assert_memory_equal(payload.data(), expected.data(), payload.size());
}

// Hamming distance: no error of one or two bits passes.
void every_bit_is_covered(void**) {
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

void data_id_is_covered(void**) {
  for (unsigned bit = 0; bit < 16; ++bit) {
    E2ePayload masquerading{};
    e2e_protect(masquerading, static_cast<std::uint16_t>(kDataId ^ (1U << bit)), 7);
    Link link = synchronised_at(6);
    assert_int_equal(link.take(masquerading), E2eCheck::kWrongCrc);
  }
}

void third_good_frame_is_the_first_accepted(void**) {
  for (std::uint8_t start = 0; start < 15; ++start) {
    Link link;
    assert_int_equal(e2e_status(kConfig, link.state, link.now), E2eCheck::kNoNewData);
    std::uint8_t counter = start;
    assert_int_equal(link.take(counter), E2eCheck::kSynchronising);
    counter = e2e_next_counter(counter);
    assert_int_equal(link.take(counter), E2eCheck::kSynchronising);
    counter = e2e_next_counter(counter);
    assert_int_equal(link.take(counter), E2eCheck::kOk);
    for (int i = 0; i < 40; ++i) {
      counter = e2e_next_counter(counter);
      assert_int_equal(link.take(counter), E2eCheck::kOk);
    }
  }
}

void wrong_crc_breaks_the_run_of_synchronisation(void**) {
  E2ePayload bad = frame(2);
  bad[5] = 1;
  Link link;
  (void)link.take(0);
  (void)link.take(1);
  assert_int_equal(link.take(bad), E2eCheck::kWrongCrc);
  assert_int_equal(link.take(3), E2eCheck::kSynchronising);
  assert_int_equal(link.take(4), E2eCheck::kSynchronising);
  assert_int_equal(link.take(5), E2eCheck::kOk);
}

void synchronising_restarts(void**) {
  Link repeated;
  (void)repeated.take(0);
  (void)repeated.take(1);
  assert_int_equal(repeated.take(1), E2eCheck::kRepeated);
  assert_int_equal(repeated.take(2), E2eCheck::kSynchronising);
  assert_int_equal(repeated.take(3), E2eCheck::kOk);

  for (unsigned delta = 2; delta < 15; ++delta) {
    Link skipped;
    (void)skipped.take(0);
    (void)skipped.take(1);
    const auto counter = static_cast<std::uint8_t>((1 + delta) % 15);
    assert_int_equal(skipped.take(counter), E2eCheck::kWrongSequence);
    assert_int_equal(skipped.take(e2e_next_counter(counter)), E2eCheck::kSynchronising);
    assert_int_equal(skipped.take(e2e_next_counter(e2e_next_counter(counter))), E2eCheck::kOk);
  }

  Link invalid;
  (void)invalid.take(0);
  (void)invalid.take(1);
  assert_int_equal(invalid.take(15), E2eCheck::kWrongSequence);
  assert_int_equal(invalid.take(2), E2eCheck::kSynchronising);
  assert_int_equal(invalid.take(3), E2eCheck::kSynchronising);
  assert_int_equal(invalid.take(4), E2eCheck::kOk);
}

void synchronised_by_delta(void**) {
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
      assert_int_equal(link.state.synchronised, delta <= 3);
    }
  }
}

void after_a_wrong_sequence_three_are_needed(void**) {
  Link link = synchronised_at(2);
  assert_int_equal(link.take(9), E2eCheck::kWrongSequence);  // the first of three
  assert_int_equal(link.take(10), E2eCheck::kSynchronising);
  assert_int_equal(link.take(11), E2eCheck::kOk);

  Link invalid = synchronised_at(2);
  assert_int_equal(invalid.take(15), E2eCheck::kWrongSequence);
  assert_int_equal(invalid.take(3), E2eCheck::kSynchronising);
  assert_int_equal(invalid.take(4), E2eCheck::kSynchronising);
  assert_int_equal(invalid.take(5), E2eCheck::kOk);
}

void wrong_crc_keeps_synchronisation(void**) {
  Link link = synchronised_at(2);
  E2ePayload bad = frame(3);
  bad[0] ^= 1;
  assert_int_equal(link.take(bad), E2eCheck::kWrongCrc);
  assert_int_equal(link.take(4), E2eCheck::kSomeLost);
}

void silence_needs_three(void**) {
  Link just_in_time = synchronised_at(2);
  just_in_time.wait(3 * kCycleUs);  // and one more until the frame: the limit itself
  assert_int_equal(e2e_status(kConfig, just_in_time.state, just_in_time.now), E2eCheck::kOk);
  assert_int_equal(just_in_time.take(3), E2eCheck::kOk);

  Link silent = synchronised_at(2);
  silent.wait(3 * kCycleUs + 1);
  assert_int_equal(silent.take(3), E2eCheck::kSynchronising);
  assert_int_equal(silent.take(4), E2eCheck::kSynchronising);
  assert_int_equal(silent.take(5), E2eCheck::kOk);
  silent.wait(4 * kCycleUs + 1);
  assert_int_equal(e2e_status(kConfig, silent.state, silent.now), E2eCheck::kNoNewData);

  // In the middle of synchronising the run starts afresh.
  Link halting;
  (void)halting.take(0);
  (void)halting.take(1);
  halting.wait(4 * kCycleUs);
  assert_int_equal(halting.take(2), E2eCheck::kSynchronising);
  assert_int_equal(halting.take(3), E2eCheck::kSynchronising);
  assert_int_equal(halting.take(4), E2eCheck::kOk);
}

void bad_frames_alone_are_no_data(void**) {
  Link link;
  link.now = -kCycleUs;  // time 0 must not count as a good frame's
  assert_int_equal(link.take(E2ePayload{1}), E2eCheck::kWrongCrc);
  assert_int_equal(e2e_status(kConfig, link.state, link.now), E2eCheck::kNoNewData);
}

void frozen_counter_is_silence(void**) {
  Link link = synchronised_at(2);
  for (int i = 0; i < 4; ++i) {
    assert_int_equal(link.take(2), E2eCheck::kRepeated);
  }
  assert_int_equal(link.take(2), E2eCheck::kSynchronising);
  for (int i = 0; i < 100; ++i) {
    assert_false(e2e_accepted(link.take(2)));
  }
}

void clock_that_runs_back_is_no_silence(void**) {
  Link link = synchronised_at(2);
  link.wait(-1'000'000);
  assert_int_equal(link.take(3), E2eCheck::kOk);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(crc_check_values),
      cmocka_unit_test(protect_keeps_data),
      cmocka_unit_test(every_bit_is_covered),
      cmocka_unit_test(data_id_is_covered),
      cmocka_unit_test(third_good_frame_is_the_first_accepted),
      cmocka_unit_test(wrong_crc_breaks_the_run_of_synchronisation),
      cmocka_unit_test(synchronising_restarts),
      cmocka_unit_test(synchronised_by_delta),
      cmocka_unit_test(after_a_wrong_sequence_three_are_needed),
      cmocka_unit_test(wrong_crc_keeps_synchronisation),
      cmocka_unit_test(silence_needs_three),
      cmocka_unit_test(bad_frames_alone_are_no_data),
      cmocka_unit_test(frozen_counter_is_silence),
      cmocka_unit_test(clock_that_runs_back_is_no_silence),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
