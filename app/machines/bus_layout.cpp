// SPDX-License-Identifier: Apache-2.0
#include "app/machines/bus_layout.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "app/machines/axis_names.hpp"
#include "app/machines/near_word.hpp"

namespace graben::machines {
namespace {

constexpr int kMostId11 = 0x7FF;
constexpr int kMostId29 = 0x1FFFFFFF;

const DbcMessage* message_in(TomlReader& reader, const BusContext& context,
                             const Declared& declared) {
  std::vector<std::string> names;
  for (const DbcMessage& message : context.dbc) {
    names.push_back(message.name);
    if (message.name == declared.name && !message.wrong.empty()) {
      reader.fail(declared.key + ".message", message.wrong);
    }
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
        if (!signal.wrong.empty()) {
          reader.fail(key, signal.wrong);
          signal.bits = {0, 1, false, false};
          signal.most = 1.0;
        } else if (!signal.supported) {
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

/// Its layout, with bits that are among the message's.
DbcSignal read_within(TomlReader& reader, const Declared& message, const std::string& key,
                      const std::string& name) {
  DbcSignal layout = read_layout(reader, message, key, name);
  check_bits(reader, message, key, layout.bits);
  return layout;
}

}  // namespace

Declared read_message(TomlReader& reader, const BusContext& context, const std::string& key) {
  Declared declared;
  declared.key = key;
  declared.name = reader.text(key + ".message", "name of the message");
  declared.dbc = message_in(reader, context, declared);
  if (declared.dbc != nullptr) {
    // A profile may name the sender that a DBC leaves open, or the one of several.
    declared.id = reader.has(key + ".id")
                      ? static_cast<std::uint32_t>(reader.integer(
                            key + ".id", 0, declared.dbc->extended ? kMostId29 : kMostId11,
                            "its id, instead of the DBC's"))
                      : declared.dbc->id;
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
    if (declared.dbc == nullptr || declared.dbc->wrong.empty()) {
      reader.fail(key + ".message", fmt::format("{} bytes; allowed: 1 .. 8", declared.length));
    }
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

DbcSignal read_signal(TomlReader& reader, const Declared& message, const std::string& key) {
  return read_within(reader, message, key, reader.text(key + ".signal", "name of the signal"));
}

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
    counter = read_within(reader, message, key, name).bits;
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

std::uint8_t read_pump(TomlReader& reader, const std::string& key) {
  return small(reader.choice(key + ".of", {"pump1", "pump2"}, "which pump"));
}

std::uint8_t read_axis(TomlReader& reader, const std::string& key) {
  static const std::vector<std::string> axes(kAxisNames.begin(), kAxisNames.begin() + kAxisCount);
  return small(reader.choice(key + ".of", axes, "which cylinder's or joint's"));
}

}  // namespace graben::machines
