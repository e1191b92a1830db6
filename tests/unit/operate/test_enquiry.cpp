// SPDX-License-Identifier: Apache-2.0
// A workshop's tool and an ECU's diagnosis, each with the other's frames; and ECUs that do not keep
// to it.
#include <array>
#include <vector>

#include "app/workshop/enquiry.hpp"
#include "hal/j1939/diagnostics.hpp"
#include "hal/j1939/ids.hpp"
#include "hal/link/dm1.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using namespace graben;
using workshop::Answer;
using workshop::Enquiry;

constexpr std::uint8_t kEcu = 0x82;
constexpr TimeUs kCycleUs = 10 * kMillisecondUs;
constexpr std::array<std::uint32_t, 1> kSent = {0x18FF3182};

/// Cycles of both until the tool has its answer; the frames that the tool sent.
std::vector<CanFrame> talk(Enquiry& tool, const j1939::DiagnosticState& state,
                           double most_s = 6.0) {
  j1939::Diagnostics ecu(kEcu, kSent.data(), kSent.size());
  std::vector<CanFrame> sent;
  TimeUs now = kSecondUs;
  for (int i = 0; i < static_cast<int>(most_s * 100.0) && tool.answer() == Answer::kNone; ++i) {
    while (const auto frame = tool.due(now)) {
      sent.push_back(*frame);
      ecu.hear(*frame, now);
    }
    const j1939::DiagnosticWork work = ecu.step(state, now);
    for (std::size_t k = 0; k < work.count; ++k) {
      tool.hear(work.frame[k], now);
    }
    now += kCycleUs;
  }
  while (const auto frame = tool.due(now)) {
    sent.push_back(*frame);
  }
  return sent;
}

j1939::DiagnosticState seven_active() {
  j1939::DiagnosticState state;
  for (const int number : {1, 2, 3, 4, 5, 11, 20}) {
    state.active.add(static_cast<Fault>(number));
    state.stored[static_cast<std::size_t>(number)] = 3;
  }
  state.can_clear = true;
  return state;
}

CanFrame from_ecu(std::uint32_t pgn, const std::array<std::uint8_t, 8>& data,
                  std::uint8_t receiver = workshop::kToolAddress) {
  CanFrame frame;
  frame.id = j1939::id_of(j1939::kTransportPriority, pgn, receiver, kEcu);
  frame.length = 8;
  frame.data = data;
  return frame;
}

std::array<std::uint8_t, 8> announced(std::uint16_t size, std::uint8_t packets) {
  return {16,
          static_cast<std::uint8_t>(size),
          static_cast<std::uint8_t>(size >> 8U),
          packets,
          0xFF,
          0xCB,
          0xFE,
          0};
}

TEST(active_codes_arrive_whole) {
  Enquiry tool(j1939::kActiveCodesPgn, kEcu);
  static_cast<void>(talk(tool, seven_active()));
  assert_int_equal(tool.answer(), Answer::kMessage);
  const workshop::TroubleCodes codes = workshop::codes_in(tool.message());
  assert_int_equal(codes.code.size(), 7);
  std::uint32_t sum = 0;
  for (const workshop::TroubleCode& code : codes.code) {
    sum += code.spn - kDm1FirstSpn;
    assert_int_equal(code.occurrences, 1);  // Since power-on.
  }
  assert_int_equal(sum, 1 + 2 + 3 + 4 + 5 + 11 + 20);
}

/// Stored ones that are not active go to the tool alone, by a connection that it opens and closes.
TEST(previous_codes_arrive_by_a_connection) {
  j1939::DiagnosticState state = seven_active();
  state.active = {};
  Enquiry tool(j1939::kPreviousCodesPgn, kEcu);
  const std::vector<CanFrame> sent = talk(tool, state);
  assert_int_equal(tool.answer(), Answer::kMessage);
  const workshop::TroubleCodes codes = workshop::codes_in(tool.message());
  assert_int_equal(codes.code.size(), 7);
  assert_int_equal(codes.code[0].occurrences, 3);
  // The request, clear to send, end of message: each to the ECU.
  assert_int_equal(sent.size(), 3);
  assert_int_equal(sent[0].id, 0x18EA82F9);
  assert_int_equal(sent[1].id, 0x1CEC82F9);
  assert_int_equal(sent[1].data[0], 17);
  assert_int_equal(sent[2].data[0], 19);
}

TEST(none_is_none) {
  Enquiry tool(j1939::kPreviousCodesPgn, kEcu);
  static_cast<void>(talk(tool, {}));
  assert_int_equal(tool.answer(), Answer::kMessage);
  assert_int_equal(workshop::codes_in(tool.message()).code.size(), 0);
}

