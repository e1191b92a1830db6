// SPDX-License-Identifier: Apache-2.0
#include "app/identify/verdict/bus_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "app/machines/bus_file.hpp"
#include "app/machines/dbc_layout.hpp"
#include "can_dbc/generated/dozer_dbc.hpp"
#include "can_dbc/generated/excavator_dbc.hpp"

namespace graben::identify {
namespace {

double number_of(const dbc::Physical& signal) {
  return signal.state == dbc::RawState::kValid ? signal.value : kNoNumber;
}
template <class Signal>
double number_of(const Signal& signal) {
  return signal.state == dbc::RawState::kValid ? static_cast<double>(signal.value) : kNoNumber;
}

/// Its units are SI, a share has none.
Meaning own_meaning(const std::string& signal, const std::string& unit) {
  Meaning meaning = meaning_of(signal, unit);
  if (unit.empty()) {
    meaning.unit = Unit::kRatio;
  }
  if (signal == "LeftPump" || signal == "RightPump") {
    meaning.what = What::kCommand;
    meaning.drive = signal == "LeftPump" ? 6 : 7;
  }
  return meaning;
}

template <class Message>
MessageLayout own_message() {
  MessageLayout layout{Message::kName,      Message::kId,     true, Message::kLength,
                       Message::kProtected, Message::kDataId, {},   {}};
  int enable = -1;
  const Message message{};
  Message::visit(message, [&](const dbc::Field& field, const auto& /*signal*/) {
    const std::string name = field.name;
    enable = name == "Enable" ? static_cast<int>(layout.signal.size()) : enable;
    layout.signal.push_back(
        {fmt::format("{}.{}", Message::kName, name), own_meaning(name, field.unit)});
  });
  layout.decode = [enable](const dbc::Payload& data, std::vector<double>& values) {
    values.clear();
    const Message decoded = Message::decode(data);
    Message::visit(decoded, [&](const dbc::Field& /*field*/, const auto& signal) {
      values.push_back(number_of(signal));
    });
    // Valves that are not enabled are closed, whatever else is sent.
    if (enable >= 0 && values[static_cast<std::size_t>(enable)] != 1.0) {
      std::fill(values.begin(), values.end(), 0.0);
    }
  };
  return layout;
}

double physical(const machines::DbcSignal& signal, const dbc::Payload& data) {
  const auto raw = static_cast<double>(raw_of(signal.bits, data));
  return raw * signal.scale + signal.offset;
}

BusLayout dbc_layout(const std::string& file) {
  BusLayout layout;
  layout.name = file;
  const std::vector<machines::DbcMessage> messages = machines::read_dbc(file);
  if (messages.empty()) {
    throw std::runtime_error(fmt::format("{}: has no message (BO_): is it a DBC?", file));
  }
  for (const machines::DbcMessage& message : messages) {
    MessageLayout of;
    of.name = message.name;
    of.id = message.id;
    of.extended = message.extended;
    of.length = message.length;
    auto used = std::make_shared<std::vector<machines::DbcSignal>>();
    for (const machines::DbcSignal& signal : message.signal) {
      if (message.wrong.empty() && signal.wrong.empty() && signal.supported &&
          lies_within(signal.bits, static_cast<unsigned>(std::min(message.length, 8)))) {
        // A message's name says what its signals are, unless they do themselves.
        Meaning meaning = meaning_of(signal.name, signal.unit);
        if (meaning.what == What::kOther || meaning.what == What::kTime ||
            meaning.what == What::kPressure) {
          meaning = meaning_of(message.name + "." + signal.name, signal.unit);
        } else if (meaning.what == What::kCommand && meaning.side != 0) {
          const Meaning whole = meaning_of(message.name + "." + signal.name, signal.unit);
          meaning.what = whole.what;
        }
        of.signal.push_back(
            {fmt::format("{}.{}", message.name, signal.name), meaning, signal.least, signal.most});
        used->push_back(signal);
      } else if (meaning_of(message.name + "." + signal.name, signal.unit).drive >= 0) {
        layout.left_out.push_back(fmt::format(
            "{}.{}{}", message.name, signal.name,
            !signal.supported ? " (multiplexed, a float, or of more than 32 bits)" : ""));
      }
    }
    of.decode = [used](const dbc::Payload& data, std::vector<double>& values) {
      values.clear();
      for (const machines::DbcSignal& signal : *used) {
        const double value = physical(signal, data);
        const bool said = signal.least != 0.0 || signal.most != 0.0;
        values.push_back(said && (value < signal.least || value > signal.most) ? kNoNumber : value);
      }
    };
    if (!of.signal.empty()) {
      layout.message.push_back(std::move(of));
    }
  }
  return layout;
}

Meaning source_meaning(const TableSource& source) {
  Meaning meaning;
  meaning.drive = source.index;
  switch (source.place) {
    case SourcePlace::kStroke:
      meaning.what = What::kPosition;
      meaning.length = true;
      meaning.unit = Unit::kMetre;
      return meaning;
    case SourcePlace::kJointAngle:
    case SourcePlace::kSlope:
      meaning.what = What::kPosition;
      meaning.unit = Unit::kRad;
      meaning.drive = source.index == kBodySlope ? -1 : source.index;
      return meaning;
    case SourcePlace::kCapPressure:
    case SourcePlace::kRodPressure:
      meaning.what = What::kPressure;
      return meaning;
    case SourcePlace::kSpool:
      meaning.what = What::kSpool;
      meaning.unit = Unit::kRatio;
      return meaning;
    default:
      meaning.drive = -1;
      return meaning;
  }
}

Meaning sink_meaning(const TableSink& sink) {
  Meaning meaning;
  const bool of_drive = sink.place == SinkPlace::kDuty || sink.place == SinkPlace::kExtend ||
                        sink.place == SinkPlace::kRetract;
  meaning.drive = of_drive ? sink.index : -1;
  meaning.what = of_drive ? What::kCommand : What::kOther;
  meaning.unit = Unit::kRatio;
  meaning.side =
      sink.place == SinkPlace::kExtend ? 1 : (sink.place == SinkPlace::kRetract ? -1 : 0);
  return meaning;
}

/// One part of a profile's message.
struct Part {
  BitField bits;
  double scale;
  double offset;
  bool adds;
};

MessageLayout profile_message(const std::string& name, std::uint32_t id, bool extended, int length,
                              std::vector<LayoutSignal> signal, std::vector<Part> parts) {
  MessageLayout layout{name, id, extended, length, false, 0, std::move(signal), {}};
  layout.decode = [parts = std::move(parts)](const dbc::Payload& data,
                                             std::vector<double>& values) {
    values.clear();
    for (const Part& part : parts) {
      const auto raw = static_cast<double>(raw_of(part.bits, data));
      const double value = raw * part.scale + part.offset;
      if (part.adds && !values.empty()) {
        values.back() += value;
      } else {
        values.push_back(value);
      }
    }
  };
  return layout;
}

BusLayout profile_layout(const std::filesystem::path& file) {
  const machines::BusFile bus = machines::load_bus(file);
  const BusTable& table = bus.table;
  BusLayout layout;
  layout.name = file.filename().string();
  for (std::size_t n = 0; n < table.message_count; ++n) {
    const TableMessage& message = table.message[n];
    std::vector<LayoutSignal> signal;
    std::vector<Part> parts;
    for (std::size_t at = 0; at < message.count; ++at) {
      const TableSource& source = table.source[message.first + at];
      parts.push_back({source.bits, source.scale, source.offset, source.adds && at > 0});
      if (!parts.back().adds) {
        signal.push_back({fmt::format("{}.{}", bus.received[n].message, bus.received[n].signal[at]),
                          source_meaning(source), source.least, source.most});
      }
    }
    layout.message.push_back(profile_message(bus.received[n].message, table.rule[n].id,
                                             table.rule[n].extended, table.rule[n].length,
                                             std::move(signal), std::move(parts)));
  }
  for (std::size_t n = 0; n < table.send_count; ++n) {
    const TableSend& message = table.send[n];
    std::vector<LayoutSignal> signal;
    std::vector<Part> parts;
    for (std::size_t at = 0; at < message.count; ++at) {
      const TableSink& sink = table.sink[message.first + at];
      parts.push_back({sink.bits, sink.scale == 0.0 ? 1.0 : sink.scale, sink.offset, false});
      signal.push_back(
          {fmt::format("{}.{}", bus.sent[n].message, bus.sent[n].signal[at]), sink_meaning(sink)});
    }
    layout.message.push_back(profile_message(bus.sent[n].message, message.rule.id, message.extended,
                                             message.length, std::move(signal), std::move(parts)));
  }
  return layout;
}

}  // namespace

BusLayout own_excavator_layout() {
  using namespace dbc::excavator;
  return {"our excavator bus",
          {own_message<BoomStroke>(), own_message<ArmStroke>(), own_message<BucketStroke>(),
           own_message<BoomPressure>(), own_message<ArmPressure>(), own_message<BucketPressure>(),
           own_message<SwingState>(), own_message<ValveState>(), own_message<SwingValveState>(),
           own_message<SpoolCommand>(), own_message<SwingCommand>(), own_message<PumpState>(),
           own_message<EEC1>(), own_message<MachineIdentity>()}};
}

BusLayout own_dozer_layout() {
  using namespace dbc::dozer;
  return {"our dozer bus",
          {own_message<BladeStroke>(), own_message<TiltState>(), own_message<TrackSpeed>(),
           own_message<PumpDisplacementCommand>(), own_message<SpoolCommand>(),
           own_message<ValveState>(), own_message<LeftTransmission>(), own_message<EEC1>(),
           own_message<MachineIdentity>()}};
}

BusLayout layout_of(const std::string& dbc) {
  const std::string end = dbc.size() > 4 ? dbc.substr(dbc.size() - 4) : std::string();
  if (end == ".dbc" || end == ".DBC" || std::filesystem::is_regular_file(dbc)) {
    if (dbc.size() < 5 || dbc.substr(dbc.size() - 5) != ".toml") {
      return dbc_layout(dbc);
    }
  }
  return profile_layout(machines::find_bus(dbc));
}

}  // namespace graben::identify
