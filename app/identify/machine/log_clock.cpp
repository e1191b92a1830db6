// SPDX-License-Identifier: Apache-2.0
#include "app/identify/machine/log_clock.hpp"

#include <algorithm>
#include <cmath>

#include "app/identify/machine/candump_reader.hpp"

namespace graben::identify {

void LogClock::give(LoggedFrame frame, double time_s) {
  last_s_ = any_ ? std::max(last_s_, time_s) : time_s;
  any_ = true;
  frame.time_s = last_s_;
  frame.piece = piece_;
  take_(frame);
}

void LogClock::begin_piece(const LoggedFrame& frame, double by_s) {
  if (by_s < 0.0) {
    offset_s_ = last_s_ + kBehind_s - frame.time_s;
  }
  ++piece_;
  breaks_.push_back({frame.line, by_s});
}

void LogClock::judge(const LoggedFrame& frame) {
  const double ahead_s = any_ ? frame.time_s - said_s_ : 0.0;
  if (ahead_s >= -kDisorder_s && ahead_s <= kLeap_s) {
    garbled_ += held_.size();
    held_.clear();
    if (ahead_s > kGap_s) {
      begin_piece(frame, ahead_s);
    }
    disordered_ += ahead_s < 0.0 ? 1 : 0;
    said_s_ = std::max(said_s_, frame.time_s);
    if (!any_) {
      said_s_ = frame.time_s;
    }
    return give(frame, frame.time_s + offset_s_);
  }
  const bool agrees = !held_.empty() && std::abs(frame.time_s - held_.front().time_s) < kDisorder_s;
  if (!agrees) {
    garbled_ += held_.size();
    held_.assign(1, frame);
    return;
  }
  const LoggedFrame first = held_.front();
  held_.clear();
  begin_piece(first, first.time_s - said_s_);
  said_s_ = std::max(first.time_s, frame.time_s);
  give(first, first.time_s + offset_s_);
  give(frame, frame.time_s + offset_s_);
}

void LogClock::end() {
  garbled_ += held_.size();
  held_.clear();
}

}  // namespace graben::identify
