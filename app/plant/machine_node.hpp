// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The part of a simulated machine's node that is the same for every kind: commands in, spool
/// command and pilot cut first of all, identity, reports in time, faults.

#include <cstdint>
#include <optional>
#include <utility>

#include "app/plant/command_link.hpp"
#include "app/plant/frame_sender.hpp"
#include "app/plant/node_faults.hpp"
#include "can_dbc/codec.hpp"
#include "firmware/core/time.hpp"
#include "hal/can_port.hpp"
#include "hal/link/stamp_echo.hpp"

namespace graben::plant {

[[nodiscard]] constexpr dbc::Physical valid(double value) { return {value, dbc::RawState::kValid}; }
[[nodiscard]] constexpr bool is_valid(const dbc::Physical& value) {
  return value.state == dbc::RawState::kValid;
}

/// A people detector's frame.
template <class Dbc>
[[nodiscard]] typename Dbc::ExternalLimit external_limit(const ExternalWord& word) {
  using Limit = typename Dbc::ExternalLimit;
  constexpr auto kValid = dbc::RawState::kValid;
  Limit limit;
  limit.level = {static_cast<typename Limit::Level>(word.level), kValid};
  limit.resume = {word.resumes ? Limit::Resume::kOn : Limit::Resume::kOff, kValid};
  limit.reason = {Limit::Reason::kPerson, kValid};
  limit.speed_share_ratio = valid(word.speed_ratio);
  limit.deadline_s = valid(word.deadline_s);
  limit.source = {word.source, kValid};
  return limit;
}

/// A plant on its bus, of which a machine kind's node is made. `Dbc` is the kind's, with
/// SpoolCommand, ValveState, EEC1 and MachineIdentity; `Plant` has advance(duration_us) and
/// set_pilot_cut(on); `Faults` are NodeFaults and the kind's own. The bus port belongs to the
/// caller, who opens it.
template <class Dbc, class Plant, class Faults>
class MachineNode {
 public:
  static constexpr TimeUs kCycleUs = 10 * kMillisecondUs;

  [[nodiscard]] Plant& plant() { return plant_; }
  [[nodiscard]] const Plant& plant() const { return plant_; }
  /// Of SpoolCommand.
  [[nodiscard]] const CommandCounters& counters() const { return spool_link_.counters(); }
  /// The valve side lets SpoolCommand's duties through.
  [[nodiscard]] bool spools_enabled() const { return enabled_; }
  /// The fault switches.
  [[nodiscard]] Faults& faults() { return faults_; }

 protected:
  using SpoolCommand = typename Dbc::SpoolCommand;

  /// What SpoolCommand asks for, and whether its enable lets the duties through.
  struct SpoolRequest {
    SpoolCommand command;
    bool enabled = false;
  };

  template <class... PlantArguments>
  MachineNode(CanPort& port, std::uint32_t profile_hash, PlantArguments&&... plant_arguments)
      : plant_(std::forward<PlantArguments>(plant_arguments)...),
        port_(port),
        sender_(port, Dbc::kMessages),
        profile_hash_(profile_hash) {}
  ~MachineNode() = default;

  /// Gives each pending frame to `take`, but for what a fault keeps from the machine.
  template <class Take>
  void receive(const Take& take) {
    receive_frames(port_, [&](const CanFrame& frame) {
      echo_.hear(frame);
      if (!same_message(frame.id, SpoolCommand::kId) || !faults_.loses_spool_commands) {
        take(frame);
      }
    });
  }

