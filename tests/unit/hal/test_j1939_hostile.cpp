// SPDX-License-Identifier: Apache-2.0
// Malformed and hostile requests, floods and storms: what each gets, and what it takes from others.

#include <array>
#include <cstdint>
#include <vector>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/hal/j1939_ecu.hpp"

using namespace graben::test::workshop;

// 30 kinds of requests that no honest tool sends, each as a flood of a hundred in a cycle, and what
// they get. After each the ECU answers an honest one.
TEST(malformed_and_hostile_requests_get_what_the_standards_say) {
  struct Attack {
    std::uint32_t id;
    std::uint8_t length;
    std::array<std::uint8_t, 8> data;
    bool is_answered;
  };
  constexpr std::uint32_t kToUs = 0x18EA8200U;
  constexpr std::uint32_t kToAll = 0x18EAFF00U;
  constexpr std::uint32_t kConnect = 0x1CEC8200U;
  const std::vector<Attack> attacks = {
      // Wrong lengths.
      {kToUs | kTool, 0, {}, false},
      {kToUs | kTool, 1, {0xCB}, false},
      {kToUs | kTool, 2, {0xCB, 0xFE}, false},
      {kToUs | kTool, 8, {0xEC, 0xFE, 0, 1, 2, 3, 4, 5}, true},
      {kToUs | kTool, 12, {0xEC, 0xFE, 0}, false},
      // Groups that cannot be.
      {kToUs | kTool, 3, {0xFF, 0xFF, 0xFF}, true},
      {kToUs | kTool, 3, {0xCB, 0xFE, 0x80}, true},
      {kToUs | kTool, 3, {0xCB, 0xFE, 0x01}, true},
      {kToUs | kTool, 3, {0x01, 0xEA, 0x00}, true},
      {kToUs | kTool, 3, {0x00, 0x00, 0x00}, true},
      // Of transport, acknowledgment and request themselves.
      {kToUs | kTool, 3, {0x00, 0xEC, 0x00}, true},
      {kToUs | kTool, 3, {0x00, 0xE8, 0x00}, true},
      {kToUs | kTool, 3, {0x00, 0xEA, 0x00}, true},
      // To all, to others, from nobody, from us.
      {kToAll | kTool, 3, {0xEC, 0xFE, 0x00}, false},
      {0x18EA8300U | kTool, 3, {0xEC, 0xFE, 0x00}, false},
      {kToUs | 0xFE, 3, {0xEC, 0xFE, 0x00}, false},
      {kToUs | 0xFF, 3, {0xEC, 0xFE, 0x00}, false},
      {kToUs | kOwn, 3, {0xEC, 0xFE, 0x00}, false},
      // Other priorities and pages.
      {0x00EA8200U | kTool, 3, {0xEC, 0xFE, 0x00}, true},
      {0x19EA8200U | kTool, 3, {0xEC, 0xFE, 0x00}, false},
      // Clearing without end.
      {kToUs | kTool, 3, {0xD3, 0xFE, 0x00}, true},
      {kToUs | kTool, 3, {0xCC, 0xFE, 0x00}, true},
      {kToAll | kTool, 3, {0xD3, 0xFE, 0x00}, false},
      // Storms of transport: announcements, packets, connections that are none of ours.
      {0x1CECFF00U | kTool, 8, {32, 0xFF, 0xFF, 0xFF, 0xFF, 0xCA, 0xFE, 0}, false},
      {0x1CEBFF00U | kTool, 8, {1, 2, 3, 4, 5, 6, 7, 8}, false},
      {0x1CEB8200U | kTool, 8, {1, 2, 3, 4, 5, 6, 7, 8}, false},
      {kConnect | kTool, 8, {16, 0xFF, 0xFF, 0xFF, 0xFF, 0xCA, 0xFE, 0}, false},
      {kConnect | kTool, 8, {17, 0xFF, 1, 0xFF, 0xFF, 0xCB, 0xFE, 0}, false},
      {kConnect | kTool, 8, {17, 1, 0, 0xFF, 0xFF, 0xCB, 0xFE, 0}, false},
      {kConnect | kTool, 3, {17, 1, 1}, false},
      {kConnect | kTool, 8, {255, 1, 0xFF, 0xFF, 0xFF, 0xCB, 0xFE, 0}, false},
      {kConnect | kTool, 8, {19, 9, 0, 2, 0xFF, 0xCB, 0xFE, 0}, false},
  };
  assert_true(attacks.size() >= 30);
  for (const Attack& attack : attacks) {
    Ecu ecu;
    ecu.activate(Fault::kStrokeMissing);
    ecu.state.mode = EcuMode::kFault;
    ecu.run(0.05);
    const std::size_t before = ecu.tool.of(kAck).size();
    for (int i = 0; i < 100; ++i) {
      ecu.raw(attack.id, attack.length, attack.data);
    }
    ecu.run(1.0);
    // The same one is answered once, however often it came.
    assert_int_equal(ecu.tool.of(kAck).size() - before, attack.is_answered ? 1 : 0);
    assert_true(ecu.most_frames <= DiagnosticWork::kMostFrames);
    assert_true(ecu.state.active.has(Fault::kStrokeMissing));
    const std::size_t answers = ecu.tool.of(kDm2).size();
    ecu.request(kDm2);
    ecu.run(0.05);
    assert_int_equal(ecu.tool.of(kDm2).size(), answers + 1);
  }
}

