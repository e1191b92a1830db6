// SPDX-License-Identifier: Apache-2.0
#include "app/export/bus_messages.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>

#include "can_dbc/generated/j1939_dbc.hpp"
#include "hal/buses/bus_table.hpp"

namespace graben::app_export {
namespace {

/// CiA 301.
constexpr std::uint32_t kHeartbeatId = 0x700;
constexpr std::uint8_t kNodeStateBits = 0x7F;
/// Of a 29-bit id of J1939: message without priority and sender; sender.
constexpr std::uint32_t kGroupBits = 0x03FFFF00U;
constexpr std::uint32_t kAddressBits = 0xFFU;

const char* unit_of(SourcePlace place) {
  switch (place) {
    case SourcePlace::kStroke:
      return "m";
    case SourcePlace::kJointAngle:
    case SourcePlace::kSlope:
      return "rad";
    case SourcePlace::kCapPressure:
    case SourcePlace::kRodPressure:
      return "Pa";
    case SourcePlace::kEngineSpeed:
      return "rad/s";
    default:
      return "";
  }
}

/// A signal of a message as JSON has it; none where it says nothing.
struct NamedSignal {
  std::string key;  ///< With quotes and colon.
  std::function<std::optional<double>(const dbc::Payload&)> value;
};

std::optional<double> value_of(const TableSource& source, const dbc::Payload& data) {
  const std::int64_t raw = raw_of(source.bits, data);
  const std::int64_t mask = (std::int64_t{1} << source.bits.width) - 1;
  const std::int64_t bits = raw & mask;
  const double value = static_cast<double>(raw) * source.scale + source.offset;
  // Of a condition or a merit the range says where it holds, not what may come.
  const bool says_state =
      source.place == SourcePlace::kCondition || source.place == SourcePlace::kMerit;
  const bool is_known = bits != source.error_raw && bits != source.missing_raw &&
                        (says_state || (value >= source.least && value <= source.most));
  return is_known ? std::optional(value) : std::nullopt;
}

/// Of a constant the raw number is all there is.
std::optional<double> value_of(const TableSink& sink, const dbc::Payload& data) {
  const auto raw = static_cast<double>(raw_of(sink.bits, data));
  return sink.place == SinkPlace::kConstant ? raw : raw * sink.scale + sink.offset;
}

std::string text_of(const std::vector<NamedSignal>& signals, const dbc::Payload& data) {
  std::string text = "{";
  for (const NamedSignal& signal : signals) {
    if (const std::optional<double> value = signal.value(data)) {
      text += fmt::format("{}{}{:.9g}", text.size() > 1 ? "," : "", signal.key, *value);
    }
  }
  return text + "}";
}

/// A message of a table's, whose signals are `count` of `signals` from `first` on.
template <class Signal, std::size_t kMost, class Unit>
JsonMessage message_of(const machines::BusFile& bus, const machines::BusWords& words,
                       const std::array<Signal, kMost>& signals, std::size_t first, Unit unit) {
  JsonMessage message;
  message.topic = topic_of(bus.speaks, words.message);
  std::string properties;
  std::vector<NamedSignal> named;
  for (std::size_t n = 0; n < words.signal.size(); ++n) {
    const Signal& signal = signals[first + n];
    properties += (properties.empty() ? "" : ",") + number_schema(words.signal[n], unit(signal));
    named.push_back({json_text(signal_name(words.signal[n], unit(signal))) + ":",
                     [signal](const dbc::Payload& data) { return value_of(signal, data); }});
  }
  message.schema = object_schema(words.message, properties);
  message.text = [named](const dbc::Payload& data) { return text_of(named, data); };
  return message;
}

JsonMessage heartbeat_of(const machines::BusFile& bus, const TableNode& node) {
  const std::string name = fmt::format("Heartbeat{}", node.id);
  JsonMessage message{kHeartbeatId + node.id, topic_of(bus.speaks, name),
                      object_schema(name, number_schema("NodeState", "")),
                      [](const dbc::Payload& data) {
                        return fmt::format(R"({{"NodeState":{}}})", data[0] & kNodeStateBits);
                      }};
  message.extended = false;
  message.length = 1;
  return message;
}

/// What starts and stops the nodes.
JsonMessage node_command_of(const machines::BusFile& bus) {
  JsonMessage message{
      0, topic_of(bus.speaks, "NodeCommand"),
      object_schema("NodeCommand", number_schema("Command", "") + "," + number_schema("Node", "")),
      [](const dbc::Payload& data) {
        return fmt::format(R"({{"Command":{},"Node":{}}})", data[0], data[1]);
      }};
  message.extended = false;
  message.length = 2;
  return message;
}

template <class Message>
bool is(std::uint32_t id) {
  return (id & kGroupBits) == (Message::kId & kGroupBits);
}

}  // namespace

std::vector<JsonMessage> bus_messages(const machines::BusFile& bus) {
  std::vector<JsonMessage> messages;
  const BusTable& table = bus.table;
  for (std::size_t i = 0; i < table.message_count; ++i) {
    JsonMessage message =
        message_of(bus, bus.received[i], table.source, table.message[i].first,
                   [](const TableSource& source) { return unit_of(source.place); });
    message.id = table.rule[i].id;
    message.extended = table.rule[i].extended;
    message.length = table.rule[i].length;
    messages.push_back(std::move(message));
  }
  for (std::size_t i = 0; i < table.send_count; ++i) {
    JsonMessage message = message_of(bus, bus.sent[i], table.sink, table.send[i].first,
                                     [](const TableSink& /*sink*/) { return ""; });
    message.id = table.send[i].rule.id;
    message.extended = table.send[i].extended;
    message.length = table.send[i].length;
    messages.push_back(std::move(message));
  }
  for (std::size_t i = 0; i < table.node_count; ++i) {
    messages.push_back(heartbeat_of(bus, table.node[i]));
  }
  if (table.node_count > 0) {
    messages.push_back(node_command_of(bus));
  }
  return messages;
}

std::optional<JsonMessage> link_sensor_message(std::uint32_t id) {
  std::optional<JsonMessage> message;
  if (is<dbc::j1939::ARI>(id)) {
    message = json_message<dbc::j1939::ARI>();
  } else if (is<dbc::j1939::ACS>(id)) {
    message = json_message<dbc::j1939::ACS>();
  } else if (is<dbc::j1939::SSI2>(id)) {
    message = json_message<dbc::j1939::SSI2>();
  } else {
    return std::nullopt;
  }
  message->id = id;
  const std::string name = message->topic.substr(message->topic.rfind('/') + 1);
  message->topic = fmt::format("/sensor/{:02X}/{}", id & kAddressBits, name);
  return message;
}

}  // namespace graben::app_export
