// SPDX-License-Identifier: Apache-2.0
// Diagnosis on J1939 as a workshop's tool sees it.

#include <cmath>
#include <cstdint>
#include <vector>

#include "firmware/safety/fault_table.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/hal/j1939_ecu.hpp"

using namespace graben::test::workshop;

TEST(one_code_and_none_are_single_frames_as_before) {
  Ecu ecu;
  ecu.run(3.0);
  for (const auto& one : ecu.tool.messages) {
    assert_int_equal(one.pgn, kDm1);
    assert_int_equal(one.packets, 0);
    assert_true(one.codes().empty() && !one.red() && !one.amber());
  }
  assert_int_equal(ecu.tool.messages.size(), 3);
  ecu.activate(Fault::kStrokeMissing);
  ecu.cycle();
  const auto& said = ecu.tool.messages.back();
  assert_int_equal(said.at_us, ecu.now - kCycleUs);
  assert_int_equal(said.codes().size(), 1);
  assert_int_equal(said.codes()[0].spn, 520193);
  assert_int_equal(said.codes()[0].fmi, 9);
  assert_int_equal(said.codes()[0].count, 1);
  assert_int_equal(said.codes()[0].method, 0);
  assert_true(said.red() && !said.amber() && !said.protect());
  ecu.run(3.0);
  assert_int_equal(ecu.tool.frames, ecu.tool.messages.size());
}

TEST(several_codes_are_all_in_each_seconds_broadcast) {
  Ecu ecu;
  ecu.activate(Fault::kPressureMissing);
  ecu.run(1.0);
  ecu.activate(Fault::kSwashMissing);
  ecu.activate(Fault::kMarkDue);
  const std::size_t before = ecu.tool.messages.size();
  const TimeUs since_us = ecu.now;
  ecu.run(5.0);
  long long last_us = since_us - kSecondUs / 2;
  for (std::size_t i = before; i < ecu.tool.messages.size(); ++i) {
    const auto& said = ecu.tool.messages[i];
    const auto codes = said.codes();
    assert_int_equal(said.pgn, kDm1);
    assert_int_equal(said.packets, 2);
    assert_int_equal(codes.size(), 3);
    // What stops before what slows before what is only said.
    assert_int_equal(codes[0].spn, 520192U + static_cast<unsigned>(Fault::kSwashMissing));
    assert_int_equal(codes[1].spn, 520192U + static_cast<unsigned>(Fault::kPressureMissing));
    assert_int_equal(codes[2].spn, 520192U + static_cast<unsigned>(Fault::kMarkDue));
    assert_int_equal(codes[0].fmi, 9);
    assert_int_equal(codes[0].method, 0);
    assert_int_equal(codes[0].count, 1);
    assert_true(said.red() && said.amber());
    assert_true(said.at_us - last_us <= kSecondUs);
    last_us = said.at_us;
  }
  assert_int_equal(ecu.tool.messages.size() - before, 5);
  // Back to one: single frames again.
  ecu.state.active = {};
  ecu.activate(Fault::kMarkDue);
  ecu.run(3.0);
  assert_int_equal(ecu.tool.messages.back().packets, 0);
  assert_int_equal(ecu.tool.messages.back().codes().size(), 1);
}