TEST(of_a_hundred_clears_a_second_five_are_answered_and_take_nothing_else) {
  Ecu ecu;
  ecu.activate(Fault::kStrokeMissing);
  ecu.activate(Fault::kSwashMissing);
  ecu.state.mode = EcuMode::kFault;
  std::size_t answered = 0;
  for (int i = 0; i < 300; ++i) {
    ecu.store(Fault::kStrokeMissing, 1);
    ecu.request(kDm11);
    ecu.cycle();
    for (const unsigned control : ecu.acknowledged(kDm11)) {
      assert_int_equal(control, 0);
      ++answered;
    }
  }
  assert_int_equal(answered, 15);
  assert_int_equal(ecu.cleared, 15);
  // DM1 comes each second beside them, and what is active stays so.
  assert_int_equal(ecu.tool.of(kDm1).size(), 3);
  assert_int_equal(ecu.tool.of(kDm1)[2].codes().size(), 2);
  assert_true(ecu.most_frames <= 2);
}

TEST(a_flood_of_many_groups_keeps_to_five_a_second) {
  Ecu ecu;
  for (int i = 0; i < 500; ++i) {
    for (std::uint32_t pgn = 0; pgn < 90; ++pgn) {
      ecu.request(0xFE00 + pgn, kOwn, static_cast<std::uint8_t>(pgn));
    }
    ecu.cycle();
  }
  assert_int_equal(ecu.tool.of(kAck).size() + ecu.tool.of(kDm2).size(), 25);
  assert_true(ecu.diagnostics.dropped() > 40'000);
  // Of the 8 that wait, those are left that somebody still waits for.
  ecu.run(5.0);
  const std::size_t late = ecu.tool.of(kAck).size() + ecu.tool.of(kDm2).size() - 25;
  print_message("answered after the flood: %zu\n", late);
  assert_true(late >= 3 && late <= 6);
}

TEST(a_flood_of_long_answers_keeps_neither_dm1_nor_others_waiting) {
  Ecu ecu;
  activate_all(ecu);
  ecu.run(0.05);
  ecu.state.active = {};
  for (int number = 1; number < 30; ++number) {
    ecu.store(static_cast<Fault>(number + 20), 1);
    if (number <= 20) {
      ecu.activate(static_cast<Fault>(number));
    }
  }
  const TimeUs begin_us = ecu.now;
  for (int i = 0; i < 1000; ++i) {
    ecu.request(kDm2, 255);
    if (i % 50 == 0) {
      ecu.request(65260, kOwn, 0x11);
    }
    ecu.cycle();
  }
  long long last_us = begin_us;
  for (const auto& said : ecu.tool.of(kDm1)) {
    assert_true(said.at_us - last_us <= 1'400'000);
    last_us = said.at_us;
  }
  assert_true(ecu.tool.of(kDm2).size() >= 6);
  assert_true(ecu.most_frames <= DiagnosticWork::kMostFrames);
}

TEST(a_long_answer_to_all_lets_dm1_come_whenever_it_is_asked_for) {
  for (int phase = 0; phase < 100; phase += 5) {
    Ecu ecu;
    for (int number = 1; number <= 40; ++number) {
      ecu.store(static_cast<Fault>(number), 1);
      if (number <= 20) {
        ecu.activate(static_cast<Fault>(number));
      }
    }
    repeat(200 + phase, [&] { ecu.cycle(); });
    // DM24, the longest, every second time.
    const std::uint32_t asked = phase % 10 == 0 ? kDm2 : 64950;
    ecu.request(asked, 255);
    ecu.run(4.0);
    assert_int_equal(ecu.tool.of(asked).size(), 1);
    const auto said = ecu.tool.of(kDm1);
    for (std::size_t i = 1; i < said.size(); ++i) {
      assert_true(said[i].at_us - said[i - 1].at_us <= 1'410'000);
    }
  }
}

TEST(a_receiver_that_asks_without_end_is_left) {
  // For the same packet, and to hold on.
  for (const std::uint8_t count : std::array<std::uint8_t, 2>{1, 0}) {
    Ecu ecu;
    ecu.store(Fault::kStrokeMissing, 1);
    ecu.store(Fault::kSwashMissing, 1);
    ecu.request(kDm2);
    ecu.run(0.05);
    int packets = 0;
    int ends = 0;
    for (int i = 0; i < 400; ++i) {
      ecu.raw(0x1CEC0000U | kOwn << 8U | kTool, 8, {17, count, 1, 0xFF, 0xFF, 0xCB, 0xFE, 0x00});
      const DiagnosticWork work = ecu.diagnostics.step(ecu.state, ecu.now);
      for (std::size_t at = 0; at < work.count; ++at) {
        const CanFrame& frame = work.frame[at];
        packets += frame.id >> 8U == 0x1CEBF9U ? 1 : 0;
        ends += frame.id >> 8U == 0x1CECF9U && frame.data[0] == 255 ? 1 : 0;
      }
      ecu.now += kCycleUs;
    }
    assert_true(packets <= 20);
    assert_int_equal(ends, 1);
  }
}

TEST(a_broadcast_is_received_whole_or_not_at_all) {
  Ecu ecu;
  activate_all(ecu);
  std::vector<CanFrame> frames;
  for (int i = 0; i < 80; ++i) {
    const DiagnosticWork work = ecu.diagnostics.step(ecu.state, ecu.now);
    frames.insert(frames.end(), work.frame.begin(), work.frame.begin() + work.count);
    ecu.now += kCycleUs;
  }
  assert_int_equal(frames.size(), 11);
  const auto received = [&](const auto& edit) {
    std::vector<CanFrame> edited = frames;
    edit(edited);
    BamReceiver receiver(kDm1, kOwn);
    std::size_t codes = 0;
    for (const CanFrame& frame : edited) {
      if (receiver.hear(frame, frame.stamp_us)) {
        codes += codes_of(receiver.message());
        graben::test::J1939Reader reader;
        reader.hear(single_code(receiver.message(), 16, kOwn, 0));
        assert_int_equal(reader.messages[0].codes().size(), 1);
        assert_true(reader.messages[0].red());
      }
    }
    return codes;
  };
  assert_int_equal(received([](auto&) {}), 17);
  for (std::size_t lost = 0; lost < 11; ++lost) {
    assert_int_equal(received([&](auto& all) { all.erase(all.begin() + lost); }), 0);
  }
  assert_int_equal(received([](auto& all) { all.insert(all.begin() + 3, all[2]); }), 0);
  assert_int_equal(received([](auto& all) { std::swap(all[4], all[5]); }), 0);
  assert_int_equal(received([](auto& all) {
                     for (std::size_t i = 6; i < all.size(); ++i) {
                       all[i].stamp_us += kSecondUs;
                     }
                   }),
                   0);
  assert_int_equal(received([](auto& all) { all[0].data[1] = 71; }), 0);
  assert_int_equal(received([](auto& all) { all[0].data[3] = 9; }), 0);
  assert_int_equal(received([](auto& all) { all[0].data[5] = 0xCB; }), 0);
  assert_int_equal(received([](auto& all) { all[5].length = 7; }), 0);
  assert_int_equal(received([](auto& all) { all[5].id ^= 1; }), 0);
}
