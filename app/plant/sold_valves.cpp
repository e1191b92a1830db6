// SPDX-License-Identifier: Apache-2.0
#include "app/plant/sold_valves.hpp"

#include <algorithm>

namespace graben::plant {
namespace {

/// Under the controller's address; one message a valve, in the byte above it.
constexpr std::uint32_t kAuxiliaryId = 0x0CFE3082;
constexpr std::uint32_t kDriverId = 0x0CFF4082;
constexpr unsigned kValveShift = 8;

constexpr double kFlowStep = 0.004;
constexpr unsigned kMostFlow = 250;
constexpr unsigned kStateBits = 0x0F;

constexpr unsigned kLeastDither_hz = 50;
constexpr unsigned kMostDither_hz = 300;

unsigned word(const CanFrame& frame, std::size_t first) {
  return frame.data[first] | static_cast<unsigned>(frame.data[first + 1]) << 8U;
}

double share_of(unsigned current_ma) {
  return std::clamp(
      (current_ma - SoldValves::kLeast_ma) / (SoldValves::kMost_ma - SoldValves::kLeast_ma), 0.0,
      1.0);
}

}  // namespace

bool SoldValves::read_auxiliary(const CanFrame& frame, double& duty) {
  const unsigned state = frame.data[2] & kStateBits;
  if (frame.data[0] > kMostFlow || state > 2) {
    return false;
  }
  const double flow = kFlowStep * frame.data[0];
  duty = state == 1 ? flow : state == 2 ? -flow : 0.0;
  return true;
}

bool SoldValves::read_driver(const CanFrame& frame, Valve& valve) {
  const unsigned extend_ma = word(frame, 0);
  const unsigned retract_ma = word(frame, 2);
  const unsigned dither_hz = word(frame, 4);
  const bool goes_on = valve.counts && frame.data[7] != valve.counter;
  valve.counts = true;
  valve.counter = frame.data[7];
  if (!goes_on || dither_hz < kLeastDither_hz || dither_hz > kMostDither_hz ||
      (extend_ma != 0 && retract_ma != 0)) {
    return false;
  }
  valve.duty = (frame.data[6] & 1U) != 0 ? share_of(extend_ma) - share_of(retract_ma) : 0.0;
  return true;
}

void SoldValves::take(const CanFrame& frame, TimeUs now) {
  const std::uint32_t first = kind_ == Kind::kAuxiliary ? kAuxiliaryId : kDriverId;
  for (std::uint32_t n = 0; n < kAxisCount; ++n) {
    if (frame.id != first + (n << kValveShift) || !frame.extended || frame.remote ||
        frame.length != 8) {
      continue;
    }
    Valve& valve = valve_[n];
    const bool good =
        kind_ == Kind::kAuxiliary ? read_auxiliary(frame, valve.duty) : read_driver(frame, valve);
    if (good) {
      valve.told = true;
      valve.told_us = now;
    }
  }
}

void SoldValves::decide(TimeUs now) {
  bool told = true;
  bool neutral = true;
  for (const Valve& valve : valve_) {
    told = told && valve.told && now - valve.told_us <= kTimeoutUs;
    neutral = neutral && valve.duty == 0.0;
  }
  needs_neutral_ = !told || (needs_neutral_ && !neutral);
  drives_ = told && !needs_neutral_;
}

}  // namespace graben::plant
