// The table of messages: ids, protection, load of the bus.

#include "can_dbc/generated/excavator_dbc.hpp"
#include "tests/unit/cmocka_cpp.hpp"

namespace {

using graben::dbc::MessageInfo;
using graben::dbc::excavator::kMessages;

// An 8-byte frame with a 29-bit id, stuffed as badly as can be, with its inter-frame space.
constexpr double kWorstFrameBits = 160.0;
constexpr double kBitrate = 500e3;

void bus_load_is_planned(void**) {
  double bits_per_second = 0.0;
  for (const MessageInfo& message : kMessages) {
    bits_per_second += kWorstFrameBits * 1000.0 / message.cycle_time_ms;
  }
  // DM1 comes up to ten times a second while faults are active.
  bits_per_second += 9 * kWorstFrameBits;
  const double load = bits_per_second / kBitrate;
  print_message("bus load %.1f %%\n", 100.0 * load);
  assert_true(load < 0.40);
  assert_true(load > 0.25);  // less would mean that messages are missing from the table
}

void ids_are_j1939_addressed_and_distinct(void**) {
  for (std::size_t i = 0; i < kMessages.size(); ++i) {
    assert_true(kMessages[i].id <= 0x1FFFFFFFU);
    assert_int_equal(kMessages[i].length, 8);
    const std::uint32_t pgn = (kMessages[i].id >> 8U) & 0x3FFFFU;
    assert_true((pgn >= 0xFF00U && pgn <= 0xFFFFU) || pgn == 0xF004U || pgn == 0xFECAU);
    for (std::size_t j = 0; j < i; ++j) {
      // Whatever their priorities: a PGN means one thing only.
      assert_int_not_equal(pgn, (kMessages[j].id >> 8U) & 0x3FFFFU);
    }
  }
}

// Whatever moves metal is protected and goes first on the bus.
void what_moves_metal_is_protected(void**) {
  int protected_count = 0;
  for (const MessageInfo& message : kMessages) {
    if (!message.is_protected) {
      assert_int_equal(message.data_id, 0);
      continue;
    }
    ++protected_count;
    assert_int_equal(message.id >> 26U, 3);
    assert_int_not_equal(message.data_id, 0);
    assert_in_range(message.max_delta_counter, 1, 3);
  }
  assert_int_equal(protected_count, 11);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(bus_load_is_planned),
      cmocka_unit_test(ids_are_j1939_addressed_and_distinct),
      cmocka_unit_test(what_moves_metal_is_protected),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
