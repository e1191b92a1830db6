// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/bus_run.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

#include "firmware/safety/tuning.hpp"
#include "hal/link/e2e.hpp"
#include "tests/fuzz/dozer_bus.hpp"
#include "tests/fuzz/excavator_bus.hpp"

namespace graben::test {
namespace {

using dbc::RawState;

constexpr TimeUs kNever = std::numeric_limits<TimeUs>::min() / 2;
constexpr auto kIdentity_us = static_cast<TimeUs>(kIdentityTimeout_s * 1e6);
/// After so many in a row the last one is in use whatever came before: two that are late, one that
/// repeats, three until the counter is believed, and one to spare.
constexpr int kBeyondDoubt = 7;

bool is_valid(RawState state) { return state == RawState::kValid; }
bool is_in_range(RawState state) { return state != RawState::kOutOfRange; }

template <class Message>
bool every_value_is(const dbc::Payload& payload, bool (*good)(RawState)) {
  bool all = true;
  const Message message = Message::decode(payload);
  Message::visit(message, [&](const dbc::Field& field, const auto& signal) {
    // The shipped dozer has no tilt: what is said of its spool counts only where it can't be said.
    const bool unused = std::strcmp(field.name, "TiltSpool") == 0 && is_in_range(signal.state);
    all = all && (unused || good(signal.state));
  });
  return all;
}

template <class... Messages>
bool values_are(dbc::MessageList<Messages...>, const CanFrame& frame, bool (*good)(RawState)) {
  return ((same_message(frame.id, Messages::kId) && every_value_is<Messages>(frame.data, good)) ||
          ...);
}

bool has_form(const CanFrame& frame, const dbc::MessageInfo& info) {
  return same_message(frame.id, info.id) && frame.extended && !frame.remote && !frame.error &&
         !frame.fd && frame.length == info.length;
}

bool is_whole(const CanFrame& frame, const dbc::MessageInfo& info) {
  return has_form(frame, info) && (!info.is_protected || e2e_crc_fits(frame.data, info.data_id));
}

template <class Kind>
bool wants_motion(const CanFrame& frame) {
  using Command = typename Kind::Dbc::OperatorCommand;
  const Command command = Command::decode(frame.data);
  return command.enable.value == Command::Enable::kOn &&
         command.operator_mode.value == Command::OperatorMode::kAutomatic &&
         command.task.value == Kind::kTask;
}

/// With an answer to the controller's challenge, which a station need not give.
template <class Message>
void answer(CanFrame& frame) {
  if (same_message(frame.id, Message::kId)) {
    dbc::insert(frame.data, Message::kEcho.start_bit, Message::kEcho.width, 0);
  }
}

}  // namespace

template <class Kind>
BusEvidence<Kind>::BusEvidence(const typename Kind::Profile& profile, std::uint32_t profile_hash)
    : timeout_us_(static_cast<TimeUs>(profile.control.sensor_timeout_s * 1e6)),
      profile_hash_(profile_hash),
      released_us_(kNever) {
  said_us_.fill(kNever);
  run_.last_us = kNever;
}

template <class Kind>
void BusEvidence<Kind>::note_operator(const CanFrame& frame, bool alone, TimeUs now) {
  using Command = typename Kind::Dbc::OperatorCommand;
  constexpr TimeUs kCycle_us = Command::kCycleTimeMs * kMillisecondUs;
  const int counter = frame.data[1] & 0x0F;
  const auto task = Command::decode(frame.data).task.value;
  // Another kind's task is refused as a value out of range is.
  const bool in_range = every_value_is<Command>(frame.data, is_in_range) &&
                        (task == Command::Task::kNone || task == Kind::kTask);
  const bool next = counter == (run_.counter + 1) % kE2eCounterCount &&
                    now - run_.last_us >= kCycle_us * 4 / 5 && now - run_.last_us <= 2 * kCycle_us;
  if (!alone || !in_range || counter >= kE2eCounterCount) {
    run_.frames = 0;
  } else {
    run_.frames = next ? run_.frames + 1 : 1;
  }
  run_.counter = counter;
  run_.last_us = now;
  run_.wants_motion = wants_motion<Kind>(frame);
  const Command command = Command::decode(frame.data);
  released_us_ = command.enable.value == Command::Enable::kOff ? now : released_us_;
}

template <class Kind>
void BusEvidence<Kind>::note(const std::vector<CanFrame>& received, bool stale, TimeUs now) {
  const auto of_operator =
      std::count_if(received.begin(), received.end(), [](const CanFrame& frame) {
        return same_message(frame.id, Kind::Dbc::OperatorCommand::kId);
      });
  for (const CanFrame& frame : received) {
    for (unsigned i = 0; i < kInputMessages; ++i) {
      const dbc::MessageInfo& info = input_message<Kind>(i);
      const bool is_operator = info.id == Kind::Dbc::OperatorCommand::kId;
      if (!is_whole(frame, info)) {
        run_.frames = is_operator && same_message(frame.id, info.id) ? 0 : run_.frames;
        continue;
      }
      if (is_operator) {
        note_operator(frame, of_operator == 1, now);
      }
      CanFrame answered = frame;
      answer<typename Kind::Dbc::OperatorCommand>(answered);
      answer<typename Kind::Dbc::MachineIdentity>(answered);
      if (values_are(typename Kind::Dbc::AllMessages{}, answered, is_valid) &&
          (!is_operator || wants_motion<Kind>(frame))) {
        said_us_[i] = now;
      }
      if (info.id == Kind::Dbc::MachineIdentity::kId &&
          values_are(typename Kind::Dbc::AllMessages{}, frame, is_in_range)) {
        const auto identity = Kind::Dbc::MachineIdentity::decode(frame.data);
        const bool is_other = identity.profile_hash.value != profile_hash_ ||
                              identity.dbc_version.value != Kind::Dbc::kDbcVersion;
        other_machine_ = is_other && (other_machine_ || !stale);
      }
    }
  }
  run_.frames = stale ? 0 : run_.frames;
}

template <class Kind>
const char* BusEvidence<Kind>::against_motion(TimeUs now) const {
  for (unsigned i = 0; i < kInputMessages; ++i) {
    const dbc::MessageInfo& info = input_message<Kind>(i);
    const TimeUs age_us = now - said_us_[i];
    if (Kind::is_needed(info.id) && age_us > timeout_us_) {
      return info.name;
    }
    if (info.id == Kind::Dbc::MachineIdentity::kId && (age_us > kIdentity_us || other_machine_)) {
      return info.name;
    }
  }
  return run_.frames >= kBeyondDoubt && !run_.wants_motion ? "an operator who has released" : "";
}

template class BusEvidence<ExcavatorBus>;
template class BusEvidence<DozerBus>;

}  // namespace graben::test
