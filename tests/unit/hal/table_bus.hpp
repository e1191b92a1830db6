// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Another bus than ours, for tests: angles and a state in, levers and a setting out.

#include "hal/buses/excavator_bus.hpp"

namespace graben::test {

inline constexpr std::uint32_t kAngles = 0x18FF7DE8;
inline constexpr std::uint32_t kState = 0x18FF84E8;
inline constexpr std::uint32_t kLevers = 0x18FF640A;
inline constexpr std::uint32_t kSetting = 0x18FF660A;
inline constexpr TimeUs kNow = 5 * kSecondUs;
inline constexpr TimeUs kPeriod = 10 * kMillisecondUs;

/// Boom's angle every 10 ms on the first bus; the state, with a counter, every 50 ms on any.
inline BusTable table() {
  BusTable made;
  made.message_count = 2;
  made.rule[0].id = kAngles;
  made.rule[1].id = kState;
  made.rule[0].length = made.rule[1].length = 8;
  made.message[0].bus = 0;
  made.message[0].period_us = kPeriod;
  made.message[0].timeout_us = 35 * kMillisecondUs;
  made.message[0].count = 1;
  made.message[1].period_us = 5 * kPeriod;
  made.message[1].timeout_us = 160 * kMillisecondUs;
  made.message[1].slow = true;
  made.message[1].protection = TableProtection::kCounter;
  made.message[1].counter = {56, 8, false, false};
  made.message[1].most_steps = 3;
  made.message[1].first = 1;
  made.message[1].count = 2;
  made.source_count = 3;
  made.source[0] = {
      {0, 16, false, false}, SourcePlace::kJointAngle, 0, false, -0.0004, 10.0, -1.3, 1.3, 3.0};
  made.source[1] = {{0, 1, false, false}, SourcePlace::kCondition, 0, false, 1.0, 0.0, 0.0, 0.0};
  made.source[2] = {
      {40, 1, false, false}, SourcePlace::kEngineSpeed, 0, false, 188.5, 0.0, 0.0, 188.5};
  made.has_engine = true;
  made.send_count = 2;
  made.send[0].rule = {kLevers, kPeriod, 0, false, 0, nullptr};
  made.send[0].commands = true;
  made.send[0].bus = 0;
  made.send[0].count = 2;
  made.send[1].rule = {kSetting, 5 * kPeriod, 0, false, 0, nullptr};
  made.send[1].protection = TableProtection::kCounter;
  made.send[1].counter = {56, 8, false, false};
  made.send[1].commands = true;
  made.send[1].has_enable = true;
  made.send[1].first = 2;
  made.send[1].count = 2;
  made.sink_count = 4;
  made.sink[0] = {{0, 8, false, false}, SinkPlace::kExtend, 0, 0.004, 0.0};
  made.sink[1] = {{8, 8, false, false}, SinkPlace::kRetract, 0, 0.004, 0.0};
  made.sink[2] = {{28, 4, false, false}, SinkPlace::kEnable, 0, 1.0, 0.0};
  made.sink[3] = {{0, 8, false, false}, SinkPlace::kConstant, 0, 1.0, 180.0};
  return made;
}

}  // namespace graben::test
