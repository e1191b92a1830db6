// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Commissioning of a simulated machine over a bus in memory, whatever its kind: the sequence of
/// app/commission at the operator's station, the controller's guard, the plant. Nothing but frames
/// between them.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/commission/wrong_way.hpp"
#include "app/identify/machine/candump_reader.hpp"
#include "app/runs/logged_run.hpp"

namespace graben::runs {

enum class CommissionEnd { kDone, kFault, kWrongWay, kTooLong };

struct CommissionResult {
  CommissionEnd end = CommissionEnd::kDone;
  Fault fault = Fault::kNone;                 ///< With kFault.
  std::optional<commission::WrongWay> wrong;  ///< With kWrongWay.
  std::size_t step = 0;                       ///< It came to.
  double machine_s = 0.0;  ///< In which the machine moved or waited for the next step.
  std::vector<commission::StepResult> steps;
};

/// Longest that it may take, s.
inline constexpr double kCommissionMost_s = 600.0;

/// Each frame of the bus goes there, if it is not empty.
using TakeFrame = std::function<void(const identify::LoggedFrame&)>;

[[nodiscard]] identify::LoggedFrame logged_frame(const CanFrame& frame);

/// Why it is over; kDone: it goes on.
template <class Sequence>
CommissionEnd end_of(EcuMode mode, const Sequence& sequence, TimeUs now_us) {
  if (mode == EcuMode::kFault) {
    return CommissionEnd::kFault;
  }
  if (sequence.wrong()) {
    return CommissionEnd::kWrongWay;
  }
  return seconds(now_us) > kCommissionMost_s ? CommissionEnd::kTooLong : CommissionEnd::kDone;
}

/// To the sequence's end or to what stops it, and half a second of nothing. `log_file`: candump
/// log; none if empty. `try_next(now_us)` steps the sequence by what it hears and has the rig's
/// operator try what that says; `words(at)` names a step, of `steps`.
template <class Rig, class Sequence, class TryNext, class Words>
CommissionResult lead_commission(Rig& rig, const Sequence& sequence,
                                 const std::filesystem::path& log_file, const TakeFrame& take,
                                 const TryNext& try_next, std::size_t steps, const Words& words,
                                 const Progress& progress) {
  std::optional<CandumpLog> log;
  if (!log_file.empty()) {
    log.emplace(log_file, "vcan0");
  }
  rig.bus.set_tap([&](const CanFrame& frame) {
    if (log) {
      log->write(frame, frame.stamp_us);
    }
    if (take) {
      take(logged_frame(frame));
    }
  });
  CommissionResult result;
  TimeUs now_us = 0;
  for (; !sequence.is_done(); now_us += Rig::kPeriod_us) {
    try_next(now_us);
    static_cast<void>(rig.step(now_us));
    const auto& status = rig.ecu->outputs().status;
    result.end = end_of(status.mode, sequence, now_us);
    if (result.end != CommissionEnd::kDone) {
      result.fault = result.end == CommissionEnd::kFault ? status.fault : Fault::kNone;
      result.wrong = sequence.wrong();
      break;
    }
    if (!sequence.is_done()) {
      progress(static_cast<double>(sequence.at()) / static_cast<double>(steps),
               words(sequence.at()));
    }
  }
  rig.release();
  for (const TimeUs end_us = now_us + 500 * kMillisecondUs; now_us < end_us;
       now_us += Rig::kPeriod_us) {
    static_cast<void>(rig.step(now_us));
  }
  rig.bus.set_tap(nullptr);
  if (log) {
    log->close();
  }
  result.step = sequence.at();
  result.machine_s = sequence.active_s();
  result.steps = sequence.results();
  return result;
}

}  // namespace graben::runs
