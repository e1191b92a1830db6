// SPDX-License-Identifier: Apache-2.0
// The tables of messages: ids, protection, load of the bus, what both kinds of machine share.

#include <algorithm>
#include <cstring>
#include <iterator>

#include "can_dbc/generated/dozer_dbc.hpp"
#include "can_dbc/generated/excavator_dbc.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using graben::dbc::MessageInfo;
namespace dozer = graben::dbc::dozer;
namespace excavator = graben::dbc::excavator;

struct Plan {
  double least_load;  // less would mean that messages are missing from the table
  double most_load;
  int protected_count;
};
// With the swing's messages, and as a machine without a swing drive has it.
constexpr Plan kExcavator{0.40, 0.50, 17};
constexpr Plan kWithoutSwing{0.25, 0.41, 14};
// With the messages of a tilt and of a track that curves, and without.
constexpr Plan kDozer{0.30, 0.50, 14};
constexpr Plan kWithoutTilt{0.30, 0.43, 12};

// An 8-byte frame with a 29-bit id, stuffed as badly as can be, with its inter-frame space.
constexpr double kWorstFrameBits = 160.0;
constexpr double kBitrate = 500e3;

bool is_of_every_machine(const MessageInfo& message) {
  const std::uint32_t swings[] = {excavator::SwingState::kId, excavator::SwingValveState::kId,
                                  excavator::SwingCommand::kId, excavator::TaskStatus::kId};
  return std::find(std::begin(swings), std::end(swings), message.id) == std::end(swings);
}

template <class Messages, class IsThere>
void check_load(const char* machine, const Messages& messages, const Plan& plan, IsThere is_there) {
  double bits_per_second = 0.0;
  for (const MessageInfo& message : messages) {
    bits_per_second += is_there(message) ? kWorstFrameBits * 1000.0 / message.cycle_time_ms : 0.0;
  }
  // DM1 comes up to ten times a second while faults are active.
  bits_per_second += 9 * kWorstFrameBits;
  const double load = bits_per_second / kBitrate;
  print_message("bus load of %s: %.1f %%\n", machine, 100.0 * load);
  assert_true(load < plan.most_load);
  assert_true(load > plan.least_load);
}

TEST(bus_load_is_planned) {
  const auto all = [](const MessageInfo&) { return true; };
  check_load("an excavator with a swing drive", excavator::kMessages, kExcavator, all);
  check_load("one without", excavator::kMessages, kWithoutSwing, is_of_every_machine);
  check_load("a dozer whose blade tilts, on a curve", dozer::kMessages, kDozer, all);
  check_load("a dozer", dozer::kMessages, kWithoutTilt, [](const MessageInfo& message) {
    return message.id != dozer::TiltState::kId && message.id != dozer::BodyCourse::kId;
  });
}

constexpr std::uint32_t pgn_of(const MessageInfo& message) { return (message.id >> 8U) & 0x3FFFFU; }

template <class Messages>
void check_ids(const Messages& messages) {
  for (std::size_t i = 0; i < messages.size(); ++i) {
    assert_true(messages[i].id <= 0x1FFFFFFFU);
    assert_int_equal(messages[i].length, 8);
    const std::uint32_t pgn = pgn_of(messages[i]);
    assert_true((pgn >= 0xFF00U && pgn <= 0xFFFFU) || pgn == 0xF004U || pgn == 0xFECAU);
    for (std::size_t j = 0; j < i; ++j) {
      // Whatever their priorities: a PGN means one thing only.
      assert_int_not_equal(pgn, pgn_of(messages[j]));
    }
  }
}

TEST(ids_are_j1939_addressed_and_distinct) {
  check_ids(excavator::kMessages);
  check_ids(dozer::kMessages);
}

// Whatever moves metal is protected and goes first on the bus.
template <class Messages>
void check_protection(const Messages& messages, const Plan& plan) {
  int protected_count = 0;
  for (const MessageInfo& message : messages) {
    if (!message.is_protected) {
      assert_int_equal(message.data_id, 0);
      continue;
    }
    ++protected_count;
    assert_int_equal(message.id >> 26U, 3);
    assert_int_not_equal(message.data_id, 0);
    assert_in_range(message.max_delta_counter, 1, 3);
  }
  assert_int_equal(protected_count, plan.protected_count);
}

TEST(what_moves_metal_is_protected) {
  check_protection(excavator::kMessages, kExcavator);
  check_protection(dozer::kMessages, kDozer);
}

const MessageInfo* dozer_message(const char* name) {
  for (const MessageInfo& message : dozer::kMessages) {
    if (std::strcmp(message.name, name) == 0) {
      return &message;
    }
  }
  return nullptr;
}

// Both kinds on one bus, or a tool with the wrong DBC: one name or PGN never means two messages.
// EcuMotion alone says other things of each kind, under another PGN.
TEST(kinds_share_what_they_name_alike) {
  int shared = 0;
  for (const MessageInfo& of_excavator : excavator::kMessages) {
    const MessageInfo* same_name = dozer_message(of_excavator.name);
    const bool is_shared = same_name != nullptr && std::strcmp(of_excavator.name, "EcuMotion") != 0;
    if (is_shared) {
      ++shared;
      assert_int_equal(of_excavator.id, same_name->id);
      assert_int_equal(of_excavator.cycle_time_ms, same_name->cycle_time_ms);
      assert_int_equal(of_excavator.data_id, same_name->data_id);
      assert_int_equal(of_excavator.max_delta_counter, same_name->max_delta_counter);
      assert_string_equal(of_excavator.sender, same_name->sender);
    }
    for (const MessageInfo& of_dozer : dozer::kMessages) {
      assert_int_equal(pgn_of(of_excavator) == pgn_of(of_dozer),
                       is_shared && &of_dozer == same_name);
    }
  }
  assert_int_equal(shared, 9);
}
