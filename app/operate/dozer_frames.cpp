// SPDX-License-Identifier: Apache-2.0
#include "app/operate/dozer_frames.hpp"

#include "app/operate/command_frames.hpp"
#include "can_dbc/generated/dozer_dbc.hpp"
#include "hal/link/message_rules.hpp"

namespace graben::operate {
namespace {

using Dbc = dbc::dozer::Dbc;
using Try = Dbc::DozerTry;
using WindowMessage = Dbc::DozerWindow;
constexpr auto kSaid = dbc::RawState::kValid;

constexpr SendRule kCommandRule = send_rule<Dbc::OperatorCommand>(0, nullptr);
constexpr SendRule kTryRule = send_rule<Try>(0, nullptr);
constexpr SendRule kWindowRule = send_rule<WindowMessage>(0, nullptr);
constexpr unsigned kWindowCalls = kWindowRule.period_us / CommandFrames::kPeriod_us;
static_assert(kTryRule.period_us == CommandFrames::kPeriod_us &&
              kCommandRule.period_us == CommandFrames::kPeriod_us && kWindowCalls == 5);

dbc::Payload try_payload(const DozerTry& tried) {
  Try message;
  message.drive = {static_cast<Try::Drive>(tried.drive), kSaid};
  message.ratio_ratio = {tried.ratio, kSaid};
  message.motor_ratio = {tried.motor_ratio, kSaid};
  return message.encode();
}

dbc::Payload window_payload(unsigned drive, const commission::Window& window) {
  WindowMessage message;
  message.drive = {static_cast<WindowMessage::Drive>(drive), kSaid};
  message.least_m = {window.least_m, kSaid};
  message.most_m = {window.most_m, kSaid};
  message.most_speed_mps = {window.most_mps, kSaid};
  return message.encode();
}

}  // namespace

std::vector<CanFrame> DozerFrames::next(const Request& request, const DozerTries& tries,
                                        dbc::Count echo, TimeUs now) {
  std::vector<CanFrame> frames = {
      next_frame(kCommandRule, command_, command_payload(request, echo), now),
      next_frame(kTryRule, try_, try_payload(tries.tried), now)};
  if (calls_++ % kWindowCalls == 0) {
    put_window(tries, now, frames);
  }
  return frames;
}

std::array<CanFrame, 1> DozerFrames::last_words(TimeUs now) const {
  SendState state = command_;
  return {
      next_frame(kCommandRule, state, command_payload({}, {0, dbc::RawState::kNotAvailable}), now)};
}

void DozerFrames::put_window(const DozerTries& tries, TimeUs now, std::vector<CanFrame>& to) {
  for (unsigned n = 0; n < kTriedCount; ++n) {
    turn_ = (turn_ + 1) % kTriedCount;
    if (tries.has_window[turn_]) {
      to.push_back(
          next_frame(kWindowRule, window_, window_payload(turn_, tries.window[turn_]), now));
      return;
    }
  }
}

}  // namespace graben::operate
