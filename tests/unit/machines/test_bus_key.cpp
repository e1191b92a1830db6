// SPDX-License-Identifier: Apache-2.0
// Which bus a profile may name, and that what it lacks is lost knowingly.

#include "app/machines/bus_key.hpp"

#include "tests/unit/cmocka_cpp.hpp"

using machines::KnownBus;
using Errors = std::vector<std::string>;

const std::vector<KnownBus>& buses() {
  static const std::vector<KnownBus> all = [] {
    std::vector<KnownBus> made = {{"graben", {}}, {"mute", {}},   {"bare", {}},
                                  {"slow", {}},   {"levers", {}}, {"foreign", {}, false}};
    made[1].capabilities.spool_feedback = false;
    made[1].capabilities.valve_echo = false;
    BusCapabilities& bare = made[2].capabilities;
    bare.identity = bare.valve_echo = bare.spool_feedback = false;
    bare.swash_feedback = bare.protection = false;
    made[3].capabilities.latency_s = 0.04;
    made[4].capabilities.spool_by_pilot = true;
    made[4].capabilities.swash_command = false;
    return made;
  }();
  return all;
}

struct Read {
  BusCapabilities bus;
  Errors errors;
};

Read read(const char* text) {
  const toml::table document = toml::parse(text);
  machines::TomlReader reader(document);
  const BusCapabilities bus = machines::read_bus(reader, 0.03, buses());
  reader.refuse_unknown_keys();
  return {bus, reader.errors()};
}

void assert_refused(const char* text, const char* key, const char* why) {
  const Errors errors = read(text).errors;
  for (const std::string& error : errors) {
    if (error.find(key) != std::string::npos && error.find(why) != std::string::npos) {
      return;
    }
  }
  fail_msg("\"%s\": no error of %s with \"%s\" among %zu; first: %s", text, key, why, errors.size(),
           errors.empty() ? "" : errors.front().c_str());
}

TEST(our_own_is_the_default) {
  for (const char* text : {"", "bus = \"graben\""}) {
    const Read known = read(text);
    assert_true(known.errors.empty());
    assert_false(known.bus.lacks_any());
  }
  assert_int_equal(machines::known_buses().size(), 1);
  assert_string_equal(machines::known_buses().front().name.c_str(), "graben");
  assert_false(machines::known_buses().front().capabilities.lacks_any());
}

TEST(another_name_is_refused_with_those_that_are_known) {
  assert_refused("bus = \"canopen\"", "bus", "graben, mute, bare, slow, levers, foreign");
}

TEST(what_is_lacking_has_its_stand_in) {
  const Read mute =
      read("bus = \"mute\"\nstand_in = {spool_feedback = \"command\", valve_echo = \"motion\"}");
  assert_true(mute.errors.empty());
  assert_true(mute.bus.lacks_any());
  assert_false(mute.bus.spool_feedback);
  assert_true(mute.bus.identity);
  const Read bare = read(
      "bus = \"bare\"\n[stand_in]\nidentity = \"profile\"\nvalve_echo = \"motion\"\n"
      "spool_feedback = \"command\"\nswash_feedback = \"command\"\nprotection = \"range\"");
  assert_true(bare.errors.empty());
}

TEST(pilots_stand_in_for_spools_and_the_profile_for_a_swash) {
  const char* const levers =
      "bus = \"levers\"\nstand_in = {spool_feedback = \"pilot\", swash_command = \"profile\"}\n";
  const Read read_levers = read(levers);
  assert_true(read_levers.errors.empty());
  assert_true(read_levers.bus.lacks_any());
  assert_refused("bus = \"levers\"\nstand_in = {spool_feedback = \"command\"}",
                 "stand_in.spool_feedback", "allowed: pilot");
  assert_refused((std::string(levers) + "task = {swash_on_demand = [0.3, 1.0]}").c_str(),
                 "task.swash_on_demand", "takes no command");
}

TEST(nothing_is_lost_in_silence) {
  assert_refused("bus = \"mute\"", "stand_in.spool_feedback", "missing");
  assert_refused("bus = \"mute\"\nstand_in = {spool_feedback = \"command\"}", "stand_in.valve_echo",
                 "missing");
  assert_refused("bus = \"mute\"\nstand_in = {spool_feedback = \"hope\", valve_echo = \"motion\"}",
                 "stand_in.spool_feedback", "allowed: command");
}

TEST(a_machine_may_have_no_such_sensor) {
  const Read blind = read("sensors = {spool = false}\nstand_in = {spool_feedback = \"command\"}");
  assert_true(blind.errors.empty());
  assert_false(blind.bus.spool_feedback);
  assert_true(blind.bus.swash_feedback);
  assert_refused("sensors = {swash = false}", "stand_in.swash_feedback", "missing");
  const char* const no_pressures =
      "sensors = {pressure = false}\nstand_in = {pressures = \"worst_load\", worst_load = 0.3}";
  const Read light = read(no_pressures);
  assert_true(light.errors.empty());
  assert_false(light.bus.pressures);
  assert_near(light.bus.worst_load_ratio, 0.3, 0.0);
  assert_refused("sensors = {pressure = false}", "stand_in.pressures", "missing");
  assert_refused("stand_in = {worst_load = 0.3}", "stand_in.worst_load", "pressures are measured");
  // What the bus does not carry is not there because a sensor is.
  assert_refused("bus = \"mute\"\nsensors = {spool = true}", "stand_in.spool_feedback", "missing");
}

TEST(nothing_stands_in_for_what_is_there) {
  assert_refused("stand_in = {identity = \"profile\"}", "stand_in.identity", "carries it");
  assert_refused("stand_in = {engine = \"idle\"}", "stand_in.engine", "unknown");
}

TEST(the_dead_time_covers_the_latency) { assert_refused("bus = \"slow\"", "bus", "dead time"); }

TEST(swing_and_imus_need_our_frames) {
  assert_true(read("bus = \"foreign\"").errors.empty());
  assert_refused("bus = \"foreign\"\nvalve = {swing = {x = 1}}", "valve.swing", "no swing");
  assert_refused("bus = \"foreign\"\nimu = {x = 1}", "imu", "no IMUs");
}

TEST(what_cannot_be_made_safe_is_refused) {
  assert_refused(
      "sensors = {spool = false, pressure = false}\n"
      "stand_in = {spool_feedback = \"command\", pressures = \"worst_load\"}",
      "stand_in.pressures", "neither spools nor pressures are measured");
}
