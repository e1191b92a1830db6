// SPDX-License-Identifier: Apache-2.0
#include "app/export/mcap_export.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <utility>

#include "app/export/bus_messages.hpp"
#include "app/export/json_message.hpp"
#include "app/export/mcap_writer.hpp"
#include "app/identify/machine/log_version.hpp"
#include "app/runs/code_text.hpp"
#include "app/runs/run_log.hpp"
#include "can_dbc/generated/dozer_dbc.hpp"
#include "can_dbc/generated/excavator_dbc.hpp"

namespace graben::app_export {
namespace {

using Status = dbc::common::EcuStatus;

constexpr const char* kStateSchema =
    R"({"type":"object","title":"State","properties":{"Mode":{"type":"string"},)"
    R"("Limit":{"type":"string","description":"what holds lambda below 1"},)"
    R"("FaultNumber":{"type":"number","description":"0: none"},"Fault":{"type":"string"}}})";

/// Of Foxglove's own log, which its log panel shows.
constexpr const char* kLogSchema =
    R"({"type":"object","title":"foxglove.Log","properties":{"timestamp":{"type":"object",)"
    R"("title":"time","properties":{"sec":{"type":"integer"},"nsec":{"type":"integer"}}},)"
    R"("level":{"type":"integer"},"message":{"type":"string"},"name":{"type":"string"},)"
    R"("file":{"type":"string"},"line":{"type":"integer"}}})";
constexpr int kInfo = 2;
constexpr int kError = 4;

constexpr std::uint64_t kNsPerUs = 1000;
constexpr std::uint64_t kNsPerS = 1000000000;

/// The controller's status in words, at each change.
class StateWords {
 public:
  StateWords(McapWriter& writer, const runs::ActuatorNames& actuators)
      : writer_(writer),
        actuators_(actuators),
        state_(writer.add_channel("/graben/state", "graben.State", kStateSchema)),
        events_(writer.add_channel("/graben/events", "foxglove.Log", kLogSchema)) {}

  void take(const Status& status, std::uint64_t time_ns, std::size_t line) {
    const auto mode = static_cast<EcuMode>(status.mode.value);
    const auto fault = static_cast<Fault>(status.fault.value);
    const std::string limit =
        runs::limit_words({static_cast<LimitKind>(status.limit_kind.value),
                           static_cast<std::uint8_t>(status.limit_index.value)},
                          actuators_);
    const std::string text = nlohmann::ordered_json({{"Mode", runs::mode_words(mode)},
                                                     {"Limit", limit},
                                                     {"FaultNumber", static_cast<int>(fault)},
                                                     {"Fault", runs::fault_words(fault)}})
                                 .dump();
    if (text != last_) {
      writer_.add(state_, time_ns, text);
      last_ = text;
    }
    if (mode != mode_) {
      event(time_ns, line, kInfo, fmt::format("mode {}", runs::mode_words(mode)));
      mode_ = mode;
    }
    // What a controller waits for before it has ever been ready is no fault.
    is_ready_ = is_ready_ || mode != EcuMode::kSilent;
    if (fault != fault_) {
      event(time_ns, line, fault == Fault::kNone || !is_ready_ ? kInfo : kError,
            fault == Fault::kNone ? std::string("no fault")
                                  : fmt::format("{} {}: {}", is_ready_ ? "fault" : "waits, code",
                                                static_cast<int>(fault), runs::fault_words(fault)));
      fault_ = fault;
    }
  }

 private:
  void event(std::uint64_t time_ns, std::size_t line, int level, const std::string& message) {
    writer_.add(events_, time_ns,
                nlohmann::ordered_json(
                    {{"timestamp", {{"sec", time_ns / kNsPerS}, {"nsec", time_ns % kNsPerS}}},
                     {"level", level},
                     {"message", message},
                     {"name", "graben"},
                     {"file", "log"},
                     {"line", line}})
                    .dump());
  }

