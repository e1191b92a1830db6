// SPDX-License-Identifier: Apache-2.0
#include "app/machines/bus_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/machines/axis_names.hpp"
#include "app/machines/near_word.hpp"

namespace graben::machines {
namespace {

constexpr double kMicroseconds = 1e6;
/// The core takes a signal for missing that is older (control.sensor_timeout of our profiles).
constexpr TimeUs kSlow_us = 40 * kMillisecondUs;
constexpr int kMostId11 = 0x7FF;
constexpr int kMostId29 = 0x1FFFFFFF;
constexpr int kMostSignalsEach = 16;
constexpr Range kAnyNumber{-1e12, 1e12, ""};

/// In the order of SourcePlace and SinkPlace.
const std::vector<std::string>& source_names() {
  static const std::vector<std::string> names = {"stroke",       "joint_angle", "cap_pressure",
                                                 "rod_pressure", "spool",       "swash",
                                                 "engine_speed", "condition"};
  return names;
}
const std::vector<std::string>& sink_names() {
  static const std::vector<std::string> names = {"constant", "enable",  "pilot_cut", "duty",
                                                 "extend",   "retract", "swash"};
  return names;
}

std::uint8_t small(int value) { return static_cast<std::uint8_t>(value); }

/// A message as it is declared, and its DBC's where that has one.
struct Declared {
  std::string key;
  std::string name;
  const DbcMessage* dbc = nullptr;
  std::uint32_t id = 0;
  bool extended = true;
  int length = 8;
  std::uint8_t bus = kAnyBus;
  TimeUs period_us = 0;
};

const DbcMessage* message_in(TomlReader& reader, const BusContext& context,
                             const Declared& declared) {
  std::vector<std::string> names;
  for (const DbcMessage& message : context.dbc) {
    names.push_back(message.name);
    if (message.name == declared.name) {
      return &message;
    }
  }
  if (!context.dbc_name.empty() && !reader.has(declared.key + ".id")) {
    reader.fail(declared.key + ".message",
                fmt::format("{} has no message '{}'{}", context.dbc_name, declared.name,
                            near_word_hint(declared.name, names)));
  }
  return nullptr;
}

Declared read_message(TomlReader& reader, const BusContext& context, const std::string& key) {
  Declared declared;
  declared.key = key;
  declared.name = reader.text(key + ".message", "name of the message");
  declared.dbc = message_in(reader, context, declared);
  if (declared.dbc != nullptr) {
    declared.id = declared.dbc->id;
    declared.extended = declared.dbc->extended;
    declared.length = declared.dbc->length;
  } else {
    declared.extended = reader.boolean_or(true, key + ".extended", "29-bit id; else 11 bits");
    declared.id = static_cast<std::uint32_t>(
        reader.integer(key + ".id", 0, declared.extended ? kMostId29 : kMostId11, "its id"));
    declared.length =
        reader.has(key + ".length") ? reader.integer(key + ".length", 1, 8, "data bytes") : 8;
  }
  if (declared.length < 1 || declared.length > 8) {
    reader.fail(key + ".message", fmt::format("{} bytes; allowed: 1 .. 8", declared.length));
    declared.length = 8;
  }
  if (!context.interfaces.empty()) {
    declared.bus = small(
        reader.choice(key + ".interface", context.interfaces, "which of `interfaces` it is on"));
  }
  declared.period_us = static_cast<TimeUs>(std::lround(
      kMicroseconds * reader.number(key + ".period", {0.01, 10.0, "s"}, "time between frames")));
  return declared;
}

/// Its bits, of the DBC or of the profile, with scale and offset into the DBC's unit.
DbcSignal read_layout(TomlReader& reader, const Declared& message, const std::string& key,
                      const std::string& name) {
  DbcSignal signal;
  signal.name = name;
  if (message.dbc != nullptr && !reader.has(key + ".start")) {
    std::vector<std::string> names;
    for (const DbcSignal& each : message.dbc->signal) {
      names.push_back(each.name);
      if (each.name == name) {
        signal = each;
        if (!signal.supported) {
          reader.fail(key, "multiplexed, a float, or more than 32 bits: not supported");
        }
        return signal;
      }
    }
    reader.fail(key, fmt::format("message {} has no signal '{}'{}", message.name, name,
                                 near_word_hint(name, names)));
    return signal;
  }
  signal.bits.start_bit =
      small(reader.integer(key + ".start", 0, 63, "first bit, as a DBC counts"));
  signal.bits.width = small(reader.integer(key + ".width", 1, 32, "bits"));
  signal.bits.motorola =
      reader.has(key + ".order") &&
      reader.choice(key + ".order", {"intel", "motorola"}, "byte order; intel unless told") == 1;
  signal.bits.is_signed = reader.boolean_or(false, key + ".signed", "two's complement");
  return signal;
}

void check_bits(TomlReader& reader, const Declared& message, const std::string& key,
                const BitField& bits) {
  if (bits.width > 0 && !lies_within(bits, static_cast<unsigned>(message.length))) {
    reader.fail(key, fmt::format("bits {} | {} are beyond the message's {} bytes", bits.start_bit,
                                 bits.width, message.length));
  }
}

/// Value in its place of `raw`: profile's scale and offset after the DBC's.
void read_scale(TomlReader& reader, const std::string& key, const DbcSignal& layout, double& scale,
                double& offset) {
  const double factor = reader.number_or(1.0, key + ".scale", kAnyNumber,
                                         "of the DBC's value, or of the raw one, into the SI unit "
                                         "of its place, with its sign");
  const double plus = reader.number_or(0.0, key + ".offset", kAnyNumber, "added after that");
  scale = factor * layout.scale;
  offset = factor * layout.offset + plus;
  if (scale == 0.0) {
    reader.fail(key + ".scale", "0; allowed: any other number");
    scale = 1.0;
  }
}

TableProtection read_protection(TomlReader& reader, const Declared& message, bool counts_wide,
                                BitField& counter, std::uint16_t& data_id) {
  const auto protection = static_cast<TableProtection>(
      reader.choice(message.key + ".protection", {"none", "counter", "e2e"},
                    "what tells its frames from old or foreign ones"));
  if (protection == TableProtection::kCounter) {
    const std::string key = message.key + ".counter";
    const std::string name =
        message.dbc != nullptr && !reader.has(key + ".start")
            ? reader.text(key, "the signal that goes on by one with each frame")
            : "counter";
    counter = read_layout(reader, message, key, name).bits;
    check_bits(reader, message, key, counter);
    const int most = counts_wide ? 32 : 8;
    if (counter.width < 2 || counter.width > most) {
      reader.fail(key, fmt::format("{} bits; allowed: 2 .. {}", counter.width, most));
      counter.width = 2;
    }
  } else if (protection == TableProtection::kE2e) {
    data_id = static_cast<std::uint16_t>(
        reader.integer(message.key + ".data_id", 0, 0xFFFF, "data id of profile 11"));
    if (message.length != 8) {
      reader.fail(message.key + ".protection", "e2e: only of messages of 8 bytes");
    }
  }
  return protection;
}

std::uint8_t read_index(TomlReader& reader, const std::string& key, bool pump) {
  static const std::vector<std::string> axes(kAxisNames.begin(), kAxisNames.begin() + kAxisCount);
  return small(pump ? reader.choice(key + ".of", {"pump1", "pump2"}, "which pump")
                    : reader.choice(key + ".of", axes, "which cylinder's or joint's"));
}

bool same_place(const TableSource& a, const TableSource& b) {
  return a.place == b.place && a.index == b.index && a.place != SourcePlace::kCondition;
}

/// The allowed values: the profile's, else the DBC's in the place's unit, else any.
void read_range(TomlReader& reader, const std::string& key, const DbcSignal& layout,
                TableSource& source) {
  if (reader.has(key + ".range") || source.place == SourcePlace::kCondition) {
    const std::vector<double> range =
        reader.numbers(key + ".range", kAnyNumber, 2,
                       "least and most that is taken; of a condition, where it holds");
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
  const std::string name = reader.text(key + ".signal", "name of the signal");
  const DbcSignal layout = read_layout(reader, message, key, name);
  source.bits = layout.bits;
  check_bits(reader, message, key, source.bits);
  source.place =
      static_cast<SourcePlace>(reader.choice(key + ".to", source_names(), "what the value is"));
  if (source.place < SourcePlace::kEngineSpeed) {
    source.index = read_index(reader, key, source.place == SourcePlace::kSwash);
  }
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

/// Two messages of one id, or two that say the same, would take turns.
void check_received(TomlReader& reader, const BusTable& table, std::size_t message,
                    const std::string& key) {
  for (std::size_t i = 0; i < message; ++i) {
    if (table.rule[i].id == table.rule[message].id) {
      reader.fail(key, "its id is that of another message");
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
      table.source[table.source_count++] = source;
      ++message.count;
    }
    check_received(reader, table, table.message_count, key);
    ++table.message_count;
  }
}

namespace {

TableSink read_sink(TomlReader& reader, const Declared& message, const std::string& key) {
  TableSink sink;
  const std::string name = reader.text(key + ".signal", "name of the signal");
  const DbcSignal layout = read_layout(reader, message, key, name);
  sink.bits = layout.bits;
  check_bits(reader, message, key, sink.bits);
  sink.place =
      static_cast<SinkPlace>(reader.choice(key + ".from", sink_names(), "what the value is"));
  if (sink.place == SinkPlace::kConstant) {
    const double value = reader.number(key + ".value", kAnyNumber, "in the DBC's unit, or raw");
    sink.offset = (value - layout.offset) / layout.scale;
    return sink;
  }
  if (sink.place >= SinkPlace::kDuty) {
    sink.index = read_index(reader, key, sink.place == SinkPlace::kSwash);
  }
  read_scale(reader, key, layout, sink.scale, sink.offset);
  return sink;
}

}  // namespace

void read_sent(TomlReader& reader, const BusContext& context, BusTable& table) {
  const int count =
      reader.has("send") ? reader.table_count("send", 1, int{kMostTableSent}, "messages out") : 0;
  for (int i = 0; i < count; ++i) {
    const std::string key = fmt::format("send[{}]", i);
    const Declared declared = read_message(reader, context, key);
    TableSend& send = table.send[table.send_count++];
    send.rule.id = declared.id;
    send.rule.period_us = declared.period_us;
    send.extended = declared.extended;
    send.length = small(declared.length);
    send.bus = declared.bus;
    send.protection = read_protection(reader, declared, false, send.counter, send.rule.data_id);
    send.fill = reader.boolean_or(false, key + ".fill", "bits of no signal are 1; else 0")
                    ? std::uint8_t{0xFF}
                    : std::uint8_t{0};
    send.first = small(static_cast<int>(table.sink_count));
    const int signals =
        reader.table_count(key + ".signal", 1, kMostSignalsEach, "what is said in it");
    for (int n = 0; n < signals && table.sink_count < kMostTableSinks; ++n) {
      const TableSink sink = read_sink(reader, declared, fmt::format("{}.signal[{}]", key, n));
      send.has_enable = send.has_enable || sink.place == SinkPlace::kEnable;
      send.commands = send.commands || sink.place != SinkPlace::kConstant;
      table.has_cut = table.has_cut || sink.place == SinkPlace::kPilotCut;
      table.sink[table.sink_count++] = sink;
      ++send.count;
    }
  }
}

}  // namespace graben::machines
