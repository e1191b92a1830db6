// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A simulation stepped as fast as it goes, and what its bus says of it.

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/scope/sim/sim_session.hpp"
#include "can_dbc/generated/dozer_dbc.hpp"
#include "can_dbc/generated/excavator_dbc.hpp"
#include "tests/unit/cmocka_cpp.hpp"

namespace graben::test {

using nlohmann::json;

inline scope::SimOptions options_of(const char* task) {
  scope::SimOptions options;
  options.task = task;
  return options;
}

/// What has been seen on the bus since forget(), and what was said last.
struct BusSeen {
  int frames = 0;
  TimeUs last_us = 0;
  bool backwards = false;
  EcuMode mode = EcuMode::kSilent;
  Fault fault = Fault::kNone;
  LimitKind limit = LimitKind::kNone;
  std::uint32_t rejected = 0;
  std::uint32_t why_not_armed = 0;
  TimeUs command_us = 0;         ///< Of the newest SpoolCommand.
  TimeUs widest_gap_us = 0;      ///< Between two of them.
  bool commands_neutral = true;  ///< The newest one lets nothing open.
  bool valve_closed = true;      ///< The newest word of the valve side.
  bool left_active = false;
  bool named_fault = false;
  bool was_degraded = false;
  int short_ids = 0;

  void forget() {
    left_active = named_fault = was_degraded = false;
    widest_gap_us = 0;
    short_ids = 0;
  }
};

class SimWatch {
 public:
  static constexpr TimeUs kCycle_us = scope::SimSession::kCycle_us;

  explicit SimWatch(const char* task) : SimWatch(options_of(task)) {}
  explicit SimWatch(const scope::SimOptions& options)
      : session(options, [this](const CanFrame& frame) { see(frame); }) {}

  void wish(const json& message) {
    const std::optional<std::string> why = session.control(message);
    if (why) {
      print_error("%s refused: %s\n", message.dump().c_str(), why->c_str());
    }
    assert_false(why.has_value());
  }
  void fault(const std::string& id, bool on) { wish({{"do", "fault"}, {"id", id}, {"value", on}}); }
  void run(double duration_s) {
    run_until(duration_s, [] { return false; });
  }
  bool run_until(double most_s, const std::function<bool()>& done) {
    const TimeUs end_us = session.now_us() + static_cast<TimeUs>(std::llround(most_s * 1e6));
    while (!done() && session.now_us() < end_us) {
      session.step();
    }
    return done();
  }
  bool run_to_active(double most_s) {
    return run_until(most_s, [this] { return bus.mode == EcuMode::kActive; });
  }
  json state() const {
    std::uint64_t seen = 0;
    return *session.state(seen);
  }

  BusSeen bus;
  std::function<void(const CanFrame&)> also;  ///< May be empty.
  scope::SimSession session;

 private:
  void see(const CanFrame& frame);
  void see_status(const CanFrame& frame);
  void see_command(const CanFrame& frame);
};

inline void SimWatch::see_status(const CanFrame& frame) {
  const auto status = dbc::excavator::EcuStatus::decode(frame.data);
  bus.mode = static_cast<EcuMode>(status.mode.value);
  bus.fault = static_cast<Fault>(status.fault.value);
  bus.limit = static_cast<LimitKind>(status.limit_kind.value);
  bus.rejected = status.rejected_frames.value;
  bus.left_active = bus.left_active || bus.mode != EcuMode::kActive;
  bus.named_fault = bus.named_fault || bus.fault != Fault::kNone;
  bus.was_degraded = bus.was_degraded || bus.limit == LimitKind::kDegraded;
}

inline void SimWatch::see_command(const CanFrame& frame) {
  using Command = dbc::dozer::SpoolCommand;  // Enable has the same place in both.
  bus.commands_neutral = Command::decode(frame.data).enable.value == Command::Enable::kOff;
  bus.widest_gap_us = std::max(bus.widest_gap_us, frame.stamp_us - bus.command_us);
  bus.command_us = frame.stamp_us;
}

inline void SimWatch::see(const CanFrame& frame) {
  using dbc::excavator::ValveState;
  ++bus.frames;
  bus.short_ids += frame.extended ? 0 : 1;
  bus.backwards = bus.backwards || frame.stamp_us < bus.last_us;
  bus.last_us = frame.stamp_us;
  switch (frame.id) {
    case dbc::excavator::EcuStatus::kId:
      see_status(frame);
      break;
    case dbc::excavator::EcuHealth::kId:
      bus.why_not_armed = dbc::excavator::EcuHealth::decode(frame.data).why_not_armed.value;
      break;
    case dbc::excavator::SpoolCommand::kId:
      see_command(frame);
      break;
    case ValveState::kId:
      bus.valve_closed = ValveState::decode(frame.data).enabled.value == ValveState::Enabled::kOff;
      break;
    default:
      break;
  }
  if (also) {
    also(frame);
  }
}

static_assert(dbc::excavator::EcuStatus::kId == dbc::dozer::EcuStatus::kId &&
              dbc::excavator::EcuHealth::kId == dbc::dozer::EcuHealth::kId &&
              dbc::excavator::SpoolCommand::kId == dbc::dozer::SpoolCommand::kId &&
              dbc::excavator::ValveState::kId == dbc::dozer::ValveState::kId);

}  // namespace graben::test
