// SPDX-License-Identifier: Apache-2.0
#include "app/machines/bus_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>

#include "app/machines/axis_names.hpp"
#include "app/machines/bus_checks.hpp"
#include "app/machines/bus_tables.hpp"
#include "app/machines/profile_document.hpp"

namespace graben::machines {
namespace {

/// Of our own bus, whose valve side says every 20 ms what it acts on.
constexpr TimeUs kOwnEcho_us = 20 * kMillisecondUs;

/// Of a slope, the links: the platform may have one or not.
int axes_with(const BusTable& table, SourcePlace place) {
  unsigned there = 0;
  for (std::size_t n = 0; n < table.source_count; ++n) {
    const bool counts = table.source[n].place == place && table.source[n].index < kAxisCount;
    there |= counts ? 1U << table.source[n].index : 0U;
  }
  int count = 0;
  for (; there != 0; there &= there - 1) {
    ++count;
  }
  return count;
}

bool has_sink(const BusTable& table, SinkPlace place, unsigned index) {
  const auto end = table.sink.begin() + static_cast<std::ptrdiff_t>(table.sink_count);
  return std::any_of(table.sink.begin(), end, [&](const TableSink& sink) {
    return sink.place == place && sink.index == index;
  });
}

/// All axes or none: with some of them only there is no pose and no load.
bool all_axes(TomlReader& reader, const BusTable& table, SourcePlace place, const char* what) {
  const int count = axes_with(table, place);
  if (count != 0 && count != kAxisCount) {
    reader.fail("receive", fmt::format("{} of {} cylinders has a {}; allowed: all or none", count,
                                       kAxisCount, what));
  }
  return count == kAxisCount;
}

/// What a machine that does not speak our DBC beside it has to say and to take.
void check_complete(TomlReader& reader, const BusTable& table, bool strokes, bool joints) {
  if (table.own_frames) {
    return;
  }
  if (!strokes && !joints) {
    reader.fail("receive", "nothing says a stroke, joint_angle or slope of boom, arm and bucket");
  }
  if (axes_with(table, SourcePlace::kCapPressure) != kAxisCount ||
      axes_with(table, SourcePlace::kRodPressure) != kAxisCount) {
    reader.fail("receive", "nothing says a cap_pressure and rod_pressure of boom, arm and bucket");
  }
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    const bool both =
        has_sink(table, SinkPlace::kExtend, axis) && has_sink(table, SinkPlace::kRetract, axis);
    const bool sided =
        has_sink(table, SinkPlace::kFlow, axis) && has_sink(table, SinkPlace::kSide, axis);
    if (!both && !sided && !has_sink(table, SinkPlace::kDuty, axis)) {
      reader.fail(
          "send",
          fmt::format("nothing takes the {}'s duty, its extend and retract, or its flow and "
                      "side",
                      kAxisNames[axis]));
    }
  }
}

TimeUs slowest_condition_us(const BusTable& table) {
  TimeUs slowest_us = 0;
  for (std::size_t i = 0; i < table.message_count; ++i) {
    const TableMessage& message = table.message[i];
    for (std::size_t n = message.first; n < std::size_t{message.first} + message.count; ++n) {
      if (table.source[n].place == SourcePlace::kCondition) {
        slowest_us = std::max(slowest_us, message.period_us);
      }
    }
  }
  return slowest_us;
}

BusCapabilities capabilities_of(TomlReader& reader, const BusTable& table) {
  BusCapabilities can;
  const bool strokes = all_axes(reader, table, SourcePlace::kStroke, "stroke");
  const bool angles = all_axes(reader, table, SourcePlace::kJointAngle, "joint_angle");
  const bool slopes = all_axes(reader, table, SourcePlace::kSlope, "slope");
  const bool joints = angles || slopes;
  if (int{strokes} + int{angles} + int{slopes} > 1) {
    reader.fail("receive", "more than one of strokes, joint angles and slopes; allowed: one");
  }
  if (table.has_body_slope && !slopes) {
    reader.fail("receive", "a slope of the body and none of the links; allowed: all of them");
  }
  const bool spools = all_axes(reader, table, SourcePlace::kSpool, "spool");
  check_complete(reader, table, strokes, joints);
  const TimeUs echo_us = slowest_condition_us(table);
  can.joint_angles = joints;
  can.identity = table.own_frames;
  can.valve_echo = table.own_frames || echo_us > 0;
  can.spool_feedback = table.own_frames || spools;
  can.spool_by_pilot =
      spools && reader.boolean_or(false, "spool_by_pilot", "spools are told by pilot pressures");
  can.swash_feedback = table.own_frames || axes_with(table, SourcePlace::kSwash) == kPumpCount;
  can.swash_command = table.own_frames || (has_sink(table, SinkPlace::kSwash, 0) &&
                                           has_sink(table, SinkPlace::kSwash, 1));
  for (std::size_t i = 0; i < table.message_count; ++i) {
    can.protection = can.protection && table.message[i].protection == TableProtection::kE2e;
  }
  for (std::size_t i = 0; i < table.send_count; ++i) {
    const bool guarded = table.send[i].protection == TableProtection::kE2e;
    can.protection = can.protection && (guarded || !table.send[i].commands);
  }
  const TimeUs later_us = std::max<TimeUs>(0, echo_us - kOwnEcho_us);
  can.echo_cycles += static_cast<int>(later_us / kControlPeriod_us);
  can.latency_s = reader.number_or(0.0, "latency", {0.0, 0.2, "s"},
                                   "of the bus, either way; the valve's dead time covers it");
  can.joint_latency_s =
      reader.number_or(0.0, "joint_latency", {0.0, 0.05, "s"},
                       "age of joint angles or slopes when they come; they are foretold by it");
  if (can.joint_latency_s > 0.0 && !joints) {
    reader.fail("joint_latency", "neither joint angles nor slopes come; allowed: leave it out");
  }
  return can;
}

/// An error of a message or signal, with their names and its line.
std::string with_names(const toml::table& root, const std::string& error) {
  static const std::regex place(R"((receive|send)\[(\d{1,4})\](?:\.signal\[(\d{1,4})\])?)");
  std::smatch words;
  // Its beginning alone: a text of any length would be matched by as deep a recursion.
  if (!std::regex_search(error, words, place, std::regex_constants::match_continuous)) {
    return error;
  }
  const std::string message = fmt::format("{}[{}]", words[1].str(), words[2].str());
  const std::string signal =
      words[3].matched ? fmt::format("{}.signal[{}]", message, words[3].str()) : "";
  const auto name = [&root](const std::string& key) {
    return root.at_path(key).value<std::string>().value_or("?");
  };
  std::string text = "message " + name(message + ".message");
  if (!signal.empty()) {
    text += ", signal " + name(signal + ".signal");
  }
  const toml::node* node = root.at_path(signal.empty() ? message : signal).node();
  const bool has_line = error.find("(line ") != std::string::npos;
  if (node != nullptr && !has_line) {
    text += fmt::format(" (line {})", node->source().begin.line);
  }
  return fmt::format("{}: {}", text, error);
}

BusContext read_context(TomlReader& reader, const std::filesystem::path& file) {
  BusContext context;
  if (reader.has("dbc")) {
    context.dbc_name = reader.text("dbc", "DBC beside this file that has the messages' layout");
    try {
      context.dbc = read_dbc(file.parent_path() / context.dbc_name);
    } catch (const std::runtime_error& error) {
      reader.fail("dbc", error.what());
      context.is_unread = true;
    }
  }
  const int count = reader.has("interface")
                        ? reader.table_count("interface", 1, 4, "buses, in the order of --can")
                        : 0;
  for (int i = 0; i < count; ++i) {
    const std::string key = fmt::format("interface[{}].name", i);
    const std::string name = reader.text(key, "what the messages call it");
    const auto& before = context.interfaces;
    if (std::find(before.begin(), before.end(), name) != before.end()) {
      reader.fail(key, fmt::format("'{}' is that of another interface", name));
    }
    context.interfaces.push_back(name);
  }
  return context;
}

/// Of each message of `list` ("receive", "send"), which has been checked.
std::vector<BusWords> words_of(const toml::table& root, const char* list) {
  std::vector<BusWords> all;
  const toml::array* messages = root[list].as_array();
  for (std::size_t i = 0; messages != nullptr && i < messages->size(); ++i) {
    const std::string key = fmt::format("{}[{}]", list, i);
    BusWords& words = all.emplace_back();
    words.message = root.at_path(key + ".message").value<std::string>().value_or("");
    const toml::array* signals = root.at_path(key + ".signal").as_array();
    for (std::size_t n = 0; signals != nullptr && n < signals->size(); ++n) {
      words.signal.push_back(root.at_path(fmt::format("{}.signal[{}].signal", key, n))
                                 .value<std::string>()
                                 .value_or(""));
    }
  }
  return all;
}

void throw_named_errors(const std::filesystem::path& file, const toml::table& root,
                        const TomlReader& reader) {
  if (reader.errors().empty()) {
    return;
  }
  std::vector<std::string> errors;
  for (const std::string& error : reader.errors()) {
    errors.push_back(with_names(root, error));
  }
  throw ProfileError(file.string(), errors);
}

}  // namespace

BusFile load_bus(const std::filesystem::path& file) {
  const ProfileDocument document = read_document(file);
  refuse_other_sort(document, kBusSort);
  TomlReader reader(document.root);
  BusFile bus;
  bus.speaks = reader.text("bus", "which machine's bus this is");
  const BusContext context = read_context(reader, file);
  if (context.is_unread) {
    throw_named_errors(file, document.root, reader);
  }
  bus.table.bus_count = static_cast<std::uint8_t>(context.interfaces.size());
  bus.table.own_frames =
      reader.boolean_or(false, "own_frames", "the machine's end speaks our DBC beside it");
  read_nodes(reader, context, bus.table);
  read_received(reader, context, bus.table);
  read_sent(reader, context, bus.table);
  check_bus(reader, bus.table);
  bus.capabilities = capabilities_of(reader, bus.table);
  reader.refuse_unknown_keys();
  throw_named_errors(file, document.root, reader);
  bus.received = words_of(document.root, "receive");
  bus.sent = words_of(document.root, "send");
  bus.hash = reader.hash();
  return bus;
}

std::filesystem::path find_bus(const std::string& name,
                               const std::vector<std::filesystem::path>& folders) {
  return find_file("bus profile", name, folders);
}

}  // namespace graben::machines
