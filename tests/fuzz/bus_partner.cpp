// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/bus_partner.hpp"

#include <algorithm>

#include "hal/link/e2e.hpp"
#include "tests/fuzz/dozer_bus.hpp"
#include "tests/fuzz/excavator_bus.hpp"

namespace graben::test {
namespace {

constexpr TimeUs kValveTimeout_us = 100 * kMillisecondUs;
constexpr TimeUs kReleased_us = 60 * kMillisecondUs;
constexpr TimeUs kPatience_us = 300 * kMillisecondUs;
constexpr std::size_t kRemembered = 64;

}  // namespace

template <class Kind>
BusPartner<Kind>::BusPartner(const typename Kind::Profile& profile, std::uint32_t profile_hash,
                             ScriptedPort& port, TimeUs now)
    : body(profile),
      profile_hash_(profile_hash),
      port_(port),
      now_(now),
      command_us_(now),
      enabled_since_us_(now),
      released_since_us_(now) {
  due_us_.fill(now);
}

template <class Kind>
void BusPartner<Kind>::listen(TimeUs now) {
  for (const SentFrame& sent : port_.sent) {
    if (!sent.taken) {
      continue;
    }
    body.hear(sent.frame);
    if (sent.frame.id == Kind::Dbc::SpoolCommand::kId) {
      command_us_ = now;
    } else if (sent.frame.id == Kind::Dbc::EcuStatus::kId) {
      status_ = Kind::Dbc::EcuStatus::decode(sent.frame.data);
    }
  }
}

template <class Kind>
void BusPartner<Kind>::run_until(TimeUs now) {
  listen(now_);
  if (now - command_us_ > kValveTimeout_us) {
    body.close();
  }
  body.move(static_cast<double>(now - now_) * 1e-6);
  now_ = now;
  // Message by message would put those of a long pause in an order that no bus has.
  for (bool any = true; any;) {
    any = false;
    for (unsigned message = 0; message < kInputMessages; ++message) {
      if (due_us_[message] <= now) {
        send(message, due_us_[message]);
        due_us_[message] += input_message<Kind>(message).cycle_time_ms * kMillisecondUs;
        any = true;
      }
    }
  }
}

template <class Kind>
void BusPartner<Kind>::lead_to_active() {
  using Mode = typename Kind::Dbc::EcuStatus::Mode;
  const Mode mode = status_.mode.value;
  const bool in_motion = mode == Mode::kArmed || mode == Mode::kActive;
  const bool ready = mode == Mode::kReady;
  const OperatorHand last = hand;
  hand = {};
  if (in_motion) {
    hand.enable = true;
    hand.task = true;
  } else if (last.enable) {
    // Once more from the start, if it does not arm.
    hand.enable = ready && now_ - enabled_since_us_ < kPatience_us;
  } else {
    hand.enable = ready && now_ - released_since_us_ >= kReleased_us;
  }
  if (hand.enable != last.enable || last.task != hand.task || !last.automatic) {
    (hand.enable ? enabled_since_us_ : released_since_us_) = now_;
  }
}

template <class Kind>
void BusPartner<Kind>::mend() {
  muted = 0;
  replaced = {};
  spoilt = {};
  body.mend();
}

template <class Kind>
dbc::Payload BusPartner<Kind>::payload_of(unsigned message) const {
  using dbc::RawState;
  using Command = typename Kind::Dbc::OperatorCommand;
  using Identity = typename Kind::Dbc::MachineIdentity;
  const std::uint32_t id = input_message<Kind>(message).id;
  if (id == Identity::kId) {
    return Identity{{profile_hash_, RawState::kValid}, {Kind::Dbc::kDbcVersion, RawState::kValid}}
        .encode();
  }
  if (id != Command::kId) {
    return body.payload_of(id);
  }
  Command command;
  command.enable.value = hand.enable ? Command::Enable::kOn : Command::Enable::kOff;
  command.operator_mode.value =
      hand.automatic ? Command::OperatorMode::kAutomatic : Command::OperatorMode::kManual;
  command.task.value = hand.task ? Kind::kTask : Command::Task::kNone;
  command.speed_override_ratio = {hand.speed_ratio, RawState::kValid};
  return command.encode();
}

template <class Kind>
void BusPartner<Kind>::send(unsigned message, TimeUs now) {
  const dbc::MessageInfo& info = input_message<Kind>(message);
  if (((muted >> message) & 1U) != 0U) {
    return;
  }
  CanFrame frame;
  frame.id = info.id;
  frame.length = info.length;
  frame.stamp_us = now;
  frame.data = payload_of(message);
  const Replacement& replacement = replaced[message];
  for (unsigned i = 0; i < frame.data.size(); ++i) {
    if (((replacement.mask >> i) & 1U) != 0U) {
      frame.data[i] = replacement.payload[i];
    }
  }
  Spoil& spoil = spoilt[message];
  const bool spoils = spoil.frames > 0;
  if (info.is_protected) {
    const std::uint16_t data_id =
        spoils && spoil.masquerade ? input_message<Kind>(message + 1).data_id : info.data_id;
    e2e_protect(frame.data, data_id, counter_[message]);
    counter_[message] = e2e_next_counter(counter_[message]);
  }
  if (spoils) {
    --spoil.frames;
    std::uint8_t& byte = frame.data[spoil.byte % frame.data.size()];
    byte = static_cast<std::uint8_t>(byte ^ spoil.flip);
  }
  port_.put(frame);
  last_sent_.push_back(frame);
  if (last_sent_.size() > kRemembered) {
    last_sent_.pop_front();
  }
}

template <class Kind>
void BusPartner<Kind>::put_protected(unsigned message, dbc::Payload payload, std::uint8_t skip) {
  const dbc::MessageInfo& info = input_message<Kind>(message);
  std::uint8_t& next = counter_[message % kInputMessages];
  const auto counter = static_cast<std::uint8_t>((next + skip) % kE2eCounterCount);
  CanFrame frame;
  frame.id = info.id;
  frame.length = info.length;
  frame.stamp_us = now_;
  frame.data = payload;
  if (info.is_protected) {
    e2e_protect(frame.data, info.data_id, counter);
    next = skip == 0 ? e2e_next_counter(counter) : next;
  }
  port_.put(frame);
}

template <class Kind>
void BusPartner<Kind>::replay(unsigned count) {
  const std::size_t first = last_sent_.size() > count ? last_sent_.size() - count : 0;
  for (std::size_t i = first; i < last_sent_.size(); ++i) {
    port_.put(last_sent_[i]);
  }
}

template class BusPartner<ExcavatorBus>;
template class BusPartner<DozerBus>;

}  // namespace graben::test
