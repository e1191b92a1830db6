#include "tests/fuzz/bus_partner.hpp"

#include <algorithm>

#include "hal/e2e.hpp"

namespace graben::test {
namespace {

namespace bus = dbc::excavator;
using dbc::RawState;

constexpr std::array<double, kAxisCount> kStart_m = {1.05, 1.1, 0.4};
constexpr double kEndMargin_m = 0.02;
constexpr double kSwash = 0.643;
constexpr double kEngine_radps = 188.5;
constexpr double kCap_pa = 4e6;
constexpr double kRod_pa = 3e6;
constexpr double kPressurePerStroke_papm = 1e6;  ///< No pressure stands still in motion.
constexpr TimeUs kValveTimeout_us = 100 * kMillisecondUs;
constexpr TimeUs kReleased_us = 60 * kMillisecondUs;
constexpr TimeUs kPatience_us = 300 * kMillisecondUs;
constexpr std::size_t kRemembered = 64;

constexpr dbc::Physical physical(double value) { return {value, RawState::kValid}; }

static_assert(bus::kMessages[kInputMessages - 1].id == bus::ValveState::kId);
static_assert(bus::kMessages[kInputMessages].id == bus::SpoolCommand::kId);

}  // namespace

const dbc::MessageInfo& input_message(unsigned index) {
  return bus::kMessages[index % kInputMessages];
}

BusPartner::BusPartner(const ExcavatorProfile& profile, std::uint32_t profile_hash,
                       ScriptedPort& port, TimeUs now)
    : profile_(profile),
      profile_hash_(profile_hash),
      port_(port),
      now_(now),
      strokes_m_(kStart_m),
      command_us_(now),
      enabled_since_us_(now),
      released_since_us_(now) {
  due_us_.fill(now);
}

void BusPartner::listen(TimeUs now) {
  for (const SentFrame& sent : port_.sent) {
    if (!sent.taken) {
      continue;
    }
    if (sent.frame.id == bus::SpoolCommand::kId) {
      command_ = bus::SpoolCommand::decode(sent.frame.data);
      command_us_ = now;
    } else if (sent.frame.id == bus::EcuStatus::kId) {
      status_ = bus::EcuStatus::decode(sent.frame.data);
    } else if (sent.frame.id == bus::EcuMotion::kId) {
      motion_ = bus::EcuMotion::decode(sent.frame.data);
    }
  }
}

void BusPartner::move(double elapsed_s) {
  const bool follows = command_.enable.value == bus::SpoolCommand::Enable::kOn;
  const double lambda = follows ? status_.lambda.value : 0.0;
  const std::array<double, kAxisCount> wanted_mps = {motion_.boom_wanted_velocity_mps.value,
                                                     motion_.arm_wanted_velocity_mps.value,
                                                     motion_.bucket_wanted_velocity_mps.value};
  for (unsigned i = 0; i < kAxisCount; ++i) {
    const double most_m = profile_.geometry.cylinder[i].stroke_m - kEndMargin_m;
    strokes_m_[i] += (lambda * wanted_mps[i] + pushed_mps[i]) * elapsed_s;
    strokes_m_[i] = std::clamp(strokes_m_[i], kEndMargin_m, most_m);
  }
}

void BusPartner::run_until(TimeUs now) {
  listen(now_);
  if (now - command_us_ > kValveTimeout_us) {
    command_ = {};
  }
  move(static_cast<double>(now - now_) * 1e-6);
  now_ = now;
  // Message by message would put those of a long pause in an order that no bus has.
  for (bool any = true; any;) {
    any = false;
    for (unsigned message = 0; message < kInputMessages; ++message) {
      if (due_us_[message] <= now) {
        send(message, due_us_[message]);
        due_us_[message] += input_message(message).cycle_time_ms * kMillisecondUs;
        any = true;
      }
    }
  }
}

void BusPartner::lead_to_active() {
  using Mode = bus::EcuStatus::Mode;
  const Mode mode = status_.mode.value;
  const bool in_motion = mode == Mode::kArmed || mode == Mode::kActive;
  const bool ready = mode == Mode::kReady;
  const OperatorHand last = hand;
  hand = {};
  if (in_motion) {
    hand.enable = true;
    hand.dig = true;
  } else if (last.enable) {
    // Once more from the start, if it does not arm.
    hand.enable = ready && now_ - enabled_since_us_ < kPatience_us;
  } else {
    hand.enable = ready && now_ - released_since_us_ >= kReleased_us;
  }
  if (hand.enable != last.enable || last.dig != hand.dig || !last.automatic) {
    (hand.enable ? enabled_since_us_ : released_since_us_) = now_;
  }
}

void BusPartner::mend() {
  muted = 0;
  replaced = {};
  spoilt = {};
  for (unsigned i = 0; i < kAxisCount; ++i) {
    if (pushed_mps[i] != 0.0) {
      strokes_m_ = kStart_m;
    }
  }
  pushed_mps = {};
}

dbc::Payload BusPartner::payload_of(unsigned message) const {
  const auto cap = [this](unsigned i) {
    return physical(kCap_pa + kPressurePerStroke_papm * strokes_m_[i]);
  };
  const auto rod = [this](unsigned i) {
    return physical(kRod_pa - kPressurePerStroke_papm * strokes_m_[i]);
  };
  switch (input_message(message).id) {
    case bus::BoomStroke::kId:
      return bus::BoomStroke{physical(strokes_m_[0])}.encode();
    case bus::ArmStroke::kId:
      return bus::ArmStroke{physical(strokes_m_[1])}.encode();
    case bus::BucketStroke::kId:
      return bus::BucketStroke{physical(strokes_m_[2])}.encode();
    case bus::BoomPressure::kId:
      return bus::BoomPressure{cap(0), rod(0)}.encode();
    case bus::ArmPressure::kId:
      return bus::ArmPressure{cap(1), rod(1)}.encode();
    case bus::BucketPressure::kId:
      return bus::BucketPressure{cap(2), rod(2)}.encode();
    case bus::PumpState::kId:
      return bus::PumpState{physical(kSwash), physical(kSwash)}.encode();
    case bus::EEC1::kId:
      return bus::EEC1{physical(kEngine_radps)}.encode();
    case bus::MachineIdentity::kId:
      return bus::MachineIdentity{{profile_hash_, RawState::kValid},
                                  {bus::kDbcVersion, RawState::kValid}}
          .encode();
    case bus::OperatorCommand::kId: {
      using Command = bus::OperatorCommand;
      Command command;
      command.enable.value = hand.enable ? Command::Enable::kOn : Command::Enable::kOff;
      command.operator_mode.value =
          hand.automatic ? Command::OperatorMode::kAutomatic : Command::OperatorMode::kManual;
      command.task.value = hand.dig ? Command::Task::kDig : Command::Task::kNone;
      command.speed_override_ratio = physical(hand.speed_ratio);
      return command.encode();
    }
    default:
      break;
  }
  using Valve = bus::ValveState;
  const bool enabled = command_.enable.value == bus::SpoolCommand::Enable::kOn;
  return Valve{{enabled ? Valve::Enabled::kOn : Valve::Enabled::kOff, RawState::kValid},
               physical(command_.boom_duty_ratio.value),
               physical(command_.arm_duty_ratio.value),
               physical(command_.bucket_duty_ratio.value)}
      .encode();
}

void BusPartner::send(unsigned message, TimeUs now) {
  const dbc::MessageInfo& info = input_message(message);
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
        spoils && spoil.masquerade ? input_message(message + 1).data_id : info.data_id;
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

void BusPartner::put_protected(unsigned message, dbc::Payload payload, std::uint8_t skip) {
  const dbc::MessageInfo& info = input_message(message);
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

void BusPartner::replay(unsigned count) {
  const std::size_t first = last_sent_.size() > count ? last_sent_.size() - count : 0;
  for (std::size_t i = first; i < last_sent_.size(); ++i) {
    port_.put(last_sent_[i]);
  }
}

}  // namespace graben::test
