// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <vector>

#include "app/machines/bus_layout.hpp"
#include "app/machines/bus_tables.hpp"

namespace graben::machines {
namespace {

/// In the order of SinkPlace.
const std::vector<std::string>& sink_names() {
  static const std::vector<std::string> names = {
      "constant", "enable", "pilot_cut", "duty", "extend", "retract", "swash", "flow", "side"};
  return names;
}

TableSink read_sink(TomlReader& reader, const Declared& message, const std::string& key) {
  TableSink sink;
  const DbcSignal layout = read_signal(reader, message, key);
  sink.bits = layout.bits;
  sink.place =
      static_cast<SinkPlace>(reader.choice(key + ".from", sink_names(), "what the value is"));
  if (sink.place == SinkPlace::kConstant) {
    const double value = reader.number(key + ".value", kAnyNumber, "in the DBC's unit, or raw");
    sink.offset = (value - layout.offset) / layout.scale;
    return sink;
  }
  if (sink.place >= SinkPlace::kDuty) {
    sink.index = sink.place == SinkPlace::kSwash ? read_pump(reader, key) : read_axis(reader, key);
  }
  read_scale(reader, key, layout, sink.scale, sink.offset);
  const bool is_share = sink.place == SinkPlace::kExtend || sink.place == SinkPlace::kRetract ||
                        sink.place == SinkPlace::kFlow;
  if (is_share) {
    sink.least = reader.number_or(0.0, key + ".least", {0.0, 0.9, ""},
                                  "what any drive that moves begins at, of full: a valve's least "
                                  "current");
  }
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