TEST(seventeen_codes_fit_the_second) {
  Ecu ecu;
  activate_all(ecu);
  ecu.run(10.0);
  assert_int_equal(ecu.tool.messages.size(), 10);
  for (const auto& said : ecu.tool.messages) {
    assert_int_equal(said.codes().size(), 17);
    assert_int_equal(said.packets, 10);
    for (const auto& code : said.codes()) {
      assert_true(fault_row(static_cast<Fault>(code.spn - 520192U)).red_stop);
    }
  }
  assert_true(ecu.tool.messages[0].at_us - kSecondUs <= 700'000);
  assert_true(ecu.most_frames <= 1);
}

TEST(a_change_is_broadcast_at_once_or_right_after_the_one_under_way) {
  Ecu ecu;
  ecu.activate(Fault::kStrokeMissing);
  ecu.activate(Fault::kSwashMissing);
  ecu.run(0.05);
  ecu.activate(Fault::kOperatorMissing);
  ecu.run(0.4);
  assert_int_equal(ecu.tool.messages.size(), 2);
  assert_int_equal(ecu.tool.messages[0].codes().size(), 2);
  assert_int_equal(ecu.tool.messages[1].codes().size(), 3);
}

TEST(stored_codes_are_told_on_request_to_all_or_by_a_connection) {
  Ecu ecu;
  ecu.request(kDm2);
  ecu.cycle();
  assert_int_equal(ecu.tool.of(kDm2).size(), 1);
  assert_true(ecu.tool.of(kDm2)[0].codes().empty());

  ecu.store(Fault::kStrokeMissing, 3);
  ecu.store(Fault::kSwashMissing, 126);
  ecu.activate(Fault::kSwashMissing);
  ecu.request(kDm2);
  ecu.run(0.1);
  const auto one = ecu.tool.of(kDm2).back();
  // What is active is not 'previously active'; the lamp is lit for it.
  assert_int_equal(one.codes().size(), 1);
  assert_int_equal(one.codes()[0].spn, 520193);
  assert_int_equal(one.codes()[0].count, 3);
  assert_true(one.red());

  ecu.state.active = {};
  ecu.request(kDm2, 255);
  ecu.run(1.0);
  const auto two = ecu.tool.of(kDm2).back();
  assert_int_equal(two.receiver, 255);
  assert_int_equal(two.codes().size(), 2);
  assert_int_equal(two.codes()[1].count, 126);
  assert_true(ecu.acknowledged(kDm2).empty());

  // To us alone: RTS to the tool, which takes two packets at a time and loses one.
  for (int number = 1; number < 12; ++number) {
    ecu.store(static_cast<Fault>(number), 1);
  }
  ecu.request(kDm2);
  ecu.run(0.1);
  assert_int_equal(ecu.tool.controls.size(), 1);
  const auto& rts = ecu.tool.controls[0];
  assert_int_equal(rts.bytes[0], 16);
  assert_int_equal(rts.receiver, kTool);
  assert_int_equal(rts.bytes[3], 7);
  const auto clear_to_send = [&](std::uint8_t count, std::uint8_t first) {
    ecu.raw(0x1CEC0000U | kOwn << 8U | kTool, 8, {17, count, first, 0xFF, 0xFF, 0xCB, 0xFE, 0x00});
    ecu.run(0.3);
  };
  const std::size_t before = ecu.tool.of(kDm2).size();
  clear_to_send(2, 1);
  clear_to_send(0, 0xFF);
  clear_to_send(3, 3);
  clear_to_send(0xFF, 6);
  ecu.raw(0x1CEC0000U | kOwn << 8U | kTool, 8, {19, 46, 0, 7, 0xFF, 0xCB, 0xFE, 0x00});
  ecu.run(2.0);
  assert_int_equal(ecu.tool.of(kDm2).size(), before + 1);
  assert_int_equal(ecu.tool.of(kDm2).back().receiver, kTool);
  assert_int_equal(ecu.tool.of(kDm2).back().codes().size(), 11);
  assert_int_equal(ecu.tool.controls.size(), 1);
}

TEST(active_codes_are_told_on_request_too) {
  Ecu ecu;
  ecu.activate(Fault::kStrokeMissing);
  ecu.run(0.5);
  const std::size_t before = ecu.tool.of(kDm1).size();
  ecu.request(kDm1);
  ecu.cycle();
  assert_int_equal(ecu.tool.of(kDm1).size(), before + 1);
  assert_int_equal(ecu.tool.of(kDm1).back().codes().size(), 1);
}

TEST(a_receiver_that_falls_silent_ends_its_connection) {
  Ecu ecu;
  ecu.store(Fault::kStrokeMissing, 1);
  ecu.store(Fault::kSwashMissing, 1);
  ecu.request(kDm2);
  ecu.run(2.0);
  assert_int_equal(ecu.tool.controls.size(), 2);
  assert_int_equal(ecu.tool.controls[1].bytes[0], 255);
  assert_int_equal(ecu.tool.controls[1].bytes[1], 3);
  assert_int_equal(ecu.tool.controls[1].at_us - ecu.tool.controls[0].at_us, 1'250'000);
}

/// A tool that answers its RTS at once, as long as the bus lets it.
void take_all(Ecu& ecu, std::size_t controls_before) {
  if (ecu.tool.controls.size() > controls_before) {
    const auto& rts = ecu.tool.controls.back();
    ecu.raw(0x1CEC0000U | kOwn << 8U | kTool, 8,
            {17, static_cast<std::uint8_t>(rts.bytes[3]), 1, 0xFF, 0xFF, 0xCB, 0xFE, 0x00});
  }
}

/// Active are all below `count`, the first of them by turns.
void assert_room_beside(int count) {
  Ecu ecu;
  for (int number = 2; number < count; ++number) {
    ecu.activate(static_cast<Fault>(number));
  }
  for (int number = 30; number < 41; ++number) {
    ecu.store(static_cast<Fault>(number), 1);
  }
  const std::size_t controls = ecu.tool.controls.size();
  ecu.request(kDm2);
  for (int cycle = 0; cycle < 3000; ++cycle) {
    ecu.state.active.remove(Fault::kStrokeMissing);
    if (cycle / 10 % 2 == 1) {
      ecu.activate(Fault::kStrokeMissing);
    }
    const std::size_t before = std::max(controls, ecu.tool.controls.size());
    ecu.cycle();
    take_all(ecu, before);
  }
  // Each second's, and one for the code in it.
  assert_in_range(ecu.tool.of(kDm1).size(), 29, 61);
  // A tool waits 750 ms for a packet.
  assert_int_equal(ecu.tool.of(kDm2).size(), 1);
  assert_true(ecu.tool.most_gap_us <= 750'000);
}

TEST(a_code_that_comes_and_goes_does_not_fill_the_bus) {
  assert_room_beside(8);
  assert_room_beside(29);
}

TEST(a_request_that_has_to_wait_too_long_is_told_so) {
  Ecu ecu;
  for (int number = 20; number < 31; ++number) {
    ecu.store(static_cast<Fault>(number), 1);
  }
  // Another tool has the only connection, and holds it.
  ecu.request(kDm2, kOwn, 0xF7);
  ecu.run(0.1);
  ecu.request(kDm2);
  for (int cycle = 0; cycle < 200; ++cycle) {
    if (cycle % 40 == 0) {
      ecu.raw(0x1CEC0000U | kOwn << 8U | 0xF7U, 8, {17, 0, 0xFF, 0xFF, 0xFF, 0xCB, 0xFE, 0x00});
    }
    ecu.cycle();
    // A clock is never just so late.
    ecu.now += cycle % 2 == 0 ? 300 : -300;
  }
  assert_true(ecu.acknowledged(kDm2) == Acks{3});
}

TEST(what_a_broadcast_holds_up_comes_right_after_it) {
  Ecu ecu;
  for (int number = 1; number < 11; ++number) {
    ecu.activate(static_cast<Fault>(number));
  }
  ecu.run(0.05);
  ecu.state.active = {};
  ecu.run(0.55);
  assert_true(ecu.tool.messages.back().codes().empty());
  assert_false(ecu.tool.messages.back().red());
}

TEST(clearing_forgets_records_and_nothing_else) {
  Ecu ecu;
  ecu.store(Fault::kStrokeMissing, 3);
  ecu.store(Fault::kSwashMissing, 2);
  ecu.activate(Fault::kSwashMissing);
  ecu.request(kDm3);
  ecu.cycle();
  assert_true(ecu.acknowledged(kDm3) == Acks{0});
  assert_int_equal(ecu.cleared, 1);
  assert_int_equal(ecu.state.stored[static_cast<std::size_t>(Fault::kSwashMissing)], 2);
  ecu.request(kDm11);
  ecu.cycle();
  assert_true(ecu.acknowledged(kDm11) == Acks{0});
  assert_int_equal(ecu.cleared, 2);
  // It is there still, and said so.
  ecu.run(1.1);
  assert_int_equal(ecu.tool.messages.back().codes().size(), 1);
  assert_true(ecu.tool.messages.back().red());
  // To all: done, and not acknowledged.
  ecu.store(Fault::kStrokeMissing, 3);
  ecu.request(kDm3, 255);
  ecu.cycle();
  assert_int_equal(ecu.cleared, 3);
  assert_true(ecu.acknowledged(kDm3).empty());
}

TEST(nothing_is_cleared_while_armed_or_active) {
  for (const EcuMode mode : {EcuMode::kArmed, EcuMode::kActive}) {
    for (const std::uint32_t pgn : {kDm3, kDm11}) {
      Ecu ecu;
      ecu.store(Fault::kStrokeMissing, 3);
      ecu.activate(Fault::kSwashMissing);
      ecu.store(Fault::kSwashMissing, 3);
      ecu.state.mode = mode;
      ecu.request(pgn);
      ecu.request(pgn, 255);
      ecu.run(0.1);
      assert_true(ecu.acknowledged(pgn) == Acks{1});
      assert_int_equal(ecu.cleared, 0);
    }
  }
  Ecu ecu;
  ecu.store(Fault::kStrokeMissing, 3);
  ecu.can_clear = false;
  ecu.request(kDm3);
  ecu.cycle();
  assert_true(ecu.acknowledged(kDm3) == Acks{3});
  assert_int_equal(ecu.cleared, 0);
}

TEST(a_group_that_we_do_not_have_is_refused_to_one_and_never_to_all) {
  Ecu ecu;
  ecu.request(65260);
  ecu.request(65260, 255);
  ecu.run(0.1);
  assert_true(ecu.acknowledged(65260) == Acks{1});
  // What comes by itself is neither.
  ecu.request(0xFF31);
  ecu.run(0.1);
  assert_true(ecu.acknowledged(0xFF31).empty());
}

// Four bytes a parameter: SPN, what it is good for, its bytes.
TEST(parameters_of_a_freeze_frame_are_told) {
  Ecu ecu;
  ecu.request(64950, 255);
  ecu.run(1.5);
  const auto told = ecu.tool.of(64950);
  assert_int_equal(told.size(), 1);
  assert_int_equal(told[0].bytes.size(), 72);
  for (unsigned i = 0; i < 18; ++i) {
    const unsigned* four = told[0].bytes.data() + 4 * i;
    assert_int_equal(four[0] | four[1] << 8U | four[2] / 32U << 16U, 520448 + i);
    // In the expanded freeze frame (0), in no data stream (1), no test (1).
    assert_int_equal(four[2] % 8U, 6);
    assert_int_equal(four[3], i == 17 ? 1 : 2);
  }
}

TEST(the_last_faults_sample_is_told_while_the_fault_is_stored) {
  Ecu ecu;
  ecu.request(64951);
  ecu.run(0.1);
  const std::vector<unsigned> none = {0, 0, 0, 0, 0, 255, 255, 255};
  assert_true(ecu.tool.of(64951).back().bytes == none);

  ecu.store(Fault::kSwashMissing, 7);
  ecu.state.sample.fault = Fault::kSwashMissing;
  ecu.state.sample.mode = 3;
  for (unsigned i = 0; i < kSampleWords; ++i) {
    ecu.state.sample.word[i] = static_cast<std::uint16_t>(0x1000 * (i % 15) + i);
  }
  ecu.request(64951, 255);
  ecu.run(1.5);
  const auto told = ecu.tool.of(64951).back().bytes;
  assert_int_equal(told.size(), 40);
  assert_int_equal(told[0], 39);
  assert_int_equal(told[1] | told[2] << 8U | told[3] / 32U << 16U,
                   520192U + static_cast<unsigned>(Fault::kSwashMissing));
  assert_int_equal(told[3] % 32U, 9);
  assert_int_equal(told[4], 7);
  for (unsigned i = 0; i < kSampleWords; ++i) {
    assert_int_equal(told[5 + 2 * i] | told[6 + 2 * i] << 8U, 0x1000 * (i % 15) + i);
  }
  assert_int_equal(told[39], 3);

  ecu.store(Fault::kSwashMissing, 0);
  ecu.request(64951);
  ecu.run(0.1);
  assert_true(ecu.tool.of(64951).back().bytes == none);
}

TEST(a_value_that_does_not_fit_is_not_available) {
  assert_int_equal(sample_word(1.2345, 0.0001, -3.2), 44345);
  assert_int_equal(sample_word(-3.2, 0.0001, -3.2), 0);
  assert_int_equal(sample_word(64'255'000.0, 1000.0, 0.0), 64255);
  for (const double wrong : {-3.3, 3.3, 1e30, -1e30, std::nan("")}) {
    assert_int_equal(sample_word(wrong, 0.0001, -3.2), kNoWord);
  }
}
