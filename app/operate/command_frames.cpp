// SPDX-License-Identifier: Apache-2.0
#include "app/operate/command_frames.hpp"

#include <algorithm>
#include <cmath>

#include "can_dbc/generated/excavator_dbc.hpp"
#include "hal/link/message_rules.hpp"

namespace graben::operate {
namespace {

using Dbc = dbc::excavator::Dbc;
using Command = Dbc::OperatorCommand;
constexpr auto kValid = dbc::RawState::kValid;
static_assert(CommandFrames::kPeriod_us == Command::kCycleTimeMs * kMillisecondUs &&
              CommandFrames::kPeriod_us == Dbc::OperatorAxes::kCycleTimeMs * kMillisecondUs);

constexpr SendRule kCommandRule = send_rule<Command>(0, nullptr);
constexpr SendRule kAxesRule = send_rule<Dbc::OperatorAxes>(0, nullptr);

using Touched = Dbc::TouchedPoint;
constexpr SendRule kTouchRule = send_rule<Touched>(0, nullptr);

/// A step of the message less, towards the middle and no further.
double one_step_less(double ratio) {
  return std::copysign(std::max(0.0, std::abs(ratio) - kLeverStep), ratio);
}

dbc::Payload axes_payload(const Axes& axes, bool less) {
  const auto said = [less](double ratio) {
    return dbc::Physical{less ? one_step_less(ratio) : ratio, kValid};
  };
  Dbc::OperatorAxes message;
  message.boom_or_up_ratio = said(axes.boom_or_up_ratio);
  message.arm_or_forward_ratio = said(axes.arm_or_forward_ratio);
  message.bucket_or_attitude_ratio = said(axes.bucket_or_attitude_ratio);
  message.swing_ratio = said(axes.swing_ratio);
  return message.encode();
}

}  // namespace

dbc::Payload command_payload(const Request& request, dbc::Count echo) {
  Command command;
  command.enable = {request.enable ? Command::Enable::kOn : Command::Enable::kOff, kValid};
  command.operator_mode = {static_cast<Command::OperatorMode>(request.mode), kValid};
  command.task = {static_cast<Command::Task>(request.task), kValid};
  command.speed_override_ratio = {request.speed_override_ratio, kValid};
  command.echo = echo;
  return command.encode();
}

CommandPair CommandFrames::next(const Request& request, dbc::Count echo, TimeUs now) {
  const bool less = less_;
  less_ = !less_;
  return {next_frame(kCommandRule, command_, command_payload(request, echo), now),
          next_frame(kAxesRule, axes_, axes_payload(request.axes, less), now)};
}

CommandPair CommandFrames::last_words(TimeUs now) const {
  return CommandFrames(*this).next({}, {0, dbc::RawState::kNotAvailable}, now);
}

void TouchFrames::begin(TouchKind kind, TimeUs now) {
  kind_ = kind;
  number_ = static_cast<std::uint8_t>(number_ < Touched::kNumber.raw_max ? number_ + 1 : 0);
  has_begun_ = true;
  until_us_ = now + kSaid_us;
  next_us_ = now;
}

std::optional<CanFrame> TouchFrames::next(TimeUs now) {
  if (!has_begun_ || now < next_us_ || now >= until_us_) {
    return std::nullopt;
  }
  next_us_ = now + kTouchRule.period_us;
  Touched message;
  message.number = {number_, kValid};
  message.kind = {static_cast<Touched::Kind>(kind_), kValid};
  return next_frame(kTouchRule, touch_, message.encode(), now);
}

}  // namespace graben::operate