  McapWriter& writer_;
  const runs::ActuatorNames& actuators_;
  std::uint16_t state_;
  std::uint16_t events_;
  std::string last_;
  std::optional<EcuMode> mode_;
  Fault fault_ = Fault::kNone;
  bool is_ready_ = false;
};

/// A channel for each message that is known by its id: of our DBC, of the machine's own bus, which
/// says better than ours what an id is there, and of a sensor on a link.
class Channels {
 public:
  Channels(McapWriter& writer, bool is_dozer, const machines::BusFile* bus) : writer_(writer) {
    if (bus != nullptr) {
      for (JsonMessage& message : bus_messages(*bus)) {
        add(std::move(message), bus->speaks);
      }
    }
    for (JsonMessage& message : is_dozer ? json_messages(dbc::dozer::AllMessages{})
                                         : json_messages(dbc::excavator::AllMessages{})) {
      add(std::move(message), "graben");
    }
  }

  /// Writes the frame; false where no channel is for it.
  bool take(const identify::LoggedFrame& frame, std::uint64_t time_ns) {
    auto channel = channels_.find(key_of(frame.extended, frame.id));
    if (channel == channels_.end() && frame.extended) {
      channel = channels_.find({true, identity_of(frame.id | 0xFFU) & ~std::uint32_t{1}});
    }
    if (channel == channels_.end() && frame.extended) {
      if (std::optional<JsonMessage> sensor = link_sensor_message(frame.id)) {
        channel = add(std::move(*sensor), "j1939");
      }
    }
    if (channel == channels_.end() || frame.length != channel->second.message.length) {
      return false;
    }
    writer_.add(channel->second.id, time_ns, channel->second.message.text(frame.data));
    return true;
  }

  [[nodiscard]] std::size_t count() const { return channels_.size(); }

 private:
  struct Channel {
    JsonMessage message;
    std::uint16_t id;
  };
  using Map = std::map<CanId, Channel>;

  static CanId key_of(bool extended, std::uint32_t id) {
    return {extended, extended ? identity_of(id) : id};
  }

  Map::iterator add(JsonMessage message, const std::string& owner) {
    const CanId key = key_of(message.extended, message.id);
    const auto known = channels_.find(key);
    if (known != channels_.end()) {
      return known;
    }
    const std::uint16_t id = writer_.add_channel(
        message.topic, owner + "." + message.topic.substr(message.topic.rfind('/') + 1),
        message.schema);
    return channels_.emplace(key, Channel{std::move(message), id}).first;
  }

  McapWriter& writer_;
  Map channels_;
};

}  // namespace

ExportCounts export_mcap(const std::filesystem::path& log, const std::filesystem::path& mcap,
                         const FindBus& find_bus) {
  // Says what kind of machine it is, and refuses what is no log of ours before anything is written.
  const runs::RunLog run = runs::read_run_log(log);
  ExportCounts counts;
  const std::optional<machines::BusFile> bus = find_bus(run.profile_hash);
  McapWriter writer(mcap, "graben");
  Channels channels(writer, run.is_dozer, bus ? &*bus : nullptr);
  StateWords words(writer, run.is_dozer ? runs::dozer_actuators() : runs::excavator_actuators());
  static_cast<void>(identify::read_versioned(log, [&](const identify::LoggedFrame& frame) {
    const auto time_ns = static_cast<std::uint64_t>(std::llround(frame.time_s * 1e6)) * kNsPerUs;
    if (!channels.take(frame, time_ns)) {
      ++counts.foreign[{frame.extended, frame.id}];
    } else if (frame.extended && frame.id == Status::kId) {
      words.take(Status::decode(frame.data), time_ns, frame.line);
    }
  }));
  writer.finish();
  counts.messages = writer.messages();
  counts.channels = channels.count() + 2;
  counts.notes = run.read.notes();
  counts.duration_s = run.until_s - run.from_s;
  return counts;
}

}  // namespace graben::app_export
