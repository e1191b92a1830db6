// SPDX-License-Identifier: Apache-2.0
// Rows 1 to 4 and 6: frames that do not come.

#include "tests/faults/frames.hpp"
#include "tests/faults/row.hpp"
#include "tests/faults/trial.hpp"

namespace graben::faults {
namespace {

/// Takes away the next frame of a message.
template <class Kind>
void lose_one(Trial<Kind>& trial, std::uint32_t id) {
  trial.rig->tamper = [left = 1, id](CanFrame& frame, const LoopbackPort*) mutable {
    return frame.id != id || left-- <= 0;
  };
}

template <class Kind>
void one_frame_lost(Trial<Kind>& trial) {
  trial.work();
  const std::uint32_t lost_command = Kind::command_ids()[trial.seed() % Kind::command_ids().size()];
  lose_one(trial, trial.any_id(Kind::protected_ids()));
  trial.expect_ignored(300 * kMillisecondUs, Kind::kLittle_m);
  lose_one(trial, Kind::Dbc::OperatorCommand::kId);
  trial.expect_ignored(300 * kMillisecondUs, Kind::kLittle_m);
  lose_one(trial, lost_command);
  trial.expect_ignored(300 * kMillisecondUs, Kind::kLittle_m);
  trial.outcome.seen = "I";
}

template <class Kind>
void operator_silent(Trial<Kind>& trial) {
  trial.work();
  trial.rig->driver.set_silent(true);
  Stop stop{trial.last_us(Kind::Dbc::OperatorCommand::kId),
            {Fault::kOperatorMissing},
            kSilence_us,
            kSilence_us};
  stop.cure = [&] { trial.rig->driver.set_silent(false); };
  trial.expect_stop(stop);
}

/// Let go; in every fourth seed the deadman's contact says 'error' or 'not available' instead.
template <class Kind>
void enable_released(Trial<Kind>& trial) {
  auto& rig = trial.work();
  Stop stop;
  const bool let_go = trial.seed() % 4 != 0;
  if (let_go) {
    rig.ask(false, Task::kNone);
  } else {
    const std::uint32_t raw = 2 + trial.any_of(2);
    rig.tamper = [raw](CanFrame& frame, const LoopbackPort*) {
      if (frame.id == Kind::Dbc::OperatorCommand::kId) {
        set_raw<Kind>(frame, Kind::Dbc::OperatorCommand::kEnable, raw);
      }
      return true;
    };
    stop.any = {Fault::kOperatorMissing};
    stop.cure = [&rig] { rig.tamper = nullptr; };
  }
  const TimeUs last_us = trial.last_us(Kind::Dbc::OperatorCommand::kId);
  // The frame that says so is on its way already in the cycle in which the controller is asked.
  stop.since_us = last_us + cycle_us_of<Kind>(Kind::Dbc::OperatorCommand::kId);
  stop.detect_us = stop.neutral_us = kCycle_us;
  stop.latches = !let_go;
  trial.expect_stop(stop);
}

template <class Kind>
void sensor_silent(Trial<Kind>& trial) {
  trial.work();
  const Sensor& sensor = trial.any_sensor(Kind::vital());
  const std::uint32_t id = sensor.id;
  Stop stop{trial.last_us(id), {sensor.missing}, kSilence_us, kSilence_us};
  stop.cure = [&trial, id] { trial.rig->plant.faults().set_silent(id, false); };
  trial.rig->plant.faults().set_silent(id, true);
  trial.expect_stop(stop);
}

template <class Kind>
void engine_silent(Trial<Kind>& trial) {
  slowed_by_silence(trial, Kind::Dbc::EEC1::kId, Fault::kEngineSpeedMissing);
}

}  // namespace

template <class Kind>
Rows<Kind> silence_rows() {
  return {{1, "one command frame lost", "I", one_frame_lost<Kind>},
          {2, "operator's command times out", "N L", operator_silent<Kind>},
          {3, "enable released, or its contact fails", "N | N L", enable_released<Kind>},
          {4, "stroke, pose or track's sensor times out", "N L", sensor_silent<Kind>},
          {6, "engine speed times out", "D", engine_silent<Kind>}};
}

template Rows<Excavator> silence_rows();
template Rows<Dozer> silence_rows();

}  // namespace graben::faults
