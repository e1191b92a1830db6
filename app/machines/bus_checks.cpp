// SPDX-License-Identifier: Apache-2.0
#include "app/machines/bus_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "can_dbc/codec.hpp"
#include "can_dbc/generated/common_dbc.hpp"
#include "hal/buses/canopen_nodes.hpp"
#include "hal/buses/excavator_bus.hpp"

namespace graben::machines {
namespace {

constexpr TimeUs kMostMotionSilence_us = 50 * kMillisecondUs;
constexpr TimeUs kMostStateSilence_us = kSecondUs;
/// The valve side of our own bus goes to neutral after as long.
constexpr TimeUs kMostCommandPeriod_us = 100 * kMillisecondUs;
constexpr double kCoarsest = 1.0 / 50.0;
/// CRC in byte 0, counter in the low half of byte 1 (hal/link/e2e.hpp).
constexpr std::uint64_t kE2eBits = 0xFFF;

std::string signal_key(const TableSend& send, std::size_t message, std::size_t sink) {
  return fmt::format("send[{}].signal[{}]", message, sink - send.first);
}

/// Of the payload's 64; none of a field that was refused.
std::uint64_t bits_of(const BitField& field, unsigned length) {
  std::array<std::uint8_t, 8> data{};
  if (lies_within(field, length)) {
    put_raw(field, -1, data);
  }
  return dbc::word_of(data);
}

void check_overlap(TomlReader& reader, const BusTable& table, std::size_t message) {
  const TableSend& send = table.send[message];
  std::uint64_t taken = 0;
  if (send.protection == TableProtection::kE2e) {
    taken = kE2eBits;
  } else if (send.protection == TableProtection::kCounter) {
    taken = bits_of(send.counter, send.length);
  }
  for (std::size_t n = send.first; n < std::size_t{send.first} + send.count; ++n) {
    const std::uint64_t bits = bits_of(table.sink[n].bits, send.length);
    if ((taken & bits) != 0U) {
      reader.fail(signal_key(send, message, n),
                  "its bits overlap those of another signal, the counter or the CRC of its "
                  "message; allowed: bits of its own");
    }
    taken |= bits;
  }
}

/// EEC1 is the machine's where the table takes the engine's speed: ours is then off.
bool is_engines(const BusTable& table, std::uint32_t id) {
  return is_named_by(dbc::common::EEC1::kId, id) && table.has_engine;
}

/// A message of this file: what its id says, whether of 29 bits, and its bus.
struct Seen {
  std::uint32_t identity = 0;
  bool extended = true;
  std::uint8_t bus = kAnyBus;

