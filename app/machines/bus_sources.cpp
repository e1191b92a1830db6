// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/machines/bus_layout.hpp"
#include "app/machines/bus_tables.hpp"

namespace graben::machines {
namespace {

/// The core takes a signal for missing that is older (control.sensor_timeout of our profiles).
constexpr TimeUs kSlow_us = 40 * kMillisecondUs;

/// In the order of SourcePlace.
const std::vector<std::string>& source_names() {
  static const std::vector<std::string> names = {
      "stroke", "joint_angle",  "cap_pressure", "rod_pressure", "spool",      "slope",
      "swash",  "engine_speed", "condition",    "merit",        "speed_limit"};
  return names;
}

/// What a source is of; 0 where it is of the whole machine.
std::uint8_t read_index(TomlReader& reader, const std::string& key, SourcePlace place) {
  if (place == SourcePlace::kSlope) {
    return small(
        reader.choice(key + ".of", {"boom", "arm", "bucket", "body"}, "which link's slope"));
  }
  if (place == SourcePlace::kSwash) {
    return read_pump(reader, key);
  }
  return place < SourcePlace::kSlope ? read_axis(reader, key) : std::uint8_t{0};
}

/// Its range says what holds; several of one message are judged each by itself.
bool says_state(SourcePlace place) {
  return place == SourcePlace::kCondition || place == SourcePlace::kMerit;
}

bool same_place(const TableSource& a, const TableSource& b) {
  return a.place == b.place && a.index == b.index && !says_state(a.place);
}

/// The allowed values: the profile's, else the DBC's in the place's unit, else any.
void read_range(TomlReader& reader, const std::string& key, const DbcSignal& layout,
                TableSource& source) {
  if (reader.has(key + ".range") || says_state(source.place)) {
    const std::vector<double> range =
        reader.numbers(key + ".range", kAnyNumber, 2,
                       "least and most that is taken; of a condition or a merit, where it holds");
    source.least = range[0];
    source.most = range[1];
    if (source.least > source.most) {
      reader.fail(key + ".range", fmt::format("{} .. {}: the first is above the second",
                                              source.least, source.most));
    }
    return;
  }
  if (layout.least == layout.most) {
    reader.fail(key + ".range", "missing, and no DBC says one");
    return;
  }
  const double factor = source.scale / layout.scale;
  const double plus = source.offset - factor * layout.offset;
  source.least = std::min(factor * layout.least, factor * layout.most) + plus;
  source.most = std::max(factor * layout.least, factor * layout.most) + plus;
}

TableSource read_source(TomlReader& reader, const Declared& message, const std::string& key) {
  TableSource source;
  const DbcSignal layout = read_signal(reader, message, key);
  source.bits = layout.bits;
  source.place =
      static_cast<SourcePlace>(reader.choice(key + ".to", source_names(), "what the value is"));
  source.index = read_index(reader, key, source.place);
  read_scale(reader, key, layout, source.scale, source.offset);
  read_range(reader, key, layout, source);
  source.rate_ps = reader.number_or(0.0, key + ".rate", {0.0, 1e12, "1/s"},
                                    "the most that it can change in a second; 0: not judged");
  const auto special = [&](const char* which, const char* help) {
    return static_cast<std::int64_t>(
        reader.number_or(-1.0, key + which, {-1.0, 4294967295.0, ""}, help));
  };
  source.error_raw = special(".error", "raw value that says that its sensor has failed");
  source.missing_raw = special(".not_available", "raw value that says that there is none");
  return source;
}

/// The place of its node among the table's.
std::uint8_t read_node_of(TomlReader& reader, const BusTable& table, const Declared& message) {
  const std::string key = message.key + ".node";
  if (!reader.has(key)) {
    return kNoNode;
  }
  const int id = reader.integer(key, 1, kMostNodeId, "node of CANopen that sends it");
  for (std::size_t i = 0; i < table.node_count; ++i) {
    if (table.node[i].id == id && table.node[i].bus == message.bus) {
      return small(static_cast<int>(i));
    }
  }
  reader.fail(key, fmt::format("{}: there is no [[node]] of this id on its bus", id));
  return kNoNode;
}

/// Two messages of one id on one bus, or two that say the same, would take turns.
void check_received(TomlReader& reader, const BusTable& table, std::size_t message,
                    const std::string& key) {
  for (std::size_t i = 0; i < message; ++i) {
    const std::uint8_t bus = table.message[i].bus;
    const std::uint8_t own = table.message[message].bus;
    const bool apart = bus != kAnyBus && own != kAnyBus && bus != own;
    const bool alike = table.rule[i].extended == table.rule[message].extended;
    if (alike && same_message(table.rule[i].id, table.rule[message].id) && !apart) {
      reader.fail(key, "its id is that of another message, whatever its priority");
    }
  }
  const std::size_t end = std::size_t{table.message[message].first} + table.message[message].count;
  for (std::size_t n = table.message[message].first; n < end; ++n) {
    for (std::size_t before = 0; before < table.message[message].first; ++before) {
      if (same_place(table.source[before], table.source[n])) {
        reader.fail(fmt::format("{}.signal[{}]", key, n - table.message[message].first),
                    "another message has a signal for the same place");
      }
    }
  }
}

}  // namespace

void read_nodes(TomlReader& reader, const BusContext& context, BusTable& table) {
  const int count = reader.has("node") ? reader.table_count("node", 1, int{kMostTableNodes},
                                                            "nodes of CANopen that are started")
                                       : 0;
  for (int i = 0; i < count; ++i) {
    const std::string key = fmt::format("node[{}]", i);
    TableNode node;
    node.id = small(reader.integer(key + ".id", 1, kMostNodeId, "its id"));
    if (!context.interfaces.empty()) {
      node.bus = small(
          reader.choice(key + ".interface", context.interfaces, "which of `interfaces` it is on"));
    }
    node.timeout_us = static_cast<TimeUs>(std::lround(
        kMicroseconds * reader.number(key + ".heartbeat_timeout", {0.02, 1.0, "s"},
                                      "without heartbeat for longer, all it sends is missing")));
    for (std::size_t before = 0; before < table.node_count; ++before) {
      if (table.node[before].id == node.id && table.node[before].bus == node.bus) {
        reader.fail(key + ".id", fmt::format("{} is that of another node", node.id));
      }
    }
    table.node[table.node_count++] = node;
  }
}

void read_received(TomlReader& reader, const BusContext& context, BusTable& table) {
  const int count = reader.has("receive")
                        ? reader.table_count("receive", 1, int{kMostTableReceived}, "messages in")
                        : 0;
  for (int i = 0; i < count; ++i) {
    const std::string key = fmt::format("receive[{}]", i);
    const Declared declared = read_message(reader, context, key);
    TableMessage& message = table.message[table.message_count];
    MessageRule& rule = table.rule[table.message_count];
    std::uint16_t data_id = 0;
    message.bus = declared.bus;
    message.period_us = declared.period_us;
    message.protection = read_protection(reader, declared, true, message.counter, data_id);
    message.node = read_node_of(reader, table, declared);
    if (message.protection != TableProtection::kNone) {
      message.most_steps = small(
          reader.has(key + ".counter_steps")
              ? reader.integer(key + ".counter_steps", 1, 14, "that the counter may go on by; 3")
              : 3);
    }
    message.timeout_us = static_cast<TimeUs>(
        std::lround(kMicroseconds * reader.number(key + ".timeout", {0.01, 10.0, "s"},
                                                  "silent for longer, it is missing")));
    if (message.timeout_us <= message.period_us) {
      reader.fail(key + ".timeout", "not more than its period; allowed: more");
    }
    message.slow = message.timeout_us > kSlow_us;
    rule.id = declared.id;
    rule.length = small(declared.length);
    rule.extended = declared.extended;
    rule.is_protected = message.protection == TableProtection::kE2e;
    rule.e2e = {data_id, message.most_steps, (message.most_steps + 1) * message.period_us,
                message.period_us};
    message.first = small(static_cast<int>(table.source_count));
    const int signals =
        reader.table_count(key + ".signal", 1, kMostSignalsEach, "what is taken of it");
    for (int n = 0; n < signals && table.source_count < kMostTableSources; ++n) {
      TableSource source = read_source(reader, declared, fmt::format("{}.signal[{}]", key, n));
      for (std::size_t before = message.first; before < table.source_count; ++before) {
        source.adds = source.adds || same_place(table.source[before], source);
      }
      table.has_engine = table.has_engine || source.place == SourcePlace::kEngineSpeed;
      table.has_slopes = table.has_slopes || source.place == SourcePlace::kSlope;
      table.has_body_slope = table.has_body_slope ||
                             (source.place == SourcePlace::kSlope && source.index == kBodySlope);
      table.source[table.source_count++] = source;
      ++message.count;
    }
    check_received(reader, table, table.message_count, key);
    ++table.message_count;
  }
}

}  // namespace graben::machines
