// SPDX-License-Identifier: Apache-2.0
#include "hal/buses/table_transmitter.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/core/whole.hpp"
#include "hal/buses/may_move.hpp"
#include "hal/link/e2e.hpp"

namespace graben {
namespace {

bool is_share(double ratio) { return std::isfinite(ratio) && ratio > 0.0; }

/// CiA 301: the command specifier of 'start remote node'.
constexpr std::uint8_t kStartNode = 1;

double from_least(double share, double least) {
  return share > 0.0 ? least + (1.0 - least) * std::min(1.0, share) : 0.0;
}

bool is_of_drive(SinkPlace place) {
  return place == SinkPlace::kDuty || place == SinkPlace::kExtend || place == SinkPlace::kRetract ||
         place == SinkPlace::kFlow || place == SinkPlace::kSide;
}

double of_drive(const TableSink& sink, double duty_ratio) {
  if (sink.place == SinkPlace::kDuty) {
    return duty_ratio;
  }
  if (sink.place == SinkPlace::kSide) {
    return duty_ratio > 0.0 ? 1.0 : duty_ratio < 0.0 ? 2.0 : 0.0;
  }
  if (sink.place == SinkPlace::kFlow) {
    return from_least(std::abs(duty_ratio), sink.least);
  }
  return from_least(sink.place == SinkPlace::kExtend ? duty_ratio : -duty_ratio, sink.least);
}

double of_machine(const TableSink& sink, const ExcavatorOutputs& outputs, bool moves) {
  switch (sink.place) {
    case SinkPlace::kEnable:
      return moves ? 1.0 : 0.0;
    case SinkPlace::kPilotCut:
      return outputs.pilot_known && outputs.pilot_cut ? 1.0 : 0.0;
    case SinkPlace::kSwash: {
      const double swash_ratio = outputs.swash_ratio[sink.index % kPumpCount];
      return moves && is_share(swash_ratio) ? swash_ratio : 0.0;
    }
    default:
      return 0.0;
  }
}

double value_of(const TableSink& sink, const ExcavatorOutputs& outputs) {
  const bool moves = may_move(outputs);
  return is_of_drive(sink.place) ? of_drive(sink, moves ? outputs.duty_ratio[sink.index] : 0.0)
                                 : of_machine(sink, outputs, moves);
}

/// Of a constant the offset is the raw value.
std::int64_t raw_value(const TableSink& sink, const ExcavatorOutputs& outputs) {
  const auto span = as_double(std::int64_t{1} << sink.bits.width);
  const double least = sink.bits.is_signed ? -0.5 * span : 0.0;
  const double most = (sink.bits.is_signed ? 0.5 * span : span) - 1.0;
  const double raw = sink.place == SinkPlace::kConstant
                         ? sink.offset
                         : (value_of(sink, outputs) - sink.offset) / sink.scale;
  return static_cast<std::int64_t>(std::floor(std::clamp(raw, least, most) + 0.5));
}

}  // namespace

CanFrame TableTransmitter::frame_of(std::size_t message, const ExcavatorOutputs& outputs,
                                    TimeUs now, SendState& state) const {
  const TableSend& send = table_->send[message];
  CanFrame frame;
  frame.id = send.rule.id;
  frame.extended = send.extended;
  frame.length = send.length;
  frame.bus = send.bus;
  frame.stamp_us = now;
  std::fill(frame.data.begin(), frame.data.begin() + send.length, send.fill);
  for (std::size_t n = send.first; n < std::size_t{send.first} + send.count; ++n) {
    put_raw(table_->sink[n].bits, raw_value(table_->sink[n], outputs), frame.data);
  }
  if (send.protection == TableProtection::kE2e) {
    e2e_protect(frame.data, send.rule.data_id, state.counter);
    state.counter = e2e_next_counter(state.counter);
  } else if (send.protection == TableProtection::kCounter) {
    put_raw(send.counter, state.counter, frame.data);
    ++state.counter;  // It wraps with its bits, of which there are no more than eight.
  }
  return frame;
}

bool TableTransmitter::falls_silent(const ExcavatorOutputs& outputs) {
  const bool is_due = outputs.pilot_known && outputs.pilot_cut && !table_->has_cut;
  cut_cycles_ = is_due ? std::min(cut_cycles_ + 1, kNeutralCycles + 1) : 0;
  return cut_cycles_ > kNeutralCycles;
}

std::size_t TableTransmitter::frames(const ExcavatorOutputs& outputs, TimeUs now, Frames& out) {
  if (!active()) {
    return 0;
  }
  if (!started_) {
    started_ = true;
    for (std::size_t i = 0; i < table_->send_count; ++i) {
      state_[i].due_us = now + table_->send[i].rule.phase_us;
    }
  }
  const bool enabled = may_move(outputs);
  const bool silent = falls_silent(outputs);
  std::size_t written = 0;
  if (start_.id != 0) {
    CanFrame& start = out[written++];
    start = {};
    start.extended = false;
    start.length = 2;
    start.data = {kStartNode, start_.id};
    start.bus = start_.bus;
    start.stamp_us = now;
    start_ = {};
  }
  for (std::size_t i = 0; i < table_->send_count; ++i) {
    const TableSend& send = table_->send[i];
    if (send.has_enable && enabled != enabled_) {
      state_[i].due_us = now;
    }
    if (take_due(state_[i].due_us, send.rule.period_us, now) && !silent) {
      out[written++] = frame_of(i, outputs, now, state_[i]);
    }
  }
  enabled_ = enabled;
  return written;
}

std::size_t TableTransmitter::next_commands(const ExcavatorOutputs& outputs, TimeUs now,
                                            Frames& out) const {
  std::size_t written = 0;
  for (std::size_t i = 0; active() && i < table_->send_count; ++i) {
    if (table_->send[i].commands) {
      SendState state = state_[i];
      out[written++] = frame_of(i, outputs, now, state);
    }
  }
  return written;
}

bool TableTransmitter::is_command(std::uint32_t id) const {
  for (std::size_t i = 0; active() && i < table_->send_count; ++i) {
    if (table_->send[i].rule.id == id && table_->send[i].commands) {
      return true;
    }
  }
  return false;
}

}  // namespace graben