  [[nodiscard]] bool is(const Seen& other) const {
    return other.identity == identity && other.extended == extended &&
           (bus == kAnyBus || other.bus == kAnyBus || other.bus == bus);
  }
};

void check_ids(TomlReader& reader, const BusTable& table) {
  // All of ours are of 29 bits.
  const auto is_own = [](std::uint32_t named, bool extended) {
    if (!extended) {
      return false;
    }
    const auto is_it = [named](std::uint32_t id) { return is_named_by(id, named); };
    const auto taken = ExcavatorReceiver::ids();
    const auto sent = ExcavatorTransmitter::ids();
    return std::any_of(taken.begin(), taken.end(), is_it) ||
           std::any_of(sent.begin(), sent.end(), is_it);
  };
  const auto refuse = [&](const std::string& key, std::uint32_t id, const char* whose) {
    reader.fail(key,
                fmt::format("its id 0x{:X} is that of {}; allowed: one of its own", id, whose));
  };
  std::vector<Seen> seen;
  const auto is_seen = [&](const Seen& it) {
    return std::any_of(seen.begin(), seen.end(), [&](const Seen& other) { return it.is(other); });
  };
  for (std::size_t i = 0; i < table.message_count; ++i) {
    const std::uint32_t id = table.rule[i].id;
    const bool extended = table.rule[i].extended;
    if (is_own(id, extended) && !is_engines(table, id)) {
      refuse(fmt::format("receive[{}]", i), id, "a message of our own bus");
    }
    seen.push_back({identity_of(id), extended, table.message[i].bus});
  }
  for (std::size_t i = 0; i < table.send_count; ++i) {
    const std::uint32_t id = table.send[i].rule.id;
    const Seen sent{identity_of(id), table.send[i].extended, table.send[i].bus};
    const std::string key = fmt::format("send[{}]", i);
    if (is_own(id, sent.extended)) {
      refuse(key, id, "a message of our own bus");
    } else if (sent.extended && is_of_any_source(id)) {
      reader.fail(key,
                  fmt::format("its id 0x{:X} has source FE, which is nobody's; allowed: an `id` "
                              "with the source that the valves listen to",
                              id));
    } else if (is_seen(sent)) {
      refuse(key, id, "another message of this file");
    }
    seen.push_back(sent);
  }
}

/// What a place may be told to say; both ends and its neutral.
std::vector<double> said_values(SinkPlace place) {
  if (place == SinkPlace::kDuty) {
    return {-1.0, 0.0, 1.0};
  }
  if (place == SinkPlace::kSide) {
    return {0.0, 1.0, 2.0};
  }
  return {0.0, 1.0};
}

bool is_switch(SinkPlace place) {
  return place == SinkPlace::kEnable || place == SinkPlace::kPilotCut || place == SinkPlace::kSide;
}

/// What a receiver has to take for 'do nothing' is raw 0.
bool has_neutral(SinkPlace place) {
  return place == SinkPlace::kDuty || place == SinkPlace::kExtend || place == SinkPlace::kRetract ||
         place == SinkPlace::kEnable || place == SinkPlace::kFlow || place == SinkPlace::kSide;
}

/// False where the bits can't say a raw value; then it is told.
bool check_raw(TomlReader& reader, const std::string& key, const BitField& bits, double value,
               double raw) {
  const double span = std::ldexp(1.0, bits.width);
  const double least = bits.is_signed ? -0.5 * span : 0.0;
  const double most = (bits.is_signed ? 0.5 * span : span) - 1.0;
  const double sent = std::floor(raw + 0.5);
  if (sent >= least && sent <= most) {
    return true;
  }
  reader.fail(key,
              fmt::format("{:g} is raw {:.6g}, which its {} bits can't say; allowed: {:.0f} .. "
                          "{:.0f}",
                          value, raw, bits.width, least, most));
  return false;
}

void check_sink(TomlReader& reader, const TableSink& sink, const std::string& key) {
  if (sink.place == SinkPlace::kConstant) {
    static_cast<void>(check_raw(reader, key + ".value", sink.bits, sink.offset, sink.offset));
    return;
  }
  const double coarsest = is_switch(sink.place) ? 1.0 : kCoarsest;
  if (!(std::abs(sink.scale) <= coarsest)) {
    reader.fail(key + ".scale", fmt::format("one step is {:g}; allowed: at most {:g}",
                                            std::abs(sink.scale), coarsest));
  }
  for (const double value : said_values(sink.place)) {
    if (!check_raw(reader, key + ".scale", sink.bits, value, (value - sink.offset) / sink.scale)) {
      return;
    }
  }
  const double neutral = std::floor(-sink.offset / sink.scale + 0.5);
  if (has_neutral(sink.place) && neutral != 0.0) {
    reader.fail(
        key + ".offset",
        fmt::format("neutral is raw {:.0f}; allowed: 0 .. 0, which offset 0 brings", neutral));
  }
}

void check_sent(TomlReader& reader, const BusTable& table) {
  for (std::size_t i = 0; i < table.send_count; ++i) {
    const TableSend& send = table.send[i];
    check_overlap(reader, table, i);
    if (send.commands && send.rule.period_us > kMostCommandPeriod_us) {
      reader.fail(fmt::format("send[{}].period", i),
                  "it carries a command; allowed: 0.01 .. 0.1 s");
    }
    for (std::size_t n = send.first; n < std::size_t{send.first} + send.count; ++n) {
      if (lies_within(table.sink[n].bits, send.length)) {
        check_sink(reader, table.sink[n], signal_key(send, i, n));
      }
    }
  }
}

/// Conditions and the engine change slowly; all else is what the machine moves by.
void check_silence(TomlReader& reader, const BusTable& table) {
  for (std::size_t i = 0; i < table.message_count; ++i) {
    const TableMessage& message = table.message[i];
    const auto* const first = table.source.data() + message.first;
    const bool moves = std::any_of(first, first + message.count, [](const TableSource& source) {
      return source.place < SourcePlace::kEngineSpeed;
    });
    const TimeUs most_us = moves ? kMostMotionSilence_us : kMostStateSilence_us;
    if (message.timeout_us > most_us) {
      reader.fail(fmt::format("receive[{}].timeout", i),
                  fmt::format("{:g} s; allowed: 0.01 .. {:g} s, as it has {}",
                              static_cast<double>(message.timeout_us) * 1e-6,
                              static_cast<double>(most_us) * 1e-6,
                              moves ? "what the machine moves by" : "conditions or the engine"));
    }
  }
}

/// Ids that CANopen keeps for itself.
void check_nodes(TomlReader& reader, const BusTable& table) {
  for (std::size_t i = 0; i < table.message_count; ++i) {
    for (std::size_t n = 0; n < table.node_count; ++n) {
      if (!table.rule[i].extended &&
          table.rule[i].id == CanopenNodes::kHeartbeatId + table.node[n].id) {
        reader.fail(fmt::format("receive[{}]", i),
                    fmt::format("its id 0x{:X} is that of the heartbeat of node {}",
                                table.rule[i].id, table.node[n].id));
      }
    }
  }
  for (std::size_t i = 0; i < table.send_count; ++i) {
    if (!table.send[i].extended && table.send[i].rule.id == 0 && table.node_count != 0) {
      reader.fail(fmt::format("send[{}]", i), "its id 0x0 is that of the nodes' start");
    }
  }
}

}  // namespace

void check_bus(TomlReader& reader, const BusTable& table) {
  check_nodes(reader, table);
  check_ids(reader, table);
  check_silence(reader, table);
  check_sent(reader, table);
}

}  // namespace graben::machines
