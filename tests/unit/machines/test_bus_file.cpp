// SPDX-License-Identifier: Apache-2.0
// Bus profiles: what is read of one, by layout and by DBC, and that an error names its place.

#include "app/machines/bus_file.hpp"

#include <fstream>
#include <iterator>

#include "app/machines/dbc_layout.hpp"
#include "app/machines/excavator_file.hpp"
#include "app/machines/profile_file.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/design/written_file.hpp"
#include "tests/unit/machines/written_bus.hpp"

using test::assert_says;
using test::has;
using test::kHead;
using test::kMessage;
using test::kSignal;
using test::refusal;
using test::refusal_of;
using test::with;
using test::WrittenFile;

TEST(a_layout_becomes_a_row) {
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

TEST(errors_name_message_signal_and_line) {
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
  // Of one id on another bus it is another message.
  const auto on = [](const char* name) {
    return with(kMessage, "id = 0x123", "id = 0x123\ninterface = \"" + std::string(name) + "\"");
  };
  const std::string two = kHead + "[[interface]]\nname = \"a\"\n[[interface]]\nname = \"b\"\n";
  assert_says(two + on("a") + kSignal + on("a") + kSignal, {"its id is that of another message"});
  const std::string pressure = with(kSignal, "engine_speed\"", "cap_pressure\"\nof = \"boom\"");
  assert_false(has(refusal(two + on("a") + kSignal + on("b") + pressure), "its id is that"));
  // An id of 29 bits with the same low ones is another one, received or sent.
  const std::string longer = with(kMessage, "id = 0x123\nextended = false", "id = 0x18000123");
  const std::string sent =
      "[[send]]\nmessage = \"Valve\"\nid = 0x18000123\nperiod = 0.02\n"
      "protection = \"none\"\n";
  assert_false(has(refusal(whole + longer + pressure), "its id "));
  assert_false(has(refusal(whole + sent), "its id 0x"));
  assert_says(kHead + longer + kSignal + sent, {"id 0x18000123 is that of another message"});
  assert_says("bus = \"test\"\n" + kMessage + kSignal,
              {"nothing says a stroke, joint_angle", "nothing takes the boom's duty"});
}

TEST(a_protection_needs_its_bits) {
  const std::string counted = with(kHead + kMessage + kSignal, "\"none\"", "\"counter\"");
  assert_says(counted, {"message Engine", "counter.start: missing"});
  const WrittenFile file("bus.toml",
                         with(counted, "timeout", "counter = {start = 0, width = 4}\ntimeout"));
  const machines::BusFile bus = machines::load_bus(file.path());
  assert_true(bus.table.message[0].protection == TableProtection::kCounter);
  assert_int_equal(bus.table.message[0].counter.width, 4);
}

/// The shipped profile has the layout of the DBC that the simulated machine speaks.
TEST(the_zx200_profile_fits_its_dbc) {
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

TEST(a_dbc_gives_the_layout) {
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

std::string shipped(const std::string& name) {
  std::ifstream file(machines::find_bus(name));
  return {std::istreambuf_iterator<char>(file), {}};
}
std::string zx200_text() { return shipped("zx200"); }

TEST(what_is_sent_has_bits_and_ids_of_its_own) {
  const std::string whole = zx200_text();
  assert_says(with(whole, "\"BoomDown\"\nstart = 8", "\"BoomDown\"\nstart = 7"),
              {"message PilotPressureCmd1, signal BoomDown", "signal[1]", "bits overlap"});
  assert_says(with(whole, "start = 28\nwidth = 4", "start = 56\nwidth = 4"),
              {"signal FrontSignalSwitch", "bits overlap", "the counter"});
  const std::string command = "id = 0x18FF640A\nperiod = 0.010\nprotection = ";
  assert_says(with(whole, command + "\"none\"", command + "\"e2e\"\ndata_id = 7"),
              {"signal BoomUp", "bits overlap", "the CRC"});
  assert_says(with(whole, "0x18FF660A", "0x18FF640A"),
              {"message MachineSettingCmd", "id 0x18FF640A", "another message of this file"});
  assert_says(with(whole, "0x18FF660A", "0x18FF7DE8"), {"send[1]", "another message of this file"});
  for (const char* own : {"0x0CFF3082", "0x18FF3182", "0x0CFF2781"}) {
    assert_says(with(whole, "0x18FF640A", own), {"send[0]", "a message of our own bus"});
  }
  assert_says(with(whole, "0x18FF7DE8", "0x0CFF2781"), {"receive[0]", "a message of our own bus"});
}

TEST(neutral_and_full_can_be_sent) {
  const std::string whole = zx200_text();
  const std::string first = "from = \"extend\"\nof = \"boom\"\nscale = 0.004\n";
  const auto first_as = [&](const char* now) { return with(whole, first, now); };
  assert_says(first_as("from = \"duty\"\nof = \"boom\"\nscale = 0.004\n"),
              {"signal BoomUp", "scale", "-1 is raw -250", "allowed: 0 .. 255"});
  assert_says(first_as("from = \"extend\"\nof = \"boom\"\nscale = 0.0004\n"),
              {"scale", "1 is raw 2500", "allowed: 0 .. 255"});
  assert_says(first_as("from = \"extend\"\nof = \"boom\"\nscale = 0.1\n"),
              {"one step is 0.1; allowed: at most 0.02"});
  assert_says(first_as("from = \"extend\"\nof = \"boom\"\nscale = 0.01\noffset = -0.2\n"),
              {"offset", "neutral is raw 20; allowed: 0"});
  assert_says(with(whole, "from = \"enable\"", "from = \"enable\"\nscale = -1.0"),
              {"signal FrontSignalSwitch", "1 is raw -1", "allowed: 0 .. 15"});
  assert_says(with(whole, "value = 180", "value = 256"), {"raw 256", "allowed: 0 .. 255"});
}

TEST(nothing_that_moves_is_late_unsaid) {
  const std::string whole = zx200_text();
  assert_says(with(whole, "timeout = 0.035", "timeout = 0.06"),
              {"message FrontAngle", "timeout", "allowed: 0.01 .. 0.05 s"});
  assert_says(with(whole, "timeout = 0.160", "timeout = 1.1"),
              {"message MachineState", "timeout", "allowed: 0.01 .. 1 s"});
  assert_says(with(whole, "0x18FF660A\nperiod = 0.050", "0x18FF660A\nperiod = 0.11"),
              {"message MachineSettingCmd", "period", "allowed: 0.01 .. 0.1 s"});
}

TEST(nodes_and_slopes_are_whole) {
  const std::string encoders = shipped("encoders");
  assert_says(with(encoders, "node = 2\n", "node = 9\n"),
              {"message ArmPosition", "node", "9: there is no [[node]] of this id"});
  assert_says(with(encoders, "id = 3\nheart", "id = 2\nheart"), {"2 is that of another node"});
  assert_says(with(encoders, "0x182", "0x702"),
              {"message ArmPosition", "0x702 is that of the heartbeat of node 2"});
  assert_says(with(encoders, "heartbeat_timeout = 0.250", "heartbeat_timeout = 2.0"),
              {"heartbeat_timeout", "allowed: 0.02 .. 1"});
  const std::string slopes = shipped("slopes");
  assert_says(with(slopes, "of = \"arm\"", "of = \"body\""), {"2 of 3 cylinders has a slope"});
  assert_says(with(slopes, "of = \"arm\"", "of = \"stick\""),
              {"message ArmSlope, signal Pitch", "of", "allowed: boom, arm, bucket, body"});
  assert_says(with(slopes, "not_available = 3\nrange = [0, 0]", "not_available = 3"),
              {"message BoomSlope, signal PitchMerit", "range: missing"});
}

TEST(a_side_and_a_least_can_be_sent) {
  const std::string valves = shipped("aux_valves");
  assert_says(with(valves, "start = 16\nwidth = 4", "start = 16\nwidth = 1"),
              {"message Aux0Command, signal StateCommand", "2 is raw 2", "allowed: 0 .. 1"});
  assert_says(with(valves, "start = 22\nwidth = 2", "start = 19\nwidth = 2"),
              {"signal FailSafeMode", "bits overlap"});
  assert_says(with(shipped("valve_driver"), "least = 0.3333333333333333      #", "least = 0.95 #"),
              {"message BoomCurrents, signal ExtendCurrent", "least", "allowed: 0 .. 0.9"});
}

TEST(late_angles_say_how_late) {
  const std::string slopes = shipped("slopes");
  const WrittenFile file("bus.toml", slopes);
  assert_near(machines::load_bus(file.path()).capabilities.joint_latency_s, 0.02, 0.0);
  assert_says(with(slopes, "joint_latency = 0.020", "joint_latency = 0.1"),
              {"joint_latency", "0.05"});
  assert_says(kHead + "joint_latency = 0.02\n" + kMessage + kSignal,
              {"joint_latency", "neither joint angles nor slopes"});
}

TEST(interfaces_are_counted_and_told_apart) {
  const std::string on = with(kMessage, "period", "interface = \"b\"\nperiod");
  const std::string a = "[[interface]]\nname = \"a\"\n";
  const std::string b = "[[interface]]\nname = \"b\"\n";
  const WrittenFile file("bus.toml", kHead + a + b + on + kSignal);
  const machines::BusFile bus = machines::load_bus(file.path());
  assert_int_equal(bus.table.bus_count, 2);
  assert_int_equal(bus.table.message[0].bus, 1);
  assert_says(kHead + b + b + on + kSignal, {"interface[1].name", "that of another interface"});
}

TEST(a_swash_is_of_both_pumps) {
  const auto swash = [](int pump) {
    return "[[send.signal]]\nsignal = \"Swash\"\nstart = " + std::to_string(8 * pump) +
           "\nwidth = 8\nfrom = \"swash\"\nof = \"pump" + std::to_string(pump) +
           "\"\nscale = 0.005\n";
  };
  const std::string one =
      zx200_text() +
      "[[send]]\nmessage = \"Swash\"\nid = 0x18FF670A\nperiod = 0.02\nprotection = \"none\"\n" +
      swash(1);
  const WrittenFile first("bus.toml", one);
  assert_false(machines::load_bus(first.path()).capabilities.swash_command);
  const WrittenFile second("bus.toml", one + swash(2));
  assert_true(machines::load_bus(second.path()).capabilities.swash_command);
}

/// Longer than a matcher by recursion bears.
TEST(a_key_of_any_length_is_refused) {
  assert_says(kHead + kMessage + std::string(80000, 'A') + " = 1\n" + kSignal,
              {"message Engine", "unknown"});
}

/// Of a machine on a bus of its own, which is beside it.
std::uint32_t hash_on(const std::string& bus) {
  std::ifstream shipped(machines::find_profile("excavator_22t"));
  std::string profile{std::istreambuf_iterator<char>(shipped), {}};
  for (const char* of_swash : {"swash_on_demand =", "pump_power ="}) {
    profile = with(profile, of_swash, std::string("# ") + of_swash);  // The bus takes no swash.
  }
  const WrittenFile beside("other.toml", bus);
  const WrittenFile file(
      "machine.toml",
      "bus = \"other\"\nstand_in = {identity = \"profile\", spool_feedback = \"pilot\", "
      "swash_feedback = \"command\", swash_command = \"profile\", protection = \"range\"}\n" +
          profile);
  return machines::load_excavator(file.path()).hash;
}

TEST(a_profile_of_another_bus_is_another) {
  const std::string bus = zx200_text();
  assert_true(hash_on(bus) == hash_on("# a comment\n" + bus));
  assert_true(hash_on(bus) != hash_on(with(bus, "timeout = 0.035", "timeout = 0.030")));
}

/// A profile in any folder names shipped ones, as --profile and --bus do.
TEST(shipped_files_are_found_from_anywhere) {
  const std::string like = "kind = \"excavator\"\nlike = \"excavator_22t\"\n";
  const WrittenFile alone("mine.toml", like + "[boom]\nradius = 0.5\n");
  const machines::ExcavatorMachine machine = machines::load_excavator(alone.path());
  assert_near(machine.profile.geometry.boom_length_m, 5.7, 0.0);
  assert_near(machine.profile.geometry.body.boom_radius_m, 0.5, 0.0);
  const WrittenFile put("mine.toml", like + "bus = \"zx200\"\n");
  const auto load = [](const std::filesystem::path& file) {
    static_cast<void>(machines::load_excavator(file));
  };
  assert_false(has(refusal_of([&] { load(put.path()); }), "there is no such file"));
  const WrittenFile wrong("mine.toml", like + "bus = \"zx201\"\n");
  assert_true(has(refusal_of([&] { load(wrong.path()); }), "'zx201': there is no such file"));
}
