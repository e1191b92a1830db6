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
constexpr Plan kExcavator{0.40, 0.53, 21};
constexpr Plan kWithoutSwing{0.25, 0.45, 17};
// With the messages of a tilt and of a track that curves, and without.
constexpr Plan kDozer{0.30, 0.52, 18};
constexpr Plan kWithoutTilt{0.30, 0.46, 16};
// With what is planned (README.md of can_dbc).
constexpr double kMostWithPlan = 0.55;

// An 8-byte frame with a 29-bit id, stuffed as badly as can be, with its inter-frame space.
constexpr double kWorstFrameBits = 160.0;
constexpr double kBitrate = 500e3;

bool is_of_every_machine(const MessageInfo& message) {
  const std::uint32_t swings[] = {excavator::SwingState::kId, excavator::SwingValveState::kId,
                                  excavator::SwingCommand::kId, excavator::SecondSwing::kId};
  return std::find(std::begin(swings), std::end(swings), message.id) == std::end(swings);
}

// Diagnosis, which is in no DBC, and what is not built yet, as README.md of can_dbc has both.
struct Planned {
  std::uint32_t id;
  double per_second;
  bool of_excavator;
  bool of_dozer;
  bool of_swing = false;
};
constexpr Planned kPlanned[] = {
    {0x0CFF5E84U, 50.0, false, true},  // SecondBlade
    {0x1CECFF82U, 20.0, true, true},   // TP.CM, and TP.DT in one row with it
    {0x1CEBFF82U, 0.0, true, true},    // TP.DT
    {0x18FECB82U, 0.0, true, true},    // DM2
    {0x18FDB682U, 0.0, true, true},    // DM24
    {0x18FDB782U, 0.0, true, true},    // DM25
    {0x18EA8200U, 5.0, true, true},    // Request
    {0x18E8FF82U, 5.0, true, true},    // Acknowledgement
    {0x18EEFF82U, 1.0, true, true},    // AddressClaimed
    {0x0CFF4481U, 10.0, true, true},   // AssistRequest
    {0x18FF4582U, 10.0, true, true},   // AssistStatus
};

double planned_load(bool dozer, bool swings) {
  double frames = 0.0;
  for (const Planned& planned : kPlanned) {
    frames += (dozer ? planned.of_dozer : planned.of_excavator) && (swings || !planned.of_swing)
                  ? planned.per_second
                  : 0.0;
  }
  return frames * kWorstFrameBits / kBitrate;
}

template <class Messages, class IsThere>
void check_load(const char* machine, const Messages& messages, const Plan& plan, double planned,
                IsThere is_there) {
  double bits_per_second = 0.0;
  for (const MessageInfo& message : messages) {
    bits_per_second += is_there(message) ? kWorstFrameBits * 1000.0 / message.cycle_time_ms : 0.0;
  }
  // DM1 comes up to ten times a second while faults are active.
  bits_per_second += 9 * kWorstFrameBits;
  const double load = bits_per_second / kBitrate;
  print_message("bus load of %s: %.1f %%, with what is planned %.1f %%\n", machine, 100.0 * load,
                100.0 * (load + planned));
  assert_true(load < plan.most_load);
  assert_true(load + planned < kMostWithPlan);
  assert_true(load > plan.least_load);
}

TEST(bus_load_is_planned) {
  const auto all = [](const MessageInfo&) { return true; };
  check_load("an excavator with a swing drive", excavator::kMessages, kExcavator,
             planned_load(false, true), all);
  check_load("one without", excavator::kMessages, kWithoutSwing, planned_load(false, false),
             is_of_every_machine);
  check_load("a dozer whose blade tilts, on a curve", dozer::kMessages, kDozer,
             planned_load(true, false), all);
  check_load("a dozer", dozer::kMessages, kWithoutTilt, planned_load(true, false),
             [](const MessageInfo& message) {
               return message.id != dozer::TiltState::kId && message.id != dozer::BodyCourse::kId;
             });
}

/// Below F000 the second byte is an address.
constexpr std::uint32_t pgn_of(std::uint32_t id) {
  const std::uint32_t pgn = (id >> 8U) & 0x3FFFFU;
  return (pgn & 0xFF00U) < 0xF000U ? pgn & 0x3FF00U : pgn;
}
constexpr std::uint32_t pgn_of(const MessageInfo& message) { return pgn_of(message.id); }

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

TEST(what_is_planned_has_ids_of_its_own) {
  for (const Planned& planned : kPlanned) {
    for (const Planned& other : kPlanned) {
      assert_int_equal(pgn_of(planned.id) == pgn_of(other.id), &planned == &other);
    }
    const auto is_taken = [&](const MessageInfo& message) {
      return pgn_of(message) == pgn_of(planned.id);
    };
    assert_false(std::any_of(excavator::kMessages.begin(), excavator::kMessages.end(), is_taken));
    assert_false(std::any_of(dozer::kMessages.begin(), dozer::kMessages.end(), is_taken));
  }
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
  assert_int_equal(shared, 12);
}