  /// Takes a frame of SpoolCommand, and does what its pilot cut says; an unusable one changes
  /// nothing of that and lets no duty through. Nothing for a frame that is refused; but of two
  /// senders the safer one is obeyed, whose counter fits or not: a cut is a cut, Off is Off.
  [[nodiscard]] std::optional<SpoolRequest> take_spool_request(const CanFrame& frame, TimeUs now) {
    const bool accepted = spool_link_.template accepts<SpoolCommand>(frame, now);
    if (!accepted && !spool_link_.refused_authentic()) {
      return std::nullopt;
    }
    SpoolRequest request{SpoolCommand::decode(frame.data)};
    const bool cut_known = request.command.pilot_cut.state == dbc::RawState::kValid;
    const bool cuts = cut_known && request.command.pilot_cut.value == SpoolCommand::PilotCut::kOn;
    const bool is_off = request.command.enable.state == dbc::RawState::kValid &&
                        request.command.enable.value == SpoolCommand::Enable::kOff;
    if (cuts) {
      plant_.set_pilot_cut(true);
    }
    if (!accepted) {
      if (enabled_ && (cuts || is_off)) {
        spool_link_.note_other_sender(now);
      }
      return std::nullopt;
    }
    if (cut_known && !cuts && !spool_link_.has_two_senders(now)) {
      plant_.set_pilot_cut(false);
    }
    request.enabled = lets_through(request.command, spool_silence_) && cut_known;
    return request;
  }
  /// SpoolCommand has been missing for `kCommandTimeoutUs`, or has two senders, from just now on.
  [[nodiscard]] bool spool_command_dies(TimeUs now) {
    const bool dies = spool_link_.dies(now);
    if (dies) {
      spool_silence_.command_lost();
    }
    return dies;
  }

  /// Runs the plant on by a cycle; what has been delayed for long enough goes out.
  void advance(TimeUs now) {
    plant_.advance(kCycleUs);
    if (faults_.engine_speed_turns_us > 0) {
      faults_.set_silent(Dbc::EEC1::kId, (now / faults_.engine_speed_turns_us) % 2 == 1);
    }
    sender_.send_late(faults_.frames, now);
    if (faults_.external && is_due<typename Dbc::ExternalLimit>(kExternalOffset)) {
      send(external_limit<Dbc>(*faults_.external), now);
    }
  }
  /// As EEC1 shows it.
  [[nodiscard]] dbc::Physical shown_engine_radps() {
    return engine_speed_.show(plant_.engine_radps(), faults_.engine_speed);
  }
  /// A message is sent in every cycle that is so far from the first one, modulo its cycle time.
  template <class Message>
  [[nodiscard]] bool is_due(std::uint64_t offset = 0) const {
    constexpr std::uint64_t kCycles = Message::kCycleTimeMs / 10;
    return cycle_ % kCycles == offset;
  }
  template <class Message>
  void send(const Message& message, TimeUs now) {
    sender_.send(message, faults_.frames, now);
  }
  /// Of another bus than the DBC's.
  void send_frame(const CanFrame& frame, TimeUs now) {
    sender_.send_frame(frame, faults_.frames, now);
  }
  /// From a node beside this one, under its source address.
  template <class Message>
  void send_from(std::uint8_t address, const Message& message, TimeUs now) {
    sender_.send_from(address, message, faults_.frames, now);
  }
  /// With `enabled`; the spools' places are the kind's.
  [[nodiscard]] typename Dbc::ValveState valve_state() const {
    using Enabled = typename Dbc::ValveState::Enabled;
    typename Dbc::ValveState message;
    message.enabled = {enabled_ ? Enabled::kOn : Enabled::kOff, dbc::RawState::kValid};
    return message;
  }
  /// Cycles before this one.
  [[nodiscard]] std::uint64_t cycle() const { return cycle_; }
  /// Last in a cycle of a machine that does not name itself.
  void end_silent_cycle() { ++cycle_; }
  /// Last in a cycle. The machine names itself every second, and when it is asked.
  void end_cycle(TimeUs now) {
    echo_.set_mute(faults_.cannot_answer);
    const bool is_asked = echo_.take_new();
    if (is_asked || is_due<typename Dbc::MachineIdentity>()) {
      typename Dbc::MachineIdentity message;
      message.profile_hash = {faults_.wrong_identity ? ~profile_hash_ : profile_hash_,
                              dbc::RawState::kValid};
      message.dbc_version = {Dbc::kDbcVersion, dbc::RawState::kValid};
      message.echo = echo_.said();
      send(message, now);
    }
    ++cycle_;
  }

  Plant plant_;
  Faults faults_;
  bool enabled_ = false;

 private:
  static constexpr std::uint64_t kExternalOffset = 3;

  CanPort& port_;
  FrameSender sender_;
  std::uint32_t profile_hash_;
  FaultyReading engine_speed_;
  StampEcho<typename Dbc::EcuIdentity> echo_;
  CommandLink spool_link_;
  NeutralFirst spool_silence_;
  std::uint64_t cycle_ = 0;
};

}  // namespace graben::plant
