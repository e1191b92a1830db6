// Rows 1 to 6: frames that do not come.

#include "tests/faults/frames.hpp"
#include "tests/faults/row.hpp"

namespace graben::faults {
namespace {

constexpr TimeUs kSilence_us = 50 * kMillisecondUs;
/// What one lost frame may move a cylinder by, against the undisturbed run.
constexpr double kLittle_m = 0.004;

/// Takes away the next frame of a message.
void lose_one(Trial& trial, std::uint32_t id) {
  trial.rig->tamper = [left = 1, id](CanFrame& frame, const LoopbackPort*) mutable {
    return frame.id != id || left-- <= 0;
  };
}

void one_frame_lost(Trial& trial) {
  trial.dig();
  lose_one(trial, trial.any_id(kProtectedIds));
  trial.expect_ignored(300 * kMillisecondUs, kLittle_m);
  lose_one(trial, bus::OperatorCommand::kId);
  trial.expect_ignored(300 * kMillisecondUs, kLittle_m);
  lose_one(trial, bus::SpoolCommand::kId);
  trial.expect_ignored(300 * kMillisecondUs, kLittle_m);
  trial.outcome.seen = "I";
}

void operator_silent(Trial& trial) {
  trial.dig();
  trial.rig->driver.set_silent(true);
  Stop stop;
  stop.since_us = trial.last_us(bus::OperatorCommand::kId);
  stop.any = {Fault::kOperatorMissing};
  stop.detect_us = stop.neutral_us = kSilence_us;
  stop.cure = [&] { trial.rig->driver.set_silent(false); };
  trial.expect_stop(stop);
}

/// Let go; in every fourth seed the deadman's contact says 'error' or 'not available' instead.
void enable_released(Trial& trial) {
  trial.dig();
  Rig& rig = *trial.rig;
  Stop stop;
  const bool let_go = trial.seed() % 4 != 0;
  if (let_go) {
    rig.ask(false, Task::kNone);
  } else {
    const std::uint32_t raw = 2 + trial.any_of(2);
    rig.tamper = [raw](CanFrame& frame, const LoopbackPort*) {
      if (frame.id == bus::OperatorCommand::kId) {
        set_raw(frame, bus::OperatorCommand::kEnable, raw);
      }
      return true;
    };
    stop.any = {Fault::kOperatorMissing};
    stop.cure = [&rig] { rig.tamper = nullptr; };
  }
  const TimeUs last_us = trial.last_us(bus::OperatorCommand::kId);
  // The frame that says so is on its way already in the cycle in which the controller is asked.
  stop.since_us = last_us + cycle_us_of(bus::OperatorCommand::kId);
  stop.detect_us = stop.neutral_us = kCycle_us;
  stop.latches = !let_go;
  trial.expect_stop(stop);
}

void stroke_silent(Trial& trial) {
  trial.dig();
  const std::uint32_t id = trial.any_id(kStrokeIds);
  Stop stop;
  stop.since_us = trial.last_us(id);
  stop.any = {Fault::kStrokeMissing};
  stop.detect_us = stop.neutral_us = kSilence_us;
  stop.cure = [&trial, id] { trial.rig->plant.faults().set_silent(id, false); };
  trial.rig->plant.faults().set_silent(id, true);
  trial.expect_stop(stop);
}

void slowed_by_silence(Trial& trial, std::uint32_t id, Fault fault) {
  trial.dig();
  Slowing slowing;
  slowing.since_us = trial.last_us(id);
  slowing.fault = fault;
  slowing.detect_us = kSilence_us;
  slowing.cure = [&trial, id] { trial.rig->plant.faults().set_silent(id, false); };
  trial.rig->plant.faults().set_silent(id, true);
  trial.expect_slower(slowing);
}

void pressure_silent(Trial& trial) {
  slowed_by_silence(trial, trial.any_id(kPressureIds), Fault::kPressureMissing);
}

void engine_silent(Trial& trial) {
  slowed_by_silence(trial, bus::EEC1::kId, Fault::kEngineSpeedMissing);
}

}  // namespace

Rows silence_rows() {
  return {{1, "one command frame lost", "I", one_frame_lost},
          {2, "operator's command times out", "N L", operator_silent},
          {3, "enable released, or its contact fails", "N | N L", enable_released},
          {4, "stroke sensor times out", "N L", stroke_silent},
          {5, "pressure sensor times out", "D", pressure_silent},
          {6, "engine speed times out", "D", engine_silent}};
}

}  // namespace graben::faults
