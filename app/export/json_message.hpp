// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A message of the bus as JSON, with a schema: one number a signal, the unit in its name
/// ("BoomStroke_m"). What is not available, failed or out of range is not there.

#include <fmt/format.h>

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "can_dbc/codec.hpp"

namespace graben::app_export {

struct JsonMessage {
  std::uint32_t id = 0;
  std::string topic;   ///< "/machine/BoomStroke": who sends it, and its name.
  std::string schema;  ///< JSON schema, draft 7.
  std::function<std::string(const dbc::Payload& payload)> text;
  bool extended = true;
  std::uint8_t length = 8;
};

/// A signal's name with its SI unit: "BoomStroke_m", "PumpFlow_m3ps"; without a unit the name
/// alone.
[[nodiscard]] std::string signal_name(std::string_view name, std::string_view unit);

/// Text as JSON has it, in quotes.
[[nodiscard]] std::string json_text(std::string_view text);

/// `"name":{...}` of a number in a schema; and the schema of a message of such.
[[nodiscard]] std::string number_schema(std::string_view name, std::string_view unit);
[[nodiscard]] std::string object_schema(std::string_view title, const std::string& properties);

/// The sender's folder of the topics.
[[nodiscard]] std::string topic_of(std::string_view sender, std::string_view message);

[[nodiscard]] inline std::string number_text(const dbc::Physical& signal) {
  return fmt::format("{:.9g}", signal.value);
}
[[nodiscard]] inline std::string number_text(const dbc::Count& signal) {
  return fmt::format("{}", signal.value);
}
template <class Code>
[[nodiscard]] std::string number_text(const dbc::Coded<Code>& signal) {
  return fmt::format("{}", static_cast<unsigned>(signal.value));
}

template <class Message>
std::string message_text(const dbc::Payload& payload) {
  std::string text = "{";
  const Message message = Message::decode(payload);
  Message::visit(message, [&text](const dbc::Field& field, const auto& signal) {
    if (signal.state == dbc::RawState::kValid) {
      text += fmt::format("{}\"{}\":{}", text.size() > 1 ? "," : "",
                          signal_name(field.name, field.unit), number_text(signal));
    }
  });
  return text + "}";
}

template <class Message>
JsonMessage json_message() {
  std::string properties;
  const Message message{};
  Message::visit(message, [&properties](const dbc::Field& field, const auto& /*signal*/) {
    properties += (properties.empty() ? "" : ",") + number_schema(field.name, field.unit);
  });
  return {Message::kId, topic_of(Message::kSender, Message::kName),
          object_schema(Message::kName, properties), message_text<Message>};
}

template <class... Messages>
std::vector<JsonMessage> json_messages(dbc::MessageList<Messages...> /*of a database*/) {
  return {json_message<Messages>()...};
}

}  // namespace graben::app_export
