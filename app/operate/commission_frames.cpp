// SPDX-License-Identifier: Apache-2.0
#include "app/operate/commission_frames.hpp"

#include "can_dbc/generated/excavator_dbc.hpp"
#include "hal/link/message_rules.hpp"

namespace graben::operate {
namespace {

using Dbc = dbc::excavator::Dbc;
using Duty = Dbc::CommissionDuty;
using WindowMessage = Dbc::CommissionWindow;
constexpr auto kSaid = dbc::RawState::kValid;

constexpr SendRule kDutyRule = send_rule<Duty>(0, nullptr);
constexpr SendRule kWindowRule = send_rule<WindowMessage>(0, nullptr);
constexpr unsigned kWindowCalls = kWindowRule.period_us / CommandFrames::kPeriod_us;
static_assert(kDutyRule.period_us == CommandFrames::kPeriod_us && kWindowCalls == 5);

dbc::Payload duty_payload(const std::array<double, kAxisCount>& duty_ratio) {
  Duty duty;
  duty.boom_duty_ratio = {duty_ratio[kBoom], kSaid};
  duty.arm_duty_ratio = {duty_ratio[kArm], kSaid};
  duty.bucket_duty_ratio = {duty_ratio[kBucket], kSaid};
  return duty.encode();
}

dbc::Payload window_payload(unsigned axis, const commission::Window& window) {
  WindowMessage message;
  message.drive = {static_cast<WindowMessage::Drive>(axis), kSaid};
  message.least_stroke_m = {window.least_m, kSaid};
  message.most_stroke_m = {window.most_m, kSaid};
  message.most_speed_mps = {window.most_mps, kSaid};
  return message.encode();
}

}  // namespace

std::vector<CanFrame> CommissionFrames::next(const Request& request, const TriedDuties& tried,
                                             dbc::Count echo, TimeUs now) {
  const CommandPair pair = command_.next(request, echo, now);
  std::vector<CanFrame> frames(pair.begin(), pair.end());
  frames.push_back(next_frame(kDutyRule, duty_, duty_payload(tried.duty_ratio), now));
  if (calls_++ % kWindowCalls == 0) {
    put_window(tried, now, frames);
  }
  return frames;
}

void CommissionFrames::put_window(const TriedDuties& tried, TimeUs now, std::vector<CanFrame>& to) {
  for (unsigned n = 0; n < kAxisCount; ++n) {
    turn_ = (turn_ + 1) % kAxisCount;
    if (tried.has_window[turn_]) {
      to.push_back(
          next_frame(kWindowRule, window_, window_payload(turn_, tried.window[turn_]), now));
      return;
    }
  }
}

}  // namespace graben::operate