TEST(records_are_cleared_or_it_says_no) {
  j1939::DiagnosticState state = seven_active();
  Enquiry clears(j1939::kClearPreviousPgn, kEcu);
  static_cast<void>(talk(clears, state));
  assert_int_equal(clears.answer(), Answer::kDone);
  state.mode = EcuMode::kActive;
  state.can_clear = false;
  Enquiry refused(j1939::kClearActivePgn, kEcu);
  static_cast<void>(talk(refused, state));
  assert_true(refused.answer() == Answer::kRefused || refused.answer() == Answer::kNotNow);
  Enquiry unknown(0xFEEC, kEcu);
  static_cast<void>(talk(unknown, state));
  assert_int_equal(unknown.answer(), Answer::kRefused);
}

/// A connection that is not waited for is refused, so that the ECU is free for the next.
TEST(what_is_not_waited_for_is_refused) {
  Enquiry tool(j1939::kClearActivePgn, kEcu);
  static_cast<void>(tool.due(kSecondUs));
  tool.hear(from_ecu(j1939::kConnectionPgn, announced(30, 5)), kSecondUs);
  const auto frame = tool.due(kSecondUs);
  assert_true(frame.has_value());
  assert_int_equal(frame->data[0], 255);
  assert_int_equal(frame->data[5], 0xCB);
}

TEST(nobody_answers) {
  Enquiry tool(j1939::kActiveCodesPgn, 0x21);
  assert_int_equal(talk(tool, seven_active()).size(), 3);
  assert_int_equal(tool.answer(), Answer::kSilent);
}

/// A size that no list of codes has, packets that do not fit it, one that is missing, doubled or
/// late: told so, and nothing of it is used.
TEST(an_ecu_that_does_not_keep_to_it_is_not_believed) {
  struct Case {
    std::uint16_t size;
    std::uint8_t packets;
    std::vector<std::uint8_t> numbers;
    TimeUs gap_us;
    std::uint8_t last_said;
  };
  const std::vector<Case> cases = {{8, 2, {}, 0, 255},
                                   {1785, 255, {}, 0, 255},
                                   {30, 4, {}, 0, 255},
                                   {30, 5, {1, 3}, 0, 255},
                                   {30, 5, {1, 1}, 0, 255},
                                   {30, 5, {0}, 0, 255},
                                   {30, 5, {1, 2}, 1300 * kMillisecondUs, 255},
                                   {30, 5, {1, 2, 3, 4, 5}, kCycleUs, 19}};
  for (const Case& one : cases) {
    Enquiry tool(j1939::kPreviousCodesPgn, kEcu);
    TimeUs now = kSecondUs;
    std::uint8_t said = 0;
    const auto listen = [&] {
      while (const auto frame = tool.due(now)) {
        said = frame->data[0];
      }
    };
    listen();
    tool.hear(from_ecu(j1939::kConnectionPgn, announced(one.size, one.packets)), now);
    listen();
    for (const std::uint8_t number : one.numbers) {
      now += one.gap_us;
      tool.hear(from_ecu(j1939::kDataTransferPgn, {number, 1, 2, 3, 4, 5, 6, 7}), now);
      // Another's, and one for somebody else.
      tool.hear(from_ecu(j1939::kDataTransferPgn, {9, 1, 2, 3, 4, 5, 6, 7}, 0x21), now);
      if (said != 255) {
        listen();
      }
    }
    assert_int_equal(said, one.last_said);
    assert_int_equal(tool.answer(), one.last_said == 19 ? Answer::kMessage : Answer::kNone);
  }
}

/// Before it has asked, and of an ECU's codes that are not Graben's.
TEST(what_was_not_asked_for_is_no_answer) {
  Enquiry tool(j1939::kActiveCodesPgn, kEcu);
  const CanFrame single =
      from_ecu(j1939::kActiveCodesPgn, {0x54, 0xFF, 0x6E, 0, 0x05, 0x81, 0xFF, 0xFF}, 0);
  tool.hear(single, kSecondUs);
  assert_int_equal(tool.answer(), Answer::kNone);
  // DM1 comes by itself; it is listened for first.
  assert_false(tool.due(kSecondUs).has_value());
  CanFrame remote = single;
  remote.remote = true;
  tool.hear(remote, kSecondUs);
  assert_int_equal(tool.answer(), Answer::kNone);
  tool.hear(single, kSecondUs);
  assert_int_equal(tool.answer(), Answer::kMessage);
  const workshop::TroubleCodes codes = workshop::codes_in(tool.message());
  assert_int_equal(codes.code.size(), 1);
  assert_int_equal(codes.code[0].spn, 110);
  assert_int_equal(codes.code[0].failure_mode, 5);
  assert_int_equal(codes.code[0].occurrences, 1);
  assert_true(codes.red_stop && codes.amber_warning);
}
