// SPDX-License-Identifier: Apache-2.0
// Bus profiles: what is read of one, by layout and by DBC, and that an error names its place.

#include "app/machines/bus_file.hpp"

#include "app/machines/dbc_layout.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/design/written_file.hpp"

namespace {

using namespace graben;
using test::has;
using test::refusal_of;
using test::WrittenFile;

/// A profile beside ours, which says the rest.
const std::string kHead = "bus = \"test\"\nown_frames = true\n";
const std::string kMessage =
    "[[receive]]\nmessage = \"Engine\"\nid = 0x123\nextended = false\nperiod = 0.02\n"
    "timeout = 0.06\nprotection = \"none\"\n";
const std::string kSignal =
    "[[receive.signal]]\nsignal = \"Speed\"\nstart = 8\nwidth = 16\nto = \"engine_speed\"\n"
    "scale = 0.1\nrange = [0, 250]\n";

std::string refusal(const std::string& text) {
  const WrittenFile file("bus.toml", text);
  return refusal_of([&] { static_cast<void>(machines::load_bus(file.path())); });
}

void assert_says(const std::string& text, std::initializer_list<const char*> parts) {
  const std::string error = refusal(text);
  for (const char* part : parts) {
    if (!has(error, part)) {
      fail_msg("no \"%s\" in: %s", part, error.c_str());
    }
  }
}

std::string with(std::string text, const std::string& old, const std::string& now) {
  const std::size_t at = text.find(old);
  assert_true(at != std::string::npos);
  return text.replace(at, old.size(), now);
}

void a_layout_becomes_a_row(void**) {
  const WrittenFile file("bus.toml", kHead + kMessage + kSignal);
  const machines::BusFile bus = machines::load_bus(file.path());
  assert_int_equal(bus.table.message_count, 1);
  assert_int_equal(bus.table.rule[0].id, 0x123);
  assert_false(bus.table.rule[0].extended);
  assert_int_equal(bus.table.message[0].timeout_us, 60000);
  assert_true(bus.table.message[0].slow);
  assert_int_equal(bus.table.source[0].bits.start_bit, 8);
  assert_true(bus.table.source[0].place == SourcePlace::kEngineSpeed);
  assert_near(bus.table.source[0].most, 250.0, 0.0);
  assert_true(bus.table.has_engine);
  assert_true(bus.capabilities.identity);
  assert_false(bus.capabilities.protection);
}

void errors_name_message_signal_and_line(void**) {
  const std::string whole = kHead + kMessage + kSignal;
  assert_says(with(whole, "start = 8", "start = 56"),
              {"message Engine, signal Speed", "(line 10)", "bits 56 | 16 are beyond"});
  assert_says(with(whole, "to = \"engine_speed\"", "to = \"engine\""),
              {"message Engine, signal Speed", "(line 14)", "allowed: stroke, joint_angle"});
  assert_says(with(whole, "scale = 0.1", "scale = 0"), {"signal Speed", "(line 15)", "0; allowed"});
  assert_says(with(whole, "range = [0, 250]\n", ""),
              {"message Engine, signal Speed", "(line 10)", "range: missing"});
  assert_says(with(whole, "range = [0, 250]", "range = [250, 0]"), {"(line 16)", "is above"});
  assert_says(with(whole, "timeout = 0.06", "timeout = 0.02"),
              {"message Engine", "(line 8)", "not more than its period"});
  assert_says(with(whole, "id = 0x123", "id = 0x923"), {"message Engine", "(line 5)", "0 .. 2047"});
  assert_says(with(whole, "width = 16", "width = 33"), {"signal Speed", "(line 13)", "1 .. 32"});
  assert_says(with(whole, "width = 16", "wide = 16"), {"signal Speed", "width: missing"});
  assert_says(whole + kMessage + kSignal, {"(line 17)", "its id is that of another message"});
  assert_says("bus = \"test\"\n" + kMessage + kSignal,
              {"nothing says a stroke or joint_angle", "nothing takes the boom's duty"});
}

void a_protection_needs_its_bits(void**) {
  const std::string counted = with(kHead + kMessage + kSignal, "\"none\"", "\"counter\"");
  assert_says(counted, {"message Engine", "counter.start: missing"});
  const WrittenFile file("bus.toml",
                         with(counted, "timeout", "counter = {start = 0, width = 4}\ntimeout"));
  const machines::BusFile bus = machines::load_bus(file.path());
  assert_true(bus.table.message[0].protection == TableProtection::kCounter);
  assert_int_equal(bus.table.message[0].counter.width, 4);
}

/// The shipped profile has the layout of the DBC that the simulated machine speaks.
void the_zx200_profile_fits_its_dbc(void**) {
  const machines::BusFile bus = machines::load_bus(machines::find_bus("zx200"));
  assert_string_equal(bus.speaks.c_str(), "zx200");
  assert_true(bus.capabilities.joint_angles && bus.capabilities.spool_by_pilot);
  assert_false(bus.capabilities.identity || bus.capabilities.swash_command);
  assert_int_equal(bus.capabilities.echo_cycles, 15);
  const auto dbc = machines::read_dbc(ZX200_DBC);
  const auto message = [&](std::uint32_t id) -> const machines::DbcMessage& {
    for (const machines::DbcMessage& each : dbc) {
      if (each.id == id) {
        return each;
      }
    }
    fail_msg("no message %x", id);
    return dbc.front();
  };
  int found = 0;
  for (std::size_t i = 0; i < bus.table.message_count; ++i) {
    const TableMessage& row = bus.table.message[i];
    for (std::size_t n = row.first; n < std::size_t{row.first} + row.count; ++n) {
      for (const machines::DbcSignal& signal : message(bus.table.rule[i].id).signal) {
        const BitField& bits = bus.table.source[n].bits;
        found += signal.bits.start_bit == bits.start_bit && signal.bits.width == bits.width;
      }
    }
  }
  // All but the seven errors that it takes as one.
  assert_int_equal(found, static_cast<int>(bus.table.source_count) - 1);
}

void a_dbc_gives_the_layout(void**) {
  const std::string text = "bus = \"test\"\nown_frames = true\ndbc = \"" ZX200_DBC
                           "\"\n[[receive]]\nmessage = \"MachineState\"\nperiod = 0.05\n"
                           "timeout = 0.16\nprotection = \"counter\"\ncounter = \"AliveCounter\"\n"
                           "[[receive.signal]]\nsignal = \"EngineState\"\nto = \"engine_speed\"\n"
                           "scale = 188.5\n";
  const WrittenFile file("bus.toml", text);
  const machines::BusFile bus = machines::load_bus(file.path());
  assert_int_equal(bus.table.rule[0].id, 0x18FF84E8);
  assert_int_equal(bus.table.source[0].bits.start_bit, 40);
  assert_near(bus.table.source[0].scale, 188.5, 0.0);
  assert_near(bus.table.source[0].most, 188.5, 0.0);
  assert_int_equal(bus.table.message[0].counter.start_bit, 56);
  assert_says(
      with(text, "\"EngineState\"", "\"EngineStat\""),
      {"message MachineState, signal EngineStat", "(line 10)", "did you mean 'EngineState'"});
  assert_says(with(text, "\"MachineState\"", "\"MachinState\""),
              {"(line 5)", "has no message 'MachinState'"});
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_layout_becomes_a_row),
      cmocka_unit_test(errors_name_message_signal_and_line),
      cmocka_unit_test(a_protection_needs_its_bits),
      cmocka_unit_test(the_zx200_profile_fits_its_dbc),
      cmocka_unit_test(a_dbc_gives_the_layout),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
